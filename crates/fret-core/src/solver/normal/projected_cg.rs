//! Projected, preconditioned conjugate gradients (Polonsky & Keer 1999, with a preconditioner and an exact line search), one operator
//! application an iteration: pressures stay feasible throughout; a nearly empty cell that is pulled apart leaves; the energy never
//! rises. Where surfaces yield, pressures have a second bound, the hardness; it is infinite elsewhere.

use super::super::laws::complementarity::{CellLaw, NormalResidual, violation};
use super::super::settings::SolveError;
use super::problem::{Ending, NormalIteration};
use super::yielding;
use crate::fields::{CellRule, CellSize, Reals, add_scaled, dot, each_cell, largest_of};

/// A loaded cell leaves when its own pressure could close less than this fraction of its gap.
const LEAVE_BELOW: f64 = 0.15;

/// Iterates until solved, or until `max_stalled` iterations have not halved the residual.
///
/// # Errors
/// When the caller stopped the iteration, or it has gone on for too long.
pub fn iterate(problem: &mut NormalIteration<'_>, max_stalled: usize) -> Result<Ending, SolveError> {
    let (self_influence, law) = (problem.self_influence, problem.law());
    let by_force = problem.task.load.total.is_some();
    let mut step = 0.8_f64;
    let mut leave_below = LEAVE_BELOW;
    let mut conjugate = false;
    let mut best = f64::INFINITY;
    let mut waited = 0;
    loop {
        let (approach, scale) = problem.measure();
        let stretch = self_influence / leave_below;
        let NormalIteration { gap, residual, active, pressure, .. } = &mut *problem;
        let (read, write) = ([&**pressure], [&mut gap[..], residual, active]);
        let [gaps, count] = each_cell(&Sets { approach, stretch, hardness: law.hardness }, read, write);
        let worst = violation(gap, pressure, law);
        let residual = scale.map_or(if worst > 0.0 { 1.0 } else { 0.0 }, |scale| worst / scale);
        problem.report(residual)?;
        if residual < problem.tolerance {
            return Ok(Ending::Solved(NormalResidual { approach, turned: problem.turned, residual }));
        }
        waited += 1;
        if residual < 0.5 * best {
            (best, waited) = (residual, 0);
        }
        if waited > max_stalled {
            return Ok(Ending::Stalled);
        }
        let mean = if by_force { gaps / count.max(1.0) } else { 0.0 };
        if let Some(tilt) = &problem.tilt {
            tilt.take_off(&mut problem.residual, &problem.active);
        } else if mean != 0.0 {
            add_scaled(&mut problem.residual, -mean, &problem.active);
        }
        problem.precondition();
        if let Some(tilt) = &problem.tilt {
            tilt.take_off(&mut problem.steepest, &problem.active);
        }
        let along = Direction::new(problem, conjugate, by_force.then_some(count.max(1.0)));
        if !along.clip(problem, step) {
            return Ok(Ending::Stalled);
        }
        // Clipped before the convolution with a step guessed from the last line search, so that what is convolved is
        // feasible and the displacement stays linear in it.
        problem.convolve_change();
        let NormalIteration { change, image, gap, pressure, .. } = &mut *problem;
        let (curvature, slope) = (dot(change, image), dot(gap, change));
        let steepest = largest_of(&Steepest { hardness: law.hardness }, [change, pressure]);
        let exact = -slope / curvature;
        if !(curvature > 0.0 && exact > 0.0) {
            step *= 0.3;
            leave_below *= 0.5;
            conjugate = false;
            if step < 1e-12 {
                return Ok(Ending::Stalled);
            }
            continue;
        }
        // Beyond the change itself as far as no pressure becomes tension, or more than the hardness.
        let fraction = if exact > 1.0 { exact.min((1.0 / steepest).max(1.0)) } else { exact };
        problem.advance(fraction);
        step = (step * exact).clamp(0.2, 1.5);
        problem.remember();
        conjugate = true;
    }
}

/// Downhill direction on the active cells: `-(z - mean) + beta last - mean`.
struct Direction {
    /// Factor of the last change.
    beta: f64,
    /// Added on active cells, so that the sum stays.
    constant: f64,
}

impl Direction {
    /// The preconditioned residual, made conjugate to the last change where that still points down. `count`: active cells, when
    /// the sum of the pressures stays.
    fn new(problem: &NormalIteration<'_>, conjugate: bool, count: Option<f64>) -> Self {
        let NormalIteration { steepest, active, residual, last_change, last_image, .. } = problem;
        let read = [steepest, active, residual, last_change, last_image].map(Vec::as_slice);
        let [z, z_image, image, last, last_image, z_slope, last_slope] = each_cell(&Products, read, []);
        let mean = |sum: f64| count.map_or(0.0, |count| sum / count);
        let mut beta = 0.0;
        if conjugate && last_image > 0.0 {
            beta = (z_image - mean(z) * image) / last_image;
            if !(beta * last_slope < z_slope) {
                beta = 0.0;
            }
        }
        Self { beta, constant: mean(z) - beta * mean(last) }
    }

