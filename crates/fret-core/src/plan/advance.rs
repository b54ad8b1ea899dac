//! How far a run has come in the history that was planned: cycles that a computed one stands for are behind it too.

use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::history::{CycleRecord, StepRecord};

/// Increments of a stage as planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct Planned {
    /// All of them.
    all: usize,
    /// Those of one cycle.
    of_cycle: usize,
}

/// How far a run has come, in planned increments.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Advance {
    stages: Vec<Planned>,
    /// The stage at work.
    stage: usize,
    /// Planned increments behind it in that stage, up to the last cycle that is over.
    in_cycles: usize,
    /// Increments solved since.
    since: usize,
}

impl Advance {
    /// A run of `case` that has yet to start.
    pub fn new(case: &Case) -> Self {
        let planned = |stage: &crate::case::Stage| Planned {
            all: stage.increments_in_all(),
            of_cycle: stage.increments,
        };
        Self { stages: case.stages.iter().map(planned).collect(), stage: 0, in_cycles: 0, since: 0 }
    }

    /// An increment is solved.
    pub fn solved(&mut self, record: &StepRecord) {
        if record.stage != self.stage {
            (self.stage, self.in_cycles, self.since) = (record.stage, 0, 0);
        }
        self.since += 1;
    }

    /// A cycle is over; its last increment was solved just before. One that ends its stage leaves nothing of it to be solved.
    pub fn cycled(&mut self, record: &CycleRecord) {
        let Planned { all, of_cycle } = self.stages[self.stage];
        self.in_cycles = if record.steady { all } else { self.in_cycles + record.stands_for * of_cycle };
        self.since = 0;
    }

    /// Planned increments that are behind the run.
    pub fn passed(&self) -> usize {
        let before: usize = self.stages[..self.stage].iter().map(|stage| stage.all).sum();
        before + (self.in_cycles + self.since).min(self.stages[self.stage].all)
    }

    /// Planned increments in all.
    pub fn planned(&self) -> usize {
        self.stages.iter().map(|stage| stage.all).sum()
    }
}
