//! Who hears about a run, and may stop it.

use std::ops::ControlFlow;

use super::checkpoint::Waypoint;
use crate::history::{CycleRecord, KeptFields, StepRecord};
use crate::model::MirroredState;

/// Where an increment's iteration stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Number of the increment in the whole history, from 0.
    pub increment: usize,
    /// Number of its stage, from 0.
    pub stage: usize,
    /// Iteration within the increment.
    pub iteration: usize,
    /// Residual reached so far.
    pub residual: f64,
    /// Residual asked for.
    pub tolerance: f64,
}

/// A part of an increment, where that is solved in more than one.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a> {
    /// Share of the way of the increment at its end; 1 in the last.
    pub share: f64,
    /// What would be recorded of it as an increment, without what is told where an increment ends (wear, debris, yielding, rates by distance rolled):
    /// sums of the history end with it, and the work is its own.
    pub record: &'a StepRecord,
    /// Its end.
    pub state: MirroredState<'a>,
    /// Its fields but wear and debris, where those of the increment may be kept in the history.
    pub kept: Option<&'a KeptFields>,
}

/// Hears about a run and may stop it.
pub trait Observer {
    /// An iteration was done. `Break` stops the run.
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        let _ = iteration;
        ControlFlow::Continue(())
    }

    /// An increment is solved and heard of, and its cycle when that is over: where the run stands now, for those who store it.
    /// `Break` stops the run after it.
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        let _ = waypoint;
        ControlFlow::Continue(())
    }

    /// An increment is solved; `kept` holds its fields, of the whole contact, when they are kept. `Break` stops the run after it.
    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let _ = (record, state, kept);
        ControlFlow::Continue(())
    }

    /// Whether it hears of parts of increments.
    fn hears_parts(&self) -> bool {
        false
    }

    /// A part of an increment is solved. A way through the increment that is given up is followed by another one, whose shares begin anew; the
    /// increment itself is heard of after its last part.
    fn passed(&mut self, part: &Part<'_>) {
        let _ = part;
    }

    /// Whether the history is to hold the kept fields. An observer that has done with them once it has heard of them says no.
    fn leaves_fields(&self) -> bool {
        true
    }

    /// A cycle is over; its last increment was solved just before.
    fn cycled(&mut self, record: &CycleRecord) {
        let _ = record;
    }
}

/// Hears nothing and stops nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {}
