//! The plan of a case, as text that Python reads.

use fret_core::machine::memory;
use fret_core::run::plausibility;
use fret_core::study::expectation;
use pyo3::prelude::{PyResult, Python, pyfunction};

use serde_json::json;

use crate::case::Case;
use crate::error::{bad_value, refused};
use crate::threads::{ALL, on_pool};

/// Memory that a run of a case takes, with the fields it keeps [bytes].
#[pyfunction]
pub fn memory_needed(py: Python<'_>, case: &Case) -> PyResult<usize> {
    let plan = on_pool(py, ALL, || case.planned())?.map_err(|error| refused(&error))?;
    Ok(plan.memory_bytes.saturating_add(plan.kept_bytes))
}

/// Plans a case; JSON text.
#[pyfunction]
pub fn plan(py: Python<'_>, case: &Case) -> PyResult<String> {
    let plan = on_pool(py, ALL, || case.planned())?.map_err(|error| refused(&error))?;
    let mut answer = serde_json::to_value(&plan).map_err(bad_value)?;
    answer["warnings"] = serde_json::to_value(plausibility::of_plan(&plan)).map_err(bad_value)?;
    Ok(answer.to_string())
}

/// What the run of a case will take, with the fields that it keeps in memory; JSON text.
#[pyfunction]
pub fn expected(py: Python<'_>, case: &Case) -> PyResult<String> {
    let (lacking, expected) = on_pool(py, ALL, || {
        let plan = case.planned()?;
        let lacking = memory::check(plan.memory_bytes.saturating_add(plan.kept_bytes)).err();
        let expected = lacking.is_none().then(|| expectation(&plan));
        Ok((lacking, expected))
    })?
    .map_err(|error| refused(&error))?;
    let entries = json!({
        "increments_expected": expected.map(|expected| expected.increments),
        "convolutions_expected": expected.map(|expected| expected.convolutions),
        "seconds_expected": expected.map(|expected| expected.seconds),
        "memory_lacking": lacking.map(|error| format!("this {error}")),
    });
    Ok(entries.to_string())
}
