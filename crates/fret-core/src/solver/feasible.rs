//! Projected, preconditioned conjugate gradients, one convolution an iteration: pressures stay feasible throughout; a nearly
//! empty cell that is pulled apart leaves; the energy never rises.

use super::normal_problem::{Ending, NormalProblem};
use super::residual::NormalVerdict;
use super::settings::SolveError;
use super::sweep::sweep;

/// A loaded cell leaves when its own pressure could close less than this share of its gap.
const LEAVE_BELOW: f64 = 0.15;

/// Iterates until solved, or until `patience` iterations have not halved the residual.
///
/// # Errors
/// When somebody stopped the iteration, or it has gone on for too long.
pub fn iterate(problem: &mut NormalProblem<'_>, patience: usize) -> Result<Ending, SolveError> {
    let own = problem.own;
    let by_force = problem.task.total.is_some();
    let mut step = 0.8_f64;
    let mut leave_below = LEAVE_BELOW;
    let mut conjugate = false;
    let mut best = f64::INFINITY;
    let mut waited = 0;
    loop {
        let (approach, scale) = problem.measure();
        let stretch = own / leave_below;
        let ([gaps, count], [worst]) = sweep(
            [&mut problem.gap, &mut problem.residual, &mut problem.active],
            [&*problem.pressure],
            move |[height, _, _], [p]| {
                let gap = height - approach;
                let leaves = p > 0.0 && p * stretch < gap;
                let active = f64::from(u8::from((p > 0.0 || gap < 0.0) && !leaves));
                let carried = own * p;
                let off = if gap < carried { gap } else { carried };
                ([gap, active * gap, active], [active * gap, active], [off.abs()])
            },
        );
        let residual = scale.map_or(if worst > 0.0 { 1.0 } else { 0.0 }, |scale| worst / scale);
        problem.hear(residual)?;
        if residual < problem.tolerance {
            return Ok(Ending::Solved(NormalVerdict { approach, residual }));
        }
        waited += 1;
        if residual < 0.5 * best {
            (best, waited) = (residual, 0);
        }
        if waited > patience {
            return Ok(Ending::Stalled);
        }
        let mean = if by_force { gaps / count.max(1.0) } else { 0.0 };
        if mean != 0.0 {
            sweep([&mut problem.residual], [&problem.active], move |[r], [active]| {
                ([r - mean * active], [], [])
            });
        }
        problem.precondition();
        let along = Direction::new(problem, conjugate, by_force.then_some(count.max(1.0)));
        if !along.clip(problem, step) {
            return Ok(Ending::Stalled);
        }
        // Clipped before the convolution with a step guessed from the last line search, so that what is convolved is
        // feasible and the displacement stays linear in it.
        problem.convolve_change();
        let ([curvature, slope], [steepest_fall]) = sweep(
            [],
            [&problem.change, &problem.image, &problem.gap, &*problem.pressure],
            |[], [change, image, gap, p]| {
                let fall = if change < 0.0 { -change / p } else { 0.0 };
                ([], [change * image, gap * change], [fall])
            },
        );
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
        // Beyond the change itself as far as no pressure becomes tension.
        let share = if exact > 1.0 { exact.min((1.0 / steepest_fall).max(1.0)) } else { exact };
        problem.advance(share);
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
    fn new(problem: &NormalProblem<'_>, conjugate: bool, count: Option<f64>) -> Self {
        let ([z, z_image, image, last, last_image, z_slope, last_slope], []) = sweep(
            [],
            [
                &problem.steepest,
                &problem.active,
                &problem.residual,
                &problem.last_change,
                &problem.last_image,
            ],
            |[], [z, active, residual, change, image]| {
                let (z, change) = (active * z, active * change);
                let sums =
                    [z, z * image, active * image, change, change * image, z * residual, change * residual];
                ([], sums, [])
            },
        );
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
    fn clip(&self, problem: &mut NormalProblem<'_>, step: f64) -> bool {
        let Self { beta, constant } = *self;
        let ([found], []) = sweep(
            [&mut problem.change],
            [&problem.steepest, &problem.active, &problem.last_change, &*problem.pressure],
            move |[_], [z, active, last, p]| {
                let target = active * (p + step * (constant - z + beta * last));
                let target = if target > 0.0 { target } else { 0.0 };
                ([target], [target], [])
            },
        );
        let share = match problem.task.total {
            Some(_) if !(found > 0.0) => return false,
            Some(total) => total / found,
            None => 1.0,
        };
        sweep([&mut problem.change], [&*problem.pressure], move |[target], [p]| {
            ([target * share - p], [], [])
        });
        true
    }
}
