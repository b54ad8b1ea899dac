//! Files a case names beside itself: tables, heights, maps. The core looks for none; whoever hands in the text hands them in too.

use ndarray::Array2;

use crate::model::LoadStep;
use crate::topography::ReadScan;

/// Files and arrays that come with the text of a case, and the loads its history starts from.
#[derive(Clone, Copy)]
pub struct Attachments<'a> {
    /// Content of a file by the name the case gives it, or in a few words why it cannot be had.
    pub file: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    /// Heights of a file of an instrument by its name and that of a channel (the first with heights, if none is named), or why they cannot
    /// be had; `None`: such files are not read here.
    pub scan: Option<&'a ReadScan<'a>>,
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
        Self { file, scan: None, arrays: &[], start: None }
    }

    /// The same with a reader of instruments' files.
    #[must_use]
    pub fn reading_scans(self, scan: Option<&'a ReadScan<'a>>) -> Self {
        Self { scan, ..self }
    }

    /// The same for a history that starts from a solved state.
    #[must_use]
    pub fn starting_from(self, start: Option<LoadStep>) -> Self {
        Self { start, ..self }
    }
}
