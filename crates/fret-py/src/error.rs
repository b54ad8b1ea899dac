//! From the core's refusals and failures to the exceptions of `fretting.errors`.

use fret_core::case;
use fret_core::run;
use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

pyo3::import_exception!(fretting.errors, CaseError);
pyo3::import_exception!(fretting.errors, OutOfMemoryError);
pyo3::import_exception!(fretting.errors, RunError);
pyo3::import_exception!(fretting.errors, UnreadableError);

/// A refused case: the text a person reads, and `(line, column, message, help)` of every mistake.
pub fn refused(error: &case::CaseError) -> PyErr {
    let mistakes: Vec<_> = error
        .mistakes()
        .iter()
        .map(|mistake| {
            let (line, column) = error.place(mistake).unzip();
            (line, column, mistake.message.clone(), mistake.help.clone())
        })
        .collect();
    CaseError::new_err((error.render(false), mistakes))
}

/// A run that ended without its answer: the message and the number of the increment.
pub fn failed(error: &run::RunError) -> PyErr {
    if let run::RunError::OutOfMemory { increment, .. } = error {
        return OutOfMemoryError::new_err((error.to_string(), *increment));
    }
    RunError::new_err((error.to_string(), error.increment()))
}

/// A file or folder that does not hold what was expected.
pub fn unreadable(message: String, path: &str) -> PyErr {
    UnreadableError::new_err((message, path.to_owned()))
}

/// A bad argument of a function.
pub fn bad_value(error: impl std::error::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}
