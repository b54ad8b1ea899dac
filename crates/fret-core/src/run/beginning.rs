//! A common beginning of several histories, solved once: those whose first stages are alike go on from its checkpoint, with the bits that
//! each of them would have alone.

use std::ops::ControlFlow;

use super::checkpoint::{Checkpoint, Waypoint};
use super::observer::{Iteration, Observer, Part};
use super::run_error::RunError;
use super::simulation::Simulation;
use crate::history::{CycleRecord, History, KeptFields, StepRecord};
use crate::model::MirroredState;

/// The first stages of a history, solved.
#[derive(Debug, Clone)]
pub struct Beginning {
    checkpoint: Checkpoint,
    steps: Vec<StepRecord>,
    cycles: Vec<CycleRecord>,
}

impl Beginning {
    /// Increments of it.
    pub fn increments(&self) -> usize {
        self.steps.len()
    }

    /// Solves what is left of a history after this beginning. The history has all increments and cycles, and the fields kept after it.
    pub fn followed_by(
        &self,
        simulation: &Simulation<'_>,
        observer: &mut dyn Observer,
    ) -> (History, Result<(), RunError>) {
        let (mut history, outcome) = simulation.follow(self.checkpoint.clone(), observer);
        history.steps.splice(0..0, self.steps.iter().cloned());
        history.cycles.splice(0..0, self.cycles.iter().cloned());
        (history, outcome)
    }
}

impl Simulation<'_> {
    /// Solves the first stages of the history, so many of them; `None` where surfaces are worn to the limit in them.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub(super) fn beginning(
        &self,
        stages: usize,
        observer: &mut dyn Observer,
    ) -> Result<Option<Beginning>, RunError> {
        let mut until = Until { stages, observer, checkpoint: None };
        let (history, outcome) = self.follow(Checkpoint::start(self.plan()), &mut until);
        let Some(checkpoint) = until.checkpoint else { return outcome.map(|()| None) };
        let worn_out = checkpoint.place.worn_out;
        Ok((!worn_out).then_some(Beginning { checkpoint, steps: history.steps, cycles: history.cycles }))
    }
}

/// Stops a run when its first stages are over.
struct Until<'a> {
    stages: usize,
    observer: &'a mut dyn Observer,
    checkpoint: Option<Checkpoint>,
}

impl Observer for Until<'_> {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.observer.iterated(iteration)
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        self.observer.solved(record, state, kept)
    }

    fn hears_parts(&self) -> bool {
        self.observer.hears_parts()
    }

    fn passed(&mut self, part: &Part<'_>) {
        self.observer.passed(part);
    }

    fn leaves_fields(&self) -> bool {
        false
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.observer.cycled(record);
    }

    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        self.observer.reached(waypoint)?;
        if waypoint.place.stage < self.stages {
            return ControlFlow::Continue(());
        }
        self.checkpoint = Some(waypoint.checkpoint());
        ControlFlow::Break(())
    }
}
