//! Controls that a kind of contact has no place for.

use std::ops::Range;

use super::judge::Judge;
use super::loading::Loading;
use crate::model::controls::{Kind, NORMAL};
use crate::model::stage::StageControl;

/// Controls: their degrees of freedom, whether motions alone, and what a table's column of them is called.
pub(super) struct Misfit {
    pub freedoms: Range<usize>,
    pub motions: bool,
    pub in_table: &'static str,
}

impl Misfit {
    /// Refuses them wherever a stage prescribes them.
    pub fn refuse(&self, judge: &mut Judge, loading: Loading<'_>, why: &str, help: &str) {
        for stage in loading.stages() {
            // A mean gap is judged where it is read, and its motion is that of surfaces which have one.
            if self.motions && self.freedoms.contains(&NORMAL) && judge.by_mean_gap.contains(&stage.index) {
                continue;
            }
            let is_meant = |control: &StageControl| !self.motions || control.is_motion();
            let table = stage.by_table(|stage| {
                stage.by_freedom()[self.freedoms.clone()].iter().flatten().any(|control| is_meant(control))
            });
            let keys = stage.file.controls.0.iter().filter(|given| {
                self.freedoms.contains(&given.row.freedom) && (!self.motions || given.way.kind != Kind::Force)
            });
            let keys = keys.map(|given| (given.way.name, given.span()));
            for (key, span) in keys.chain(table.map(|table| (self.in_table, table))) {
                judge.refuse::<()>(span, format!("{key} {why}"), help);
            }
        }
    }
}
