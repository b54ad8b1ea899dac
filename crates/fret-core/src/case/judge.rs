//! What a judgement collects while it goes on: mistakes with their places.

use std::ops::Range;

use super::attachments::Attachments;
use crate::document::{At, Mistake, Places};
use crate::model::Dimension;
use crate::numbers::letters;
use crate::units::Units;

/// Why something has no meaning in a case, and what to do instead.
pub(super) type Reason = (&'static str, &'static str);

/// The first reason that holds.
pub(super) fn first<const N: usize>(reasons: [(bool, &'static str, &'static str); N]) -> Option<Reason> {
    reasons.into_iter().find(|(holds, ..)| *holds).map(|(_, why, help)| (why, help))
}

/// Collects mistakes; `None` stands for a value that was refused.
pub(super) struct Judge<'a> {
    pub(super) mistakes: Vec<Mistake>,
    pub(super) attachments: Attachments<'a>,
    /// Where everything stands.
    pub(super) places: &'a Places,
    /// A space and the unit of a force, in which loads are told that the case does not write down; empty without units.
    pub(super) force_unit: String,
    /// Units that the case declares.
    pub(super) units: Option<Units>,
    /// Whether loads are those of a unit of length.
    pub(super) dimension: Dimension,
    /// Whether the surfaces move with their bodies.
    pub(super) moves: bool,
    /// Mean of the undeformed gap [length], from which a mean gap counts; or why none can be prescribed, and what to do instead.
    pub(super) mean_plane: Result<f64, Reason>,
    /// Stages that prescribe a mean gap.
    pub(super) by_mean_gap: Vec<usize>,
}

impl Judge<'_> {
    pub(super) fn refuse<T>(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: &str,
    ) -> Option<T> {
        self.mistakes.push(Mistake::new(message, help).at(span));
        None
    }

    /// What was found, or its mistake: the message goes on behind `place`, and stands at `span` where nothing else is said.
    pub(super) fn take<T>(
        &mut self,
        place: &str,
        span: Range<usize>,
        found: Result<T, Mistake>,
    ) -> Option<T> {
        match found {
            Ok(found) => Some(found),
            Err(Mistake { message, help, span: own }) => {
                let span = Some(own.unwrap_or(span));
                self.mistakes.push(Mistake { message: format!("{place}{message}"), help, span });
                None
            }
        }
    }

    /// Refuses two things of which one is meant.
    pub(super) fn both<T>(&mut self, span: Range<usize>, things: &str) -> Option<T> {
        self.both_or(span, things, "leave out one of the two")
    }

    /// The same with another way out.
    pub(super) fn both_or<T>(&mut self, span: Range<usize>, things: &str, help: &str) -> Option<T> {
        self.refuse(span, format!("{things}, both at once"), help)
    }

    /// Refuses each of the things that is given: its place, what is wrong with it, the way out.
    pub(super) fn refuse_given<M: Into<String>, const N: usize>(
        &mut self,
        things: [(Option<Range<usize>>, M, &str); N],
    ) {
        for (span, message, help) in things {
            if let Some(span) = span {
                self.refuse::<()>(span, message, help);
            }
        }
    }

    /// Content of a file the case names under `key`; refused, with the reason and the way out, when it cannot be had.
    pub(super) fn attached(
        &mut self,
        (key, span): (&str, Range<usize>),
        name: &str,
        help: &str,
    ) -> Option<Vec<u8>> {
        match (self.attachments.file)(name) {
            Ok(content) => Some(content),
            Err(reason) => self.refuse(span, format!("{key} = {name:?}: {reason}"), help),
        }
    }

    /// The same as text, with line feeds at the ends of lines.
    pub(super) fn attached_text(&mut self, key: &str, name: &At<String>) -> Option<String> {
        let help = "a file's name is relative to the case file";
        let content = self.attached((key, name.span()), &name.value, help)?;
        match letters(&content) {
            Ok(text) => Some(text.into_owned()),
            Err(error) => {
                let message = format!("{key} = {:?}: no text that can be read: {error}", &name.value);
                self.refuse(name.span(), message, "a text in UTF-8, UTF-16 or Latin-1")
            }
        }
    }
}