    /// `change` becomes the way to the pressures after a `step`, without tension, without the leaving cells, under the
    /// prescribed force. False when no pressure would be left.
    fn clip(&self, problem: &mut NormalIteration<'_>, step: f64) -> bool {
        let Self { beta, constant } = *self;
        let (total, CellLaw { hardness, .. }) = (problem.task.load.total, problem.law());
        let NormalIteration { steepest, active, last_change, pressure, change, gap, tilt, .. } =
            &mut *problem;
        let target = Target { step, constant, beta, hardness };
        let [found] = each_cell(&target, [steepest, active, last_change, pressure, gap], [change]);
        let mut fraction = 1.0;
        if hardness.is_finite() {
            if total.is_some_and(|total| !yielding::restore(change, active, total, hardness)) {
                return false;
            }
        } else if let Some(tilt) = tilt {
            yielding::clip(change, hardness);
            if !tilt.restore(change) {
                // Cells that would leave are needed for the moment.
                add_scaled(change, 1.0, pressure);
                if !tilt.restore(change) {
                    return false;
                }
            }
        } else if let Some(total) = total {
            if !(found > 0.0) {
                return false;
            }
            fraction = total / found;
        }
        each_cell(&ChangeTo { fraction, hardness }, [pressure], [change]);
        true
    }
}

/// Gap of a height, the cells where pressure is unknown, and the gap on them; sums of both.
struct Sets {
    approach: f64,
    /// A loaded cell whose pressure times this is less than its gap leaves; so does one whose room for more is less than its overlap.
    stretch: f64,
    hardness: f64,
}

impl CellRule<1, 3, 2> for Sets {
    #[inline(always)]
    fn at<R: Reals>(&self, [p]: [R; 1], [gap, residual, active]: &mut [R; 3]) -> [R; 2] {
        let (zero, one, hardness) = (p.all(0.0), p.all(1.0), p.all(self.hardness));
        *gap = *gap - self.approach;
        let overlaps = zero.if_at_most(*gap, zero, one);
        let opens = gap.if_at_most(zero, zero, one);
        let room = (hardness - p) * self.stretch;
        let stays = gap.if_at_most(p * self.stretch, one, zero) * (*gap * -1.0).if_at_most(room, one, zero);
        *active = p.if_at_most(zero, overlaps, hardness.if_at_most(p, opens, stays));
        *residual = *active * *gap;
        [*residual, *active]
    }
}

/// Fraction of its pressure that a cell loses, or of its room for more that it takes.
struct Steepest {
    hardness: f64,
}

impl CellSize<2> for Steepest {
    #[inline(always)]
    fn of<R: Reals>(&self, [change, p]: [R; 2]) -> R {
        let (zero, hardness) = (p.all(0.0), p.all(self.hardness));
        let falls = zero.if_at_most(change, zero, change / p * -1.0);
        let rises = change.if_at_most(zero, zero, change / (hardness - p));
        falls.max(rises)
    }
}

struct Products;

impl CellRule<5, 0, 7> for Products {
    #[inline(always)]
    fn at<R: Reals>(&self, [z, active, residual, change, image]: [R; 5], _: &mut [R; 0]) -> [R; 7] {
        let (z, change) = (active * z, active * change);
        [z, z * image, active * image, change, change * image, z * residual, change * residual]
    }
}

/// Pressure after a step, not yet cut to between 0 and the hardness; of inactive cells that of the two to which they have gone or go; the sum of
/// what it is when it is cut.
struct Target {
    step: f64,
    constant: f64,
    beta: f64,
    hardness: f64,
}

impl CellRule<5, 1, 1> for Target {
    #[inline(always)]
    fn at<R: Reals>(&self, [z, active, last, p, gap]: [R; 5], [target]: &mut [R; 1]) -> [R; 1] {
        let (zero, hardness) = (p.all(0.0), p.all(self.hardness));
        let moved = p + (last * self.beta - z + self.constant) * self.step;
        let rests = zero.if_at_most(gap, hardness.if_at_most(p, hardness, zero), hardness);
        *target = active.if_at_most(zero, rests, moved);
        [target.max(zero).min(hardness)]
    }
}

/// What brings pressure to a fraction of its target, cut to between 0 and the hardness.
struct ChangeTo {
    fraction: f64,
    hardness: f64,
}

impl CellRule<1, 1, 0> for ChangeTo {
    #[inline(always)]
    fn at<R: Reals>(&self, [p]: [R; 1], [target]: &mut [R; 1]) -> [R; 0] {
        *target = target.max(p.all(0.0)).min(p.all(self.hardness)) * self.fraction - p;
        []
    }
}
