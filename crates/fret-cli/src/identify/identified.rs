//! What is told of a log.

use fret_core::identify::IdentifyError;
use serde_json::Value;

use crate::failure::Failure;

/// What is told of a log.
#[derive(Debug)]
pub struct Identified {
    /// For programs, as `identified.json` has it.
    pub record: Value,
    /// For a person.
    pub text: String,
    /// The page with its pictures.
    pub page: String,
    /// Names and contents of files: the cycles of the loops and the fits repeated over them, or the points of the indentation, as CSV.
    pub tables: Vec<(&'static str, String)>,
}

impl From<IdentifyError> for Failure {
    fn from(error: IdentifyError) -> Self {
        match error {
            IdentifyError::Log { what, help } => Self::Call(what, help),
            IdentifyError::Case(error) => Self::Case(error),
            IdentifyError::Unsolved(error) => Self::Unsolved(error),
        }
    }
}
