//! The loading history while it is judged: each stage as it is written, and checked.

use std::ops::Range;

use super::stage_file::StageFile;
use crate::document::At;
use crate::model::stage::Stage;

/// The stages as they are written, and checked; `None` where one of them was refused.
#[derive(Clone, Copy)]
pub(super) struct Loading<'a> {
    pub files: &'a [At<StageFile>],
    pub checked: Option<&'a [Stage]>,
}

/// A stage.
#[derive(Clone, Copy)]
pub(super) struct Prescribed<'a> {
    pub index: usize,
    pub file: &'a At<StageFile>,
    pub checked: Option<&'a Stage>,
}

impl<'a> Loading<'a> {
    /// The stages one by one.
    pub fn stages(self) -> impl Iterator<Item = Prescribed<'a>> {
        let checked = move |index: usize| self.checked.and_then(|checked| checked.get(index));
        self.files.iter().enumerate().map(move |(index, file)| Prescribed {
            index,
            file,
            checked: checked(index),
        })
    }

    /// Whether any stage rolls until nothing changes any more.
    pub fn is_steady(self) -> bool {
        self.files.iter().any(|file| file.controls.are_steady())
    }
}

impl Prescribed<'_> {
    /// Where its table stands, if that is how the stage `does` so.
    pub fn by_table(&self, does: impl Fn(&Stage) -> bool) -> Option<Range<usize>> {
        self.file.table.as_ref().filter(|_| self.checked.is_some_and(does)).map(At::span)
    }

    /// Whether the contact rolls in it, by a key or by a table.
    pub fn rolls(&self) -> bool {
        self.file.controls.of("roll").is_some() || self.checked.is_some_and(Stage::rolls)
    }

    /// Where its roll stands.
    pub fn roll(&self) -> Range<usize> {
        self.file.controls.span_of("roll").unwrap_or(self.file.span())
    }
}
