//! What is known of a case while it is judged.

use super::file::CaseFile;
use super::loading::Loading;
use super::parts::NamedBody;
use crate::model::stage::Stage;
use crate::model::{ContactPair, CoulombFriction, Dimension, GridSize, Periodicity, Profile};

/// A case as it is written, and what has been judged of it; `None` where that was refused.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub file: &'a CaseFile,
    pub dimension: Dimension,
    pub cells: Option<[usize; 2]>,
    pub size: Option<GridSize>,
    pub bodies: Option<&'a ContactPair>,
    pub profile: Option<&'a Profile>,
    /// The law of friction in each stage.
    pub laws: Option<&'a [&'a CoulombFriction]>,
    pub stages: Option<&'a [Stage]>,
}

impl<'a> Known<'a> {
    /// The stages, as they are written, and judged.
    pub fn loading(&self) -> Loading<'a> {
        Loading { files: &self.file.load.value, checked: self.stages }
    }

    /// The lower and the upper body, as they are written.
    pub fn written(&self) -> [NamedBody<'a>; 2] {
        [("lower", &self.file.lower.value), ("upper", &self.file.upper.value)]
    }

    /// Along which axes the scene repeats, a line contact along none.
    pub fn periodic(&self) -> Periodicity {
        match self.dimension {
            Dimension::Plane => self.file.grid.periodicity(),
            Dimension::Line => Periodicity::NONE,
        }
    }

    /// Whether there is never any friction.
    pub fn is_frictionless(&self) -> bool {
        self.laws.is_some_and(|laws| laws.iter().all(|law| law.is_frictionless()))
    }
}
