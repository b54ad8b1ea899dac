//! What a judgement collects while it goes on: mistakes with their places.

use std::ops::Range;

use super::refusal::Mistake;

/// Collects mistakes; `None` stands for a value that was refused.
#[derive(Default)]
pub(super) struct Judge {
    pub(super) mistakes: Vec<Mistake>,
}

impl Judge {
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
