//! Derivatives of a history by numbers of its case.

use std::collections::BTreeMap;

use fret_core::sensitivity::{self, Request, SensitivityError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{PyErr, PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{RunError, failed, refused};
use crate::simulation::listen;
use crate::threads::{self, Threads};

/// A result's name, its value, and its derivatives by path.
type Found = Vec<(String, f64, BTreeMap<String, f64>)>;

/// Derivatives of results by numbers of a case; all numbers where none is named.
#[pyfunction]
pub fn gradient(
    py: Python<'_>,
    case: &Case,
    of: Vec<String>,
    by: Vec<String>,
    threads: Threads,
) -> PyResult<Found> {
    let pool = threads::pool(threads)?;
    let request = Request { of, by, direction: None };
    let plan = py.detach(|| pool.install(|| case.planned())).map_err(|error| refused(&error))?;
    let (answer, interruption): (_, Option<PyErr>) = py.detach(|| {
        listen(&plan, None, |reporter| {
            let mut guest = reporter.silently();
            pool.install(|| sensitivity::gradient(&plan, &request, &mut guest))
        })
    });
    if let Some(error) = interruption {
        return Err(error);
    }
    let found = answer.map_err(ended)?;
    let paths: Vec<String> = found.parameters.iter().map(|entry| entry.path().to_owned()).collect();
    let of = |gradient: sensitivity::Gradient| {
        (gradient.of, gradient.value, paths.iter().cloned().zip(gradient.by).collect())
    };
    Ok(found.gradients.into_iter().map(of).collect())
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn ended(error: SensitivityError) -> PyErr {
    match &error {
        SensitivityError::Run(error) => failed(error),
        SensitivityError::NotSolved { increment, .. } => RunError::new_err((error.to_string(), *increment)),
        _ => PyValueError::new_err(error.to_string()),
    }
}
