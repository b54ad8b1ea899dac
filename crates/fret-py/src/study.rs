//! A refinement study of a case.

use fret_cli::embedded::{self, StudyRequest};
use pyo3::prelude::{PyErr, PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{refused, stopped};
use crate::simulation::listen;
use crate::threads::{self, Threads};

/// Lists of cells, increments and tolerances, and what they are compared with; empty lists for the default.
type Resolutions = (Vec<usize>, Vec<usize>, Vec<f64>, Option<String>);

/// Studies a case; the answer as JSON text.
#[pyfunction]
pub fn study(
    py: Python<'_>,
    case: &Case,
    resolutions: Resolutions,
    threads: Threads,
    progress: bool,
) -> PyResult<String> {
    let (cells, increments, tolerances, against) = resolutions;
    let pool = threads::pool(threads)?;
    let request = StudyRequest { cells, increments, tolerances, against };
    let plan = py.detach(|| pool.install(|| case.planned())).map_err(|error| refused(&error))?;
    let (answer, interruption): (_, Option<PyErr>) = py.detach(|| {
        listen(&plan, None, |reporter| {
            let mut guest = reporter.silently();
            pool.install(|| embedded::study(&plan, &request, progress, &mut guest))
        })
    });
    match interruption {
        Some(error) => Err(error),
        None => answer.map(|answer| answer.to_string()).map_err(stopped),
    }
}
