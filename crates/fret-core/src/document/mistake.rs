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

impl Mistake {
    /// A mistake of which others know where it stands; the help may be empty.
    pub fn new(message: impl Into<String>, help: &str) -> Self {
        Self { message: message.into(), help: (!help.is_empty()).then(|| help.to_owned()), span: None }
    }

    /// The same at a place.
    #[must_use]
    pub fn at(self, span: Range<usize>) -> Self {
        Self { span: Some(span), ..self }
    }
}
