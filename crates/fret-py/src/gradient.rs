//! Derivatives of a history by numbers of its case.

use std::collections::BTreeMap;

use fret_core::plan::Plan;
use fret_core::run::Observer;
use fret_core::sensitivity::{self, Request, Sensitivities, SensitivityError, Weights};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{PyErr, PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{RunError, failed, refused};
use crate::simulation::listen;
use crate::threads::{self, Threads};

/// Derivatives by path.
type ByPath = BTreeMap<String, f64>;

/// A result's name, its value, its derivatives, and those on the other side of cells that are about to change their state.
type Found = Vec<(String, f64, ByPath, Option<ByPath>)>;

/// Where most cells are about to change their state: the increment, how many cells, and how many are in contact.
type Near = Option<(usize, usize, usize)>;

/// Derivatives of results by numbers of a case, all numbers where none is named; and where most cells are about to change their state.
#[pyfunction]
pub fn gradient(
    py: Python<'_>,
    case: &Case,
    of: Vec<String>,
    by: Vec<String>,
    threads: Threads,
) -> PyResult<(Found, Near)> {
    let request = Request { of, by, direction: None };
    let found = found(py, case, threads, |plan, guest| sensitivity::gradient(plan, &request, guest))?;
    let paths: Vec<String> = found.parameters.iter().map(|entry| entry.path().to_owned()).collect();
    let by_path = |by: Vec<f64>| -> ByPath { paths.iter().cloned().zip(by).collect() };
    let of = |sensitivity::Gradient { of, value, by, on_the_other_side }: sensitivity::Gradient| {
        (of, value, by_path(by), on_the_other_side.map(by_path))
    };
    let near = found.near_events.map(|near| (near.increment, near.cells, near.contact));
    Ok((found.gradients.into_iter().map(of).collect(), near))
}

/// Refuses names that are none of results with derivatives.
#[pyfunction]
pub fn check_results(of: Vec<String>) -> PyResult<()> {
    of.iter().try_for_each(|name| sensitivity::check_name(name)).map_err(ended)
}

/// Refuses what has no derivatives, as far as that can be said before the run.
#[pyfunction]
pub fn check_derivatives(py: Python<'_>, case: &Case, of: Vec<String>, by: Vec<String>) -> PyResult<()> {
    let plan = py.detach(|| case.planned()).map_err(|error| refused(&error))?;
    sensitivity::check_asked(&plan, &of, &by).map_err(ended)
}

/// Derivatives of a sum of results and of the cells of fields, each times its weight, by numbers of a case; by all numbers where none is named.
#[pyfunction]
pub fn pulled_back(
    py: Python<'_>,
    case: &Case,
    results: Vec<(String, f64)>,
    fields: Vec<(String, PyReadonlyArray2<'_, f64>)>,
    by: Vec<String>,
    threads: Threads,
) -> PyResult<Vec<(String, f64)>> {
    let fields = fields.into_iter().map(|(name, weights)| (name, weights.as_array().to_owned())).collect();
    let weights = Weights { results, fields };
    let found = found(py, case, threads, |plan, guest| sensitivity::pulled_back(plan, &weights, &by, guest))?;
    let paths = found.parameters.iter().map(|entry| entry.path().to_owned());
    let derivatives = found.gradients.iter().flat_map(|gradient| gradient.by.iter().copied());
    Ok(paths.zip(derivatives).collect())
}

/// What derivatives a case has, found beside Python.
fn found(
    py: Python<'_>,
    case: &Case,
    threads: Threads,
    find: impl Fn(&Plan, &mut dyn Observer) -> Result<Sensitivities, SensitivityError> + Sync,
) -> PyResult<Sensitivities> {
    let pool = threads::pool(threads)?;
    let plan = py.detach(|| pool.install(|| case.planned())).map_err(|error| refused(&error))?;
    let (answer, interruption): (_, Option<PyErr>) = py.detach(|| {
        listen(&plan, None, |reporter| {
            let mut guest = reporter.silently();
            pool.install(|| find(&plan, &mut guest))
        })
    });
    match interruption {
        Some(error) => Err(error),
        None => answer.map_err(ended),
    }
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn ended(error: SensitivityError) -> PyErr {
    match &error {
        SensitivityError::Run(error) => failed(error),
        SensitivityError::NotSolved { increment, .. } => RunError::new_err((error.to_string(), *increment)),
        _ => PyValueError::new_err(error.to_string()),
    }
}
