//! A loading history from a CSV table that comes with the case.

use super::judge::Judge;
use super::stage_file::StageFile;
use crate::document::At;
use crate::measured::{Loads, loads};

/// The table of a stage, in the units of the case; `None` when it was refused.
pub(super) fn table(judge: &mut Judge, place: &str, file: &StageFile, name: &At<String>) -> Option<Loads> {
    let text = judge.attached_text(&format!("{place}.table"), name)?;
    let found = loads(&text, file.columns.as_ref(), judge.units.as_ref(), judge.dimension);
    judge.take(&format!("{place}.table {:?}: ", name.value), name.span(), found)
}

#[cfg(test)]
mod tests;
