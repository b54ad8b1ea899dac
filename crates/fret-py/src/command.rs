//! The command `fret`, for the wheel.

use std::ffi::OsString;

use pyo3::prelude::{Python, pyfunction};

/// Does what the words of a command line ask for, the first being the program's name; gives the exit code. Answers go to
/// the process's own streams, not to Python's. The first Ctrl-C ends a run in good order.
#[pyfunction]
pub fn command_line(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| fret_cli::command_line(words))
}
