//! A mistake in a document.

use std::ops::Range;

/// One mistake in a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// What was found, and what is allowed.
    pub message: String,
    /// What to do about it, when that can be said.
    pub help: Option<String>,
    /// Bytes of the case text the mistake stands at, when it stands anywhere.
    pub span: Option<Range<usize>>,
}
