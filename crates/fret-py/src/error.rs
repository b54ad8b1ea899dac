//! From the core's refusals and failures to the exceptions of `fretting.errors`.

use std::path::Path;

use fret_cli::embedded::Failure;
use fret_core::case;
use fret_core::run;
use fret_results::ResultsError;
use pyo3::PyErr;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};

pyo3::import_exception!(fretting.errors, CaseError);
pyo3::import_exception!(fretting.errors, OutOfMemoryError);
pyo3::import_exception!(fretting.errors, RunError);
pyo3::import_exception!(fretting.errors, UnreadableError);

/// A refused case: the text a person reads, and `(line, column, message, help)` of every mistake. A good one that there is not the
/// memory for is no mistake of the case.
pub fn refused(error: &case::CaseError) -> PyErr {
    if error.lacks_memory() {
        return OutOfMemoryError::new_err((error.render(false), 0));
    }
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

/// A folder that holds no results, or not those that were written.
pub fn unusable(error: ResultsError, folder: &Path) -> PyErr {
    unreadable(Failure::from(error).render(false), &folder.to_string_lossy())
}

/// A bad argument of a function.
pub fn bad_value(error: impl std::error::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// A call that ended without its answer, in the words of Python's arguments.
pub fn stopped(failure: Failure) -> PyErr {
    let message = failure.message();
    match failure {
        Failure::Case(error) => refused(&error),
        Failure::Call(what, help) => {
            PyValueError::new_err(format!("{}\n  = help: {}", in_arguments(&what), in_arguments(&help)))
        }
        Failure::Memory(_) => OutOfMemoryError::new_err((message, 0)),
        Failure::Unsolved(error) => failed(&error),
        Failure::Interrupted(what) => PyKeyboardInterrupt::new_err(in_arguments(&what)),
        Failure::Unwritten(unwritten) => unreadable(message, &unwritten.path.to_string_lossy()),
        Failure::Points { .. } | Failure::Defect(_) => PyRuntimeError::new_err(message),
    }
}

/// What the command's options are called as arguments.
fn in_arguments(words: &str) -> String {
    let words =
        ["columns", "units"].into_iter().fold(words.to_owned(), |words, name| as_mapping(&words, name));
    let pairs = [
        ("choose another folder with --out DIR", "choose another folder"),
        ("--resume --estimate-error", "resume=True and estimate_error=True"),
        ("--resume", "resume=True"),
        ("--force", "replace=True"),
        ("--estimate-error", "estimate_error=True"),
        ("the same command without it", "the same call without it"),
        ("--strict", "strict=True"),
        ("with --columns", "with columns"),
        ("with --touch DEPTH", "with touch"),
        ("--fit ", "fit="),
        ("--cycle ", "cycle="),
        ("--cells with smaller numbers", "smaller numbers of cells"),
        ("--cells", "cells ="),
        ("--from", "start ="),
        ("fret study --help", "help(fretting.study)"),
    ];
    pairs.into_iter().fold(words, |words, (option, argument)| words.replace(option, argument))
}

/// Pairs behind an option as the mapping that its argument is: `--columns "depth=h,force=P"` as `columns={"depth": "h", "force": "P"}`.
fn as_mapping(words: &str, name: &str) -> String {
    let option = format!("--{name} \"");
    let mut parts = words.split(&option);
    let mut said = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (pairs, rest) = part.split_once('"').unwrap_or((part, ""));
        let pairs: Vec<String> = pairs
            .split(',')
            .map(|pair| {
                let (key, value) = pair.split_once('=').unwrap_or((pair, "..."));
                format!("\"{key}\": \"{value}\"")
            })
            .collect();
        said += &format!("{name}={{{}}}{rest}", pairs.join(", "));
    }
    said
}
