//! Why a log was not identified.

use crate::case::CaseError;
use crate::measured::MeasuredError;
use crate::run::RunError;

/// Why a log was not identified.
#[derive(Debug, thiserror::Error)]
pub enum IdentifyError {
    /// The log cannot be read as fretting loops of such a case, or what was asked of it cannot be had.
    #[error("{what}")]
    Log {
        /// What is wrong, with the name of the log and the place in it.
        what: String,
        /// What to do about it.
        help: String,
    },
    /// The case is none of a rig, or cannot be planned.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A loop of the case cannot be solved.
    #[error(transparent)]
    Unsolved(#[from] RunError),
}

/// A refusal of a log, with what to do about it.
pub(super) fn refused(name: &str, what: &str, help: &str) -> IdentifyError {
    IdentifyError::Log { what: format!("{name}: {what}"), help: help.to_owned() }
}

impl From<MeasuredError> for IdentifyError {
    fn from(MeasuredError { what, help }: MeasuredError) -> Self {
        Self::Log { what, help }
    }
}
