//! The frictionless problem in a region or on some of its cells: the fields both iterations work on, and how they report.

use super::super::laws::complementarity::{CellLaw, NormalResidual, height_below, length_scale};
use super::super::laws::projection::project_pressure;
use super::super::laws::tilt_motions::TiltMotions;
use super::super::normal_response::NormalResponse;
use super::super::prescribed::NormalLoad;
use super::super::settings::{IterationCallback, SolveError};
use super::equations::NormalEquations;
use super::first_pressure::first_pressure;
use super::yielding;
use crate::fields::{CellRule, Reals, each_cell, lower};

/// Iterations at the most, of both methods together.
const MOST_ITERATIONS: usize = 8000;

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ending {
    /// The residual is below the tolerance; pressures are feasible and displacements are theirs.
    Solved(NormalResidual),
    /// It makes no progress; pressures are feasible and displacements are theirs.
    Stalled,
}

/// What the normal solver reached.
#[derive(Debug)]
pub struct NormalSolution {
    /// Approach and residual.
    pub residual: NormalResidual,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Iterations made.
    pub iterations: usize,
}

/// Unknowns, work fields and response of one normal problem. Fields are flat rows of one length, made once.
pub struct NormalIteration<'a> {
    pub task: &'a NormalEquations<'a>,
    /// Pressure [pressure].
    pub pressure: &'a mut [f64],
    /// Its displacement [length].
    pub displacement: &'a mut [f64],
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Cells on which pressure is unknown: 1, all others: 0.
    pub active: Vec<f64>,
    /// Gap on the active cells, zero elsewhere [length].
    pub residual: Vec<f64>,
    /// Preconditioned residual [pressure].
    pub steepest: Vec<f64>,
    /// Change of pressure, and its displacement.
    pub change: Vec<f64>,
    pub image: Vec<f64>,
    /// The change before, and its displacement.
    pub last_change: Vec<f64>,
    pub last_image: Vec<f64>,
    response: &'a mut dyn NormalResponse,
    /// Influence of a cell on itself [length/pressure].
    pub self_influence: f64,
    pub tolerance: f64,
    callback: IterationCallback<'a>,
    /// Where a moment is prescribed: the motions, the tilts found last [length], and the gap before deformation turned by them.
    pub tilt: Option<TiltMotions>,
    pub turned: [f64; 2],
    pub level: Option<Vec<f64>>,
    /// Iterations so far.
    pub iterations: usize,
    /// Least residual so far.
    pub best: f64,
}

