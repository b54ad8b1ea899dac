//! Constants of a model from measured fretting loops.

use fret_cli::embedded::{self, IdentifyRequest};
use fret_core::identify::Request;
use fret_core::measured;
use pyo3::prelude::{PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::stopped;
use crate::threads::{self, Threads};

/// What is asked: columns, units, the cycle, the key, whether a log with bad cycles or rows is refused.
type Asked = (Vec<(String, String)>, Vec<(String, String)>, Option<f64>, Option<String>, bool);

/// Identifies a log, whose name and bytes are given, by a case; the answer as JSON text, and the page.
#[pyfunction]
pub fn identify(
    py: Python<'_>,
    log: (String, Vec<u8>),
    case: &Case,
    asked: Asked,
    threads: Threads,
) -> PyResult<(String, String)> {
    let (columns, units, cycle, key, strict) = asked;
    let request =
        IdentifyRequest { log: Request { asked: measured::Asked { columns, units }, cycle, strict }, key };
    let (name, bytes) = log;
    let pool = threads::pool(threads)?;
    let text = case.text()?;
    let answer = py.detach(|| pool.install(|| embedded::identify((&name, &bytes), &text, &request)));
    answer.map(|(json, page)| (json.to_string(), page)).map_err(stopped)
}
