//! One rung of a ladder: a scene solved at one resolution, with what is compared and what it cost.

use std::ops::ControlFlow;
use std::time::Instant;

use ndarray::Array2;

use super::headline::Headline;
use super::variation::Variation;
use crate::history::{KeptFields, StepRecord, Work};
use crate::model::{ContactState, SurfaceGrid};
use crate::plan::Plan;
use crate::simulation::{Iteration, Observer, RunError, Simulation};

/// A solved rung.
#[derive(Debug, Clone)]
pub struct Rung {
    /// Its resolution.
    pub variation: Variation,
    /// Its grid.
    pub grid: SurfaceGrid,
    /// Headline numbers at the end of each stage.
    pub ends: Vec<Headline>,
    /// Pressure at the end of the history [pressure], shape `(nx, ny)`.
    pub pressure: Array2<f64>,
    /// Shear on the lower body at the end of the history, x and y [pressure].
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
pub fn climbed(plan: &Plan, observer: &mut dyn Observer) -> Result<Rung, RunError> {
    let started = Instant::now();
    let mut ends = Ends { grid: plan.grid, last: last_increments(plan), ends: Vec::new(), observer };
    let history = Simulation::new(plan).run(&mut ends)?;
    let ends = ends.ends;
    let work = history.work();
    Ok(Rung {
        variation: Variation::of(plan),
        grid: plan.grid,
        ends,
        pressure: history.state.pressure,
        shear: history.state.shear,
        work,
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// Numbers of the last increments of the stages.
fn last_increments(plan: &Plan) -> Vec<usize> {
    let mut done = 0;
    let last = |stage: &crate::case::Stage| {
        done += stage.increments_in_all();
        done - 1
    };
    plan.case.stages.iter().map(last).collect()
}

/// Reads headline numbers at the end of every stage.
struct Ends<'a> {
    grid: SurfaceGrid,
    last: Vec<usize>,
    ends: Vec<Headline>,
    observer: &'a mut dyn Observer,
}

impl Observer for Ends<'_> {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.observer.iterated(iteration)
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: &ContactState,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        if self.last.contains(&record.increment) {
            self.ends.push(Headline::new(&self.grid, record, state));
        }
        self.observer.solved(record, state, kept)
    }
}
