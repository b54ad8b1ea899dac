//! The plan of a case, as text that Python reads.

use pyo3::prelude::{PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{bad_value, refused};
use crate::threads::on_pool;

/// Plans a case; JSON text.
#[pyfunction]
pub fn plan(py: Python<'_>, case: &Case) -> PyResult<String> {
    let plan = on_pool(py, None, || case.planned())?.map_err(|error| refused(&error))?;
    serde_json::to_string(&plan).map_err(bad_value)
}
