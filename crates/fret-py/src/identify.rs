//! Constants of a model from measured fretting loops, and numbers of a case from an indentation.

use fret_cli::embedded::{self, IdentifyQuestion, IdentifyRequest, IndentationAsked};
use fret_core::identify::{IndentationRequest, Part, Request};
use fret_core::measured;
use pyo3::prelude::{PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::stopped;
use crate::threads::{self, Threads};

/// What is asked: columns, units, the cycle, of how many cycles one is fitted, the key, whether a log with bad cycles or rows is refused.
type Asked = (Vec<(String, String)>, Vec<(String, String)>, Option<f64>, Option<usize>, Option<String>, bool);

/// Identifies a log, whose name and bytes are given, by a case; the answer as JSON text, and the page.
#[pyfunction]
pub fn identify(
    py: Python<'_>,
    log: (String, Vec<u8>),
    case: &Case,
    asked: Asked,
    threads: Threads,
) -> PyResult<(String, String)> {
    let (columns, units, cycle, every, key, strict) = asked;
    let log_asked = Request { asked: measured::Asked { columns, units }, cycle, every, strict };
    let question = IdentifyQuestion::Loops(IdentifyRequest { log: log_asked, key });
    answered(py, log, case, &question, threads)
}

fn answered(
    py: Python<'_>,
    (name, bytes): (String, Vec<u8>),
    case: &Case,
    question: &IdentifyQuestion,
    threads: Threads,
) -> PyResult<(String, String)> {
    let pool = threads::pool(threads)?;
    let text = case.text()?;
    let answer = py.detach(|| pool.install(|| embedded::identify((&name, &bytes), &text, question)));
    answer.map(|(json, page)| (json.to_string(), page)).map_err(stopped)
}

/// What is asked of an indentation: columns, units, the keys, which part, the touch, whether the frame is fitted, whether bad rows are refused.
type AskedOfDepth =
    (Vec<(String, String)>, Vec<(String, String)>, Vec<String>, String, Option<f64>, bool, bool);

/// Fits numbers of a case to a measured indentation, whose name and bytes are given; the answer as JSON text, and the page.
#[pyfunction]
pub fn identify_indentation(
    py: Python<'_>,
    log: (String, Vec<u8>),
    case: &Case,
    asked: AskedOfDepth,
    threads: Threads,
) -> PyResult<(String, String)> {
    let (columns, units, keys, part, touch, frame, strict) = asked;
    let part = Part::named(&part).unwrap_or_default();
    let asked = measured::Asked { columns, units };
    let asked = IndentationAsked { request: IndentationRequest { asked, part, touch, frame, strict }, keys };
    answered(py, log, case, &IdentifyQuestion::Indentation(asked), threads)
}
