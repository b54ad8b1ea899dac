//! Why a table of measured numbers was refused.

/// Why a table of measured numbers was refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct MeasuredError {
    /// What is wrong, with the name of the file and the place in it.
    pub what: String,
    /// What to do about it.
    pub help: String,
}

/// A refusal of a file, with what to do about it.
pub fn refused(name: &str, what: &str, help: &str) -> MeasuredError {
    MeasuredError { what: format!("{name}: {what}"), help: help.to_owned() }
}