impl<'a> NormalIteration<'a> {
    /// The problem from a feasible pressure; finds its displacement.
    pub fn new(
        task: &'a NormalEquations<'a>,
        [pressure, displacement]: [&'a mut [f64]; 2],
        response: &'a mut dyn NormalResponse,
        tolerance: f64,
        callback: IterationCallback<'a>,
    ) -> Self {
        let field = || vec![0.0; task.undeformed.len()];
        response.displacement(pressure, displacement);
        lower(displacement, -task.load.given_way(pressure));
        Self {
            gap: field(),
            active: field(),
            residual: field(),
            steepest: field(),
            change: field(),
            image: field(),
            last_change: field(),
            last_image: field(),
            self_influence: response.self_influence(),
            tolerance,
            tilt: task.tilt(),
            turned: [0.0; 2],
            level: None,
            iterations: 0,
            best: f64::INFINITY,
            task,
            pressure,
            displacement,
            response,
            callback,
        }
    }

    /// Reports a residual.
    ///
    /// # Errors
    /// When the caller stopped the iteration, or it has gone on for too long.
    pub fn report(&mut self, residual: f64) -> Result<(), SolveError> {
        if (self.callback)(self.iterations, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        self.best = self.best.min(residual);
        if self.iterations >= MOST_ITERATIONS {
            return Err(SolveError::NotConverged { reached: self.best, iterations: self.iterations });
        }
        Ok(())
    }

    /// `image` becomes the displacement of `change`.
    pub fn convolve_change(&mut self) {
        self.iterations += 1;
        self.response.displacement(&self.change, &mut self.image);
        lower(&mut self.image, -self.task.load.given_way(&self.change));
    }

    /// `displacement` becomes that of `pressure`.
    pub fn convolve_pressure(&mut self) {
        self.iterations += 1;
        self.response.displacement(self.pressure, self.displacement);
        lower(self.displacement, -self.task.load.given_way(self.pressure));
    }

    /// `steepest` becomes the preconditioned residual, on all cells.
    pub fn precondition(&mut self) {
        self.response.inverse(&self.residual, &mut self.steepest);
    }

    /// Tilts the body so that the cells with weights are nearest to one height, where a moment is prescribed.
    pub fn turn(&mut self, weights: impl Fn(&Self, usize) -> f64) {
        if let Some(tilt) = &self.tilt {
            let heights = (&*self.displacement, self.task.undeformed, self.task.load.approach);
            let (turned, level) = tilt.turn(|cell| weights(self, cell), heights);
            (self.turned, self.level) = (turned, Some(level));
        }
    }

    /// What a cell knows of its pressure.
    pub fn law(&self) -> CellLaw {
        CellLaw::under(&self.task.load, self.self_influence)
    }

    /// Brings pressure to what is allowed; pressure on all cells, where what there is carries no such force or moment.
    pub fn project_pressure(&mut self) {
        if let Some(hardness) = self.task.load.hardness {
            if !yielding::make_feasible(self.pressure, self.task.load.total, hardness) {
                self.pressure.copy_from_slice(&first_pressure(self.task, self.self_influence));
            }
            return;
        }
        let carried = project_pressure(self.pressure, self.task.load.total, self.tilt.as_ref());
        if let (Some(tilt), false) = (&self.tilt, carried) {
            tilt.on_all_cells(self.pressure);
        }
    }

    /// Whether pressure has the moments that are prescribed.
    pub fn has_moments(&self) -> bool {
        self.tilt.as_ref().is_none_or(|tilt| tilt.is_held_by(self.pressure))
    }

    /// Height `u + g0` into `gap`; the approach (mean height of the loaded cells under a force) and what violations are
    /// measured by. `None` when no cell is loaded.
    pub fn measure(&mut self) -> (f64, Option<f64>) {
        self.turn(|problem, cell| f64::from(u8::from(problem.pressure[cell] > 0.0)));
        let undeformed = self.level.as_deref().unwrap_or(self.task.undeformed);
        let read = [&*self.displacement, undeformed, &*self.pressure];
        let [heights, count, work, load] = each_cell(&Measure, read, [&mut self.gap]);
        let NormalLoad { total, approach, hardness, .. } = self.task.load;
        let approach = match (total, hardness) {
            (Some(_), Some(hardness)) => height_below(hardness, self.pressure, &self.gap).unwrap_or(approach),
            (Some(_), None) if count > 0.0 => heights / count,
            _ => approach,
        };
        // Of the body: displacements here have in them what the machine gives.
        let given = self.task.load.give * load;
        let scale =
            || length_scale(work / load - given, [self.self_influence, load / count], approach - given);
        (approach, (load > 0.0).then(scale))
    }

    /// Adds `fraction` of the change to pressures and displacements; rounding leaves no tension and nothing above the hardness.
    pub fn advance(&mut self, fraction: f64) {
        let rule = Advance { fraction, hardness: self.law().hardness };
        let write = [&mut *self.pressure, &mut *self.displacement];
        each_cell(&rule, [&self.change[..], &self.image], write);
    }

    /// What was changed becomes what was changed last.
    pub fn remember(&mut self) {
        std::mem::swap(&mut self.change, &mut self.last_change);
        std::mem::swap(&mut self.image, &mut self.last_image);
    }
}

/// Height; sums of the heights of loaded cells, of these, of work and of load.
struct Measure;

impl CellRule<3, 1, 4> for Measure {
    #[inline(always)]
    fn at<R: Reals>(&self, [u, undeformed, p]: [R; 3], [height]: &mut [R; 1]) -> [R; 4] {
        let (zero, one) = (p.all(0.0), p.all(1.0));
        *height = u + undeformed;
        let loaded = p.if_at_most(zero, zero, one);
        [loaded * *height, loaded, p * u, p]
    }
}

struct Advance {
    fraction: f64,
    hardness: f64,
}

impl CellRule<2, 2, 0> for Advance {
    #[inline(always)]
    fn at<R: Reals>(&self, [change, image]: [R; 2], [p, u]: &mut [R; 2]) -> [R; 0] {
        *p = (*p + change * self.fraction).max(p.all(0.0)).min(p.all(self.hardness));
        *u = *u + image * self.fraction;
        []
    }
}
