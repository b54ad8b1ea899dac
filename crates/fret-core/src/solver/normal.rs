//! Pressure alone: projected, preconditioned conjugate gradients, one convolution an iteration. Pressures stay feasible
//! throughout; a nearly empty cell that is pulled apart leaves; the energy never rises.

use super::preconditioner::Preconditioner;
use super::residual::{NormalVerdict, judge_normal, mean_where_loaded};
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
    let mut step = 0.8_f64;
    let mut leave_below = 0.15;
    let mut last: Option<(Vec<f64>, Vec<f64>)> = None;
    let mut best = f64::INFINITY;
    let mut best_at = 0;
    let mut image = vec![0.0; len];
    let mut z = vec![0.0; len];
    let most = 40 * settings.most_outer_iterations;
    let mut careful = 0_usize;
    for iteration in 0..most {
        let mut gap: Vec<f64> = displacement.iter().zip(task.undeformed).map(|(u, g)| u + g).collect();
        let verdict = judge_normal(pressure, &mut gap, task.undeformed, own, prescribed);
        if watch(iteration, verdict.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if verdict.residual < settings.tolerance {
            return Ok(NormalSolution { verdict, gap, iterations: iteration });
        }
        if verdict.residual < 0.5 * best {
            best_at = iteration;
        } else if iteration > best_at + 10 && careful == 0 {
            careful = 4;
            best_at = iteration;
            last = None;
        }
        best = best.min(verdict.residual);
        let leaves = |cell: usize| pressure[cell] > 0.0 && pressure[cell] * own < leave_below * gap[cell];
        let active: Vec<bool> =
            (0..len).map(|cell| (pressure[cell] > 0.0 || gap[cell] < 0.0) && !leaves(cell)).collect();
        let leaving: Vec<usize> = (0..len).filter(|&cell| leaves(cell)).collect();
        let mut residual: Vec<f64> =
            (0..len).map(|cell| if active[cell] { gap[cell] } else { 0.0 }).collect();
        if task.total.is_some() {
            remove_mean(&mut residual, &active);
        }
        preconditioner.normal(&residual, &mut z);
        keep(&mut z, &active);
        if task.total.is_some() {
            remove_mean(&mut z, &active);
        }
        let mut along: Vec<f64> = z.iter().map(|value| -value).collect();
        if let Some((direction, direction_image)) = &last {
            let mut inside = direction.clone();
            keep(&mut inside, &active);
            let curvature = dot(&inside, direction_image);
            if curvature > 0.0 {
                let beta = dot(&z, direction_image) / curvature;
                let mut trial: Vec<f64> = along.iter().zip(&inside).map(|(a, b)| a + beta * b).collect();
                if task.total.is_some() {
                    remove_mean(&mut trial, &active);
                }
                if dot(&trial, &residual) < 0.0 {
                    along = trial;
                }
            }
        }
        // A step guessed from the last line search, clipped before the convolution, so that what is convolved is feasible.
        let guess = if careful > 0 { 0.3 * step } else { step };
        let mut target: Vec<f64> =
            pressure.iter().zip(&along).map(|(p, d)| (p + guess * d).max(0.0)).collect();
        for &cell in &leaving {
            target[cell] = 0.0;
        }
        if let Some(total) = task.total {
            let found = sum(&target);
            if found > 0.0 {
                target.iter_mut().for_each(|p| *p *= total / found);
            }
        }
        let change: Vec<f64> = target.iter().zip(pressure.iter()).map(|(t, p)| t - p).collect();
        compliance.normal(&change, &mut image);
        let curvature = dot(&change, &image);
        let exact = -dot(&gap, &change) / curvature;
        if !(curvature > 0.0 && exact > 0.0) {
            step *= 0.3;
            leave_below *= 0.5;
            last = None;
            if step < 1e-12 {
                break;
            }
            continue;
        }
        let mut share = exact;
        if exact > 1.0 {
            for (p, c) in pressure.iter().zip(&change) {
                if *c < 0.0 {
                    share = share.min(-p / c);
                }
            }
            share = share.max(1.0);
        }
        for ((p, u), (c, i)) in
            pressure.iter_mut().zip(displacement.iter_mut()).zip(change.iter().zip(&image))
        {
            *p = (*p + share * c).max(0.0);
            *u += share * i;
        }
        step = (guess * exact).clamp(0.2, 1.5);
        careful = careful.saturating_sub(1);
        last = Some((change, image.clone()));
    }
    Err(SolveError::NotConverged { reached: best, iterations: most })
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

/// Mean gap where loaded, for callers that only want an approach.
pub fn mean_gap(pressure: &[f64], height: &[f64]) -> f64 {
    mean_where_loaded(pressure, height)
}

fn keep(field: &mut [f64], active: &[bool]) {
    for (value, active) in field.iter_mut().zip(active) {
        if !active {
            *value = 0.0;
        }
    }
}

fn remove_mean(field: &mut [f64], active: &[bool]) {
    let count = active.iter().filter(|active| **active).count();
    if count == 0 {
        return;
    }
    let mean = field.iter().zip(active).filter(|(_, active)| **active).map(|(value, _)| value).sum::<f64>()
        / count as f64;
    for (value, active) in field.iter_mut().zip(active) {
        if *active {
            *value -= mean;
        }
    }
}
