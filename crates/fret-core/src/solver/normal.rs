//! Pressure alone: projected, preconditioned conjugate gradients, one convolution an iteration. Pressures stay feasible
//! throughout; a nearly empty cell that is pulled apart leaves; the energy never rises.

use super::preconditioner::Preconditioner;
use super::residual::{NormalVerdict, judge_normal};
use super::settings::{SolveError, SolverSettings, Watch};
use crate::compliance::SurfaceCompliance;
use crate::model::field::{dot, sum};

/// What the normal equations of one increment ask for, over the cells of a box.
#[derive(Debug)]
pub struct NormalTask<'a> {
    /// Gap before deformation, with whatever else moves the surfaces at given shear [length].
    pub undeformed: &'a [f64],
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach, when it is prescribed [length].
    pub approach: f64,
}

/// What the normal solver reached.
#[derive(Debug)]
pub struct NormalSolution {
    /// Approach and residual.
    pub verdict: NormalVerdict,
    /// Gap [length].
    pub gap: Vec<f64>,
    /// Iterations made.
    pub iterations: usize,
}

/// Solves the normal equations from a feasible `pressure` with its `displacement`; both end at the solution.
pub fn solve_normal(
    task: &NormalTask<'_>,
    pressure: &mut [f64],
    displacement: &mut [f64],
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<NormalSolution, SolveError> {
    let len = pressure.len();
    let own = compliance.own().normal;
    let prescribed = if task.total.is_none() { Some(task.approach) } else { None };
    let mut pace = Pace::default();
    let mut last: Option<(Vec<f64>, Vec<f64>)> = None;
    let mut image = vec![0.0; len];
    let mut z = vec![0.0; len];
    let most = 40 * settings.most_outer_iterations;
    for iteration in 0..most {
        let mut gap: Vec<f64> = displacement.iter().zip(task.undeformed).map(|(u, g)| u + g).collect();
        let verdict = judge_normal(pressure, &mut gap, task.undeformed, own, prescribed);
        if watch(iteration, verdict.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if verdict.residual < settings.tolerance {
            return Ok(NormalSolution { verdict, gap, iterations: iteration });
        }
        if pace.hears(iteration, verdict.residual) {
            last = None;
        }
        let set = ActiveSet::new(task, pressure, &gap, own / pace.leave_below);
        let residual = set.restricted(&gap);
        preconditioner.normal(&residual, &mut z);
        let z = set.restricted(&z);
        let along = set.direction(&residual, &z, last.as_ref());
        // Clipped before the convolution with a step guessed from the last line search, so that what is convolved is
        // feasible and the displacement stays linear in it.
        let guess = pace.guess();
        let target = set.feasible(pressure, &along, guess);
        let change: Vec<f64> = target.iter().zip(pressure.iter()).map(|(t, p)| t - p).collect();
        compliance.normal(&change, &mut image);
        let curvature = dot(&change, &image);
        let exact = -dot(&gap, &change) / curvature;
        if !(curvature > 0.0 && exact > 0.0) {
            last = None;
            if pace.retreats() {
                continue;
            }
            break;
        }
        let share = within_reach(pressure, &change, exact);
        for cell in 0..len {
            pressure[cell] = (pressure[cell] + share * change[cell]).max(0.0);
            displacement[cell] += share * image[cell];
        }
        pace.advances(guess * exact);
        last = Some((change, image.clone()));
    }
    Err(SolveError::NotConverged { reached: pace.best, iterations: most })
}

/// Step length and patience of the iteration.
#[derive(Debug)]
struct Pace {
    step: f64,
    /// A loaded cell leaves when its own pressure could close less than this share of its gap.
    leave_below: f64,
    best: f64,
    best_at: usize,
    careful: usize,
}

impl Default for Pace {
    fn default() -> Self {
        Self { step: 0.8, leave_below: 0.15, best: f64::INFINITY, best_at: 0, careful: 0 }
    }
}

impl Pace {
    /// Takes note of a residual; true when a few short steps should be taken because it has not halved for long.
    fn hears(&mut self, iteration: usize, residual: f64) -> bool {
        let stalls = residual >= 0.5 * self.best && iteration > self.best_at + 10 && self.careful == 0;
        if residual < 0.5 * self.best || stalls {
            self.best_at = iteration;
        }
        if stalls {
            self.careful = 4;
        }
        self.best = self.best.min(residual);
        stalls
    }

    fn guess(&self) -> f64 {
        if self.careful > 0 { 0.3 * self.step } else { self.step }
    }

    fn advances(&mut self, step: f64) {
        self.step = step.clamp(0.2, 1.5);
        self.careful = self.careful.saturating_sub(1);
    }

    /// A step that would raise the energy is not taken; false when steps have become too short to go on.
    fn retreats(&mut self) -> bool {
        self.step *= 0.3;
        self.leave_below *= 0.5;
        self.step > 1e-12
    }
}

/// Cells on which pressure is unknown in one iteration.
struct ActiveSet<'a> {
    task: &'a NormalTask<'a>,
    active: Vec<bool>,
    leaving: Vec<usize>,
}

impl<'a> ActiveSet<'a> {
    /// Loaded or overlapping cells, without nearly empty ones that are pulled apart by more than `stretch` times what
    /// their own pressure closes.
    fn new(task: &'a NormalTask<'_>, pressure: &[f64], gap: &[f64], stretch: f64) -> Self {
        let leaves = |cell: usize| pressure[cell] > 0.0 && pressure[cell] * stretch < gap[cell];
        let cells = 0..pressure.len();
        let active = cells.clone().map(|c| (pressure[c] > 0.0 || gap[c] < 0.0) && !leaves(c)).collect();
        Self { task, active, leaving: cells.filter(|&cell| leaves(cell)).collect() }
    }

    /// A field on the set, zero elsewhere; its mean taken off where the force is prescribed.
    fn restricted(&self, field: &[f64]) -> Vec<f64> {
        let mut part: Vec<f64> = field
            .iter()
            .zip(&self.active)
            .map(|(value, active)| if *active { *value } else { 0.0 })
            .collect();
        if self.task.total.is_some() {
            let count = self.active.iter().filter(|active| **active).count().max(1);
            let mean = sum(&part) / count as f64;
            for (value, active) in part.iter_mut().zip(&self.active) {
                if *active {
                    *value -= mean;
                }
            }
        }
        part
    }

    /// Downhill direction: the preconditioned residual, made conjugate to the last change where that still points down.
    fn direction(&self, residual: &[f64], z: &[f64], last: Option<&(Vec<f64>, Vec<f64>)>) -> Vec<f64> {
        let steepest: Vec<f64> = z.iter().map(|value| -value).collect();
        let Some((change, image)) = last else { return steepest };
        let inside: Vec<f64> = change
            .iter()
            .zip(&self.active)
            .map(|(value, active)| if *active { *value } else { 0.0 })
            .collect();
        let curvature = dot(&inside, image);
        if !(curvature > 0.0) {
            return steepest;
        }
        let beta = dot(z, image) / curvature;
        let conjugate: Vec<f64> = steepest.iter().zip(&inside).map(|(a, b)| a + beta * b).collect();
        let conjugate = self.restricted(&conjugate);
        if dot(&conjugate, residual) < 0.0 { conjugate } else { steepest }
    }

    /// Pressure after a step, without tension, without the leaving cells, under the prescribed force.
    fn feasible(&self, pressure: &[f64], along: &[f64], step: f64) -> Vec<f64> {
        let mut target: Vec<f64> = pressure.iter().zip(along).map(|(p, d)| (p + step * d).max(0.0)).collect();
        for &cell in &self.leaving {
            target[cell] = 0.0;
        }
        if let Some(total) = self.task.total {
            let found = sum(&target);
            if found > 0.0 {
                for p in &mut target {
                    *p *= total / found;
                }
            }
        }
        target
    }
}

/// Share of a change that keeps every pressure from becoming tension; at least the feasible change itself.
fn within_reach(pressure: &[f64], change: &[f64], wanted: f64) -> f64 {
    if wanted <= 1.0 {
        return wanted;
    }
    let limit = pressure
        .iter()
        .zip(change)
        .filter(|(_, c)| **c < 0.0)
        .map(|(p, c)| -p / c)
        .fold(f64::INFINITY, f64::min);
    wanted.min(limit).max(1.0)
}

/// A first pressure for a scene that repeats: the one of full contact, without its tension.
pub fn full_contact_pressure(task: &NormalTask<'_>, preconditioner: &mut Preconditioner) -> Option<Vec<f64>> {
    let mean = task.total? / task.undeformed.len() as f64;
    let mut removed = vec![0.0; task.undeformed.len()];
    preconditioner.normal(task.undeformed, &mut removed);
    let mut pressure: Vec<f64> = removed.iter().map(|part| (mean - part).max(0.0)).collect();
    let found = sum(&pressure);
    if !(found > 0.0) {
        return None;
    }
    for p in &mut pressure {
        *p *= mean * task.undeformed.len() as f64 / found;
    }
    Some(pressure)
}

/// A first pressure: uniform over the eighth of the cells with the smallest gap under a force, the mattress of self
/// influences under an approach.
pub fn first_pressure(task: &NormalTask<'_>, own: f64) -> Vec<f64> {
    match task.total {
        Some(total) => {
            let mut gaps: Vec<f64> = task.undeformed.to_vec();
            let eighth = (gaps.len() / 8).max(1);
            let (_, limit, _) = gaps.select_nth_unstable_by(eighth - 1, f64::total_cmp);
            let limit = *limit;
            let count = task.undeformed.iter().filter(|gap| **gap <= limit).count();
            task.undeformed.iter().map(|gap| if *gap <= limit { total / count as f64 } else { 0.0 }).collect()
        }
        None => task.undeformed.iter().map(|gap| ((task.approach - gap) / own).max(0.0) * 0.1).collect(),
    }
}
