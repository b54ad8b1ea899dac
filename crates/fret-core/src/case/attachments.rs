//! Files a case names beside itself: tables, heights, maps. The core opens none; whoever hands in the text hands them in too.

use ndarray::Array2;

use crate::model::LoadStep;

/// Files and arrays that come with the text of a case, and the loads its history starts from.
#[derive(Clone, Copy)]
pub struct Attachments<'a> {
    /// Content of a file by the name the case gives it, or in a few words why it cannot be had.
    pub file: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    /// Arrays handed over, named in the case by their number: `{ array = n }`.
    pub arrays: &'a [Array2<f64>],
    /// What is prescribed where the history starts; `None`: bodies that have not touched yet.
    pub start: Option<LoadStep>,
}

impl<'a> Attachments<'a> {
    /// For a case that comes alone: every file is missing.
    pub fn none() -> Self {
        Self::files(&|_| Err("this case was read without a place to look for files".to_owned()))
    }

    /// Files only.
    pub fn files(file: &'a dyn Fn(&str) -> Result<Vec<u8>, String>) -> Self {
        Self { file, arrays: &[], start: None }
    }

    /// The same for a history that starts from a solved state.
    #[must_use]
    pub fn starting_from(self, start: Option<LoadStep>) -> Self {
        Self { start, ..self }
    }
}
