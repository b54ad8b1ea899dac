//! One level of a study: a scene solved at one resolution, with what is compared and what it cost.

use std::ops::ControlFlow;
use std::time::Instant;

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::quantities::{QuantityReader, StageQuantities};
use super::variation::Variation;
use crate::fields::stored;
use crate::history::{CycleRecord, KeptFields, StepRecord, Work};
use crate::model::{MirroredState, SurfaceGrid};
use crate::plan::Plan;
use crate::run::{Iteration, Observer, RunError, Simulation};

/// A solved level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Its resolution.
    pub variation: Variation,
    /// Its grid.
    pub grid: SurfaceGrid,
    /// Quantities of interest at the end of each stage.
    pub ends: Vec<StageQuantities>,
    /// Pressure at the end of the history [pressure], shape `(nx, ny)`.
    #[serde(with = "stored")]
    pub pressure: Array2<f64>,
    /// Shear on the lower body at the end of the history, x and y [pressure].
    #[serde(with = "stored")]
    pub shear: [Array2<f64>; 2],
    /// Work of the whole history.
    pub work: Work,
    /// Time of the whole run, operators included [s].
    pub wall_s: f64,
}

/// Solves a plan and keeps what is compared; `observer` hears of every iteration and increment and may stop the run.
///
/// # Errors
/// As [`Simulation::run`].
pub fn solved_level(plan: &Plan, observer: &mut dyn Observer) -> Result<Level, RunError> {
    let started = Instant::now();
    let mut reader = Reader::of(plan, observer);
    let history = Simulation::new(plan).run(&mut reader)?;
    let ends = reader.ends;
    let work = history.work();
    Ok(Level {
        variation: Variation::of(plan),
        grid: plan.grid,
        ends,
        pressure: history.state.pressure,
        shear: history.state.shear,
        work,
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// How far a plan comes.
#[derive(Debug)]
pub struct Ends {
    /// Quantities of interest at the end of each stage that it comes through.
    pub ends: Vec<StageQuantities>,
    /// Why it does not come through the others, where there are any.
    pub missed: Option<RunError>,
    /// Time of the run, operators included [s].
    pub wall_s: f64,
}

/// Solves a plan as far as it comes; `observer` as in [`solved_level`].
pub fn solved_ends(plan: &Plan, observer: &mut dyn Observer) -> Ends {
    let started = Instant::now();
    let mut reader = Reader::of(plan, observer);
    let missed = Simulation::new(plan).run(&mut reader).err();
    let Reader { mut ends, of_last, .. } = reader;
    // A stage that may have ended sooner than it could is not known to have ended.
    let whole = |end: &StageQuantities| plan.case.stages[end.stage].increments_in_all() == of_last;
    if missed.is_some() && !ends.last().is_some_and(whole) {
        ends.pop();
    }
    Ends { ends, missed, wall_s: started.elapsed().as_secs_f64() }
}

/// Reads quantities of interest of the last increment of every stage, whenever that comes.
struct Reader<'a> {
    quantities: QuantityReader,
    ends: Vec<StageQuantities>,
    /// Increments of the last stage that was read.
    of_last: usize,
    observer: &'a mut dyn Observer,
}

impl<'a> Reader<'a> {
    fn of(plan: &Plan, observer: &'a mut dyn Observer) -> Self {
        Self { quantities: QuantityReader::of(plan), ends: Vec::new(), of_last: 0, observer }
    }
}

impl Observer for Reader<'_> {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.observer.iterated(iteration)
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.observer.cycled(record);
    }

    fn leaves_fields(&self) -> bool {
        false
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        if self.ends.last().is_some_and(|end| end.stage == record.stage) {
            self.ends.pop();
        } else {
            self.of_last = 0;
        }
        self.of_last += 1;
        self.ends.push(self.quantities.read(record, state));
        self.observer.solved(record, state, kept)
    }
}
