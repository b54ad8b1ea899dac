//! What a judgement collects while it goes on: mistakes with their places.

use std::ops::Range;

use super::attachments::Attachments;
use super::refusal::Mistake;

/// Collects mistakes; `None` stands for a value that was refused.
pub(super) struct Judge<'a> {
    pub(super) mistakes: Vec<Mistake>,
    pub(super) attachments: Attachments<'a>,
}

impl Judge<'_> {
    pub(super) fn refuse<T>(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: &str,
    ) -> Option<T> {
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.mistakes.push(Mistake { message: message.into(), help, span: Some(span) });
        None
    }
}
