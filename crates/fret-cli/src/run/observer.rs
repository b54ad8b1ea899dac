//! What happens while `fret run` solves: records counted, shown, written down.

use std::ops::ControlFlow;
use std::time::Instant;

use fret_core::history::{CycleRecord, KeptFields, StepRecord};
use fret_core::model::MirroredState;
use fret_core::run::{Iteration, Observer, Waypoint};
use fret_core::study::QuantityReader;

use super::progress::Progress;
use crate::failure::Failure;
use fret_results::{ResultFolder, Tally};

/// Somebody else who hears about a run, and may stop it.
pub type Guest<'a> = dyn Observer + Send + 'a;

/// Time of the whole run, that before it was broken off included.
pub struct Clock {
    pub started: Instant,
    pub before_s: f64,
}

impl Clock {
    pub fn read(&self) -> f64 {
        self.before_s + self.started.elapsed().as_secs_f64()
    }
}

/// Hears about the run: counts it, shows it, writes it down, and stops it when asked to or when it cannot be written down.
pub struct RunObserver<'a> {
    pub folder: ResultFolder,
    pub progress: Progress,
    pub tally: Tally,
    pub clock: Clock,
    /// Reads quantities of interest.
    pub quantities: QuantityReader,
    pub failure: Option<Failure>,
    /// Who else hears about it.
    pub guest: &'a mut Guest<'a>,
}

impl RunObserver<'_> {
    /// Goes on after a good writing; remembers why after a bad one.
    fn after<E: Into<Failure>>(&mut self, writing: Result<(), E>) -> ControlFlow<()> {
        match writing {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.failure = Some(error.into());
                ControlFlow::Break(())
            }
        }
    }
}

impl Observer for RunObserver<'_> {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.progress.iterated(iteration, &self.tally);
        self.guest.iterated(iteration)
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let writing = self.folder.keep(record, kept);
        self.after(writing)?;
        self.tally.add(record);
        self.tally.read(self.quantities.read(record, state));
        self.progress.solved(record, &self.tally);
        self.guest.solved(record, state, kept)
    }

    fn leaves_fields(&self) -> bool {
        false // they are written down
    }

    fn cycled(&mut self, record: &CycleRecord) {
        if self.failure.is_none() {
            self.failure = self.folder.keep_cycle(record).err().map(Failure::from);
            self.tally.add_cycle(record);
            self.progress.cycled(record, &self.tally);
            self.guest.cycled(record);
        }
    }

    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        if self.failure.is_some() {
            return ControlFlow::Break(());
        }
        let writing = self.folder.reached(waypoint, &self.tally, self.clock.read());
        self.after(writing)
    }
}
