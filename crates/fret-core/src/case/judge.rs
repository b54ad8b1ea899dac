//! What a judgement collects while it goes on: mistakes with their places.

use std::ops::Range;

use super::attachments::Attachments;
use crate::document::{At, Mistake, Places};
use crate::model::Dimension;
use crate::numbers::letters;
use crate::units::Units;

/// Why a case has no mean gap to prescribe, and what to prescribe instead.
pub(super) type WithoutMeanGap = (&'static str, &'static str);

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
    pub(super) mean_plane: Result<f64, WithoutMeanGap>,
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
        let help = (!help.is_empty()).then(|| help.to_owned());
        self.mistakes.push(Mistake { message: message.into(), help, span: Some(span) });
        None
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

    /// Content of a file the case names under `key`; refused, with the reason, when it cannot be had.
    pub(super) fn attached(&mut self, key: &str, name: &At<String>) -> Option<Vec<u8>> {
        match (self.attachments.file)(&name.value) {
            Ok(content) => Some(content),
            Err(reason) => self.refuse(
                name.span(),
                format!("{key} = {:?}: {reason}", &name.value),
                "a file's name is relative to the case file",
            ),
        }
    }

    /// The same as text, with line feeds at the ends of lines.
    pub(super) fn attached_text(&mut self, key: &str, name: &At<String>) -> Option<String> {
        let content = self.attached(key, name)?;
        match letters(&content) {
            Ok(text) => Some(text.into_owned()),
            Err(error) => {
                let message = format!("{key} = {:?}: no text that can be read: {error}", &name.value);
                self.refuse(name.span(), message, "a text in UTF-8, UTF-16 or Latin-1")
            }
        }
    }
}
