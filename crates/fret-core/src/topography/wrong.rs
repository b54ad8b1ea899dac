//! How heights are refused: the message goes on where their key ends.

use std::fmt::Display;

use crate::document::Mistake;

/// What is wrong with the heights as a whole.
pub fn wrong(why: impl Display, help: &str) -> Mistake {
    Mistake::new(format!(": {why}"), help)
}

/// The same as a refusal.
///
/// # Errors
/// Always.
pub fn refuse<T>(why: impl Display, help: &str) -> Result<T, Mistake> {
    Err(wrong(why, help))
}
