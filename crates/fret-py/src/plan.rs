//! The plan of a case, as text that Python reads.

use fret_core::plan::Plan;
use fret_core::plausibility;
use pyo3::prelude::{PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{bad_value, refused};
use crate::threads::on_pool;

/// Plans a case; JSON text.
#[pyfunction]
pub fn plan(py: Python<'_>, case: &Case) -> PyResult<String> {
    let question = case.0.clone();
    let plan = on_pool(py, None, || Plan::new(question))?.map_err(|error| refused(&error))?;
    let mut answer = serde_json::to_value(&plan).map_err(bad_value)?;
    answer["warnings"] = serde_json::to_value(plausibility::of_plan(&plan)).map_err(bad_value)?;
    Ok(answer.to_string())
}
