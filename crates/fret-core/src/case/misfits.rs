//! Controls that a kind of contact has no place for.

use std::ops::Range;

use super::judge::Judge;
use super::stage_file::StageFile;
use crate::document::At;
use crate::model::controls::{Kind, NORMAL};
use crate::model::stage::{Stage, StageControl};

/// The stages as they are written, and checked.
pub(super) type Loading<'a> = (&'a [At<StageFile>], Option<&'a [Stage]>);

/// Controls: their degrees of freedom, whether motions alone, and what a table's column of them is called.
pub(super) struct Misfit {
    pub freedoms: Range<usize>,
    pub motions: bool,
    pub in_table: &'static str,
}

impl Misfit {
    /// Refuses them wherever a stage prescribes them.
    pub fn refuse(&self, judge: &mut Judge, (files, checked): Loading<'_>, why: &str, help: &str) {
        for (index, file) in files.iter().enumerate() {
            // A mean gap is judged where it is read, and its motion is that of surfaces which have one.
            if self.motions && self.freedoms.contains(&NORMAL) && judge.by_mean_gap.contains(&index) {
                continue;
            }
            let is_meant = |control: &StageControl| !self.motions || control.is_motion();
            let in_table = checked.and_then(|checked| checked.get(index)).is_some_and(|stage| {
                stage.by_freedom()[self.freedoms.clone()].iter().flatten().any(|control| is_meant(control))
            });
            let keys = file.controls.0.iter().filter(|given| {
                self.freedoms.contains(&given.row.freedom) && (!self.motions || given.way.kind != Kind::Force)
            });
            let keys = keys.map(|given| (given.way.name, given.span()));
            let table = file.table.as_ref().filter(|_| in_table).map(|table| (self.in_table, table.span()));
            for (key, span) in keys.chain(table) {
                judge.refuse::<()>(span, format!("{key} {why}"), help);
            }
        }
    }
}
