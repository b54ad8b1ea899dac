//! Pressure alone: which iteration works when, and what it starts from.

use super::active_set;
use super::feasible;
use super::normal_problem::{Ending, NormalProblem};
use super::preconditioner::Preconditioner;
use super::residual::NormalVerdict;
use super::settings::{SolveError, SolverSettings, Watch};
use crate::compliance::SurfaceCompliance;
use crate::model::field::sum;

pub use super::normal_problem::NormalTask;

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

/// Iterations that need not halve the residual before the other iteration is tried.
const PATIENCE: usize = 10;

/// Solves the normal equations from a feasible `pressure` with its `displacement`; both end at the solution.
///
/// The feasible iteration comes first, the frozen contact where the response is stiff (see
/// [`Preconditioner::is_stiff`]); each takes over when the other stalls.
pub fn solve_normal(
    task: &NormalTask<'_>,
    pressure: &mut [f64],
    displacement: &mut [f64],
    compliance: &mut dyn SurfaceCompliance,
    preconditioner: &mut Preconditioner,
    settings: &SolverSettings,
    watch: Watch<'_>,
) -> Result<NormalSolution, SolveError> {
    let mut frozen = preconditioner.is_stiff();
    let bounds = (settings.tolerance, 40 * settings.most_outer_iterations);
    let fields = [pressure, displacement];
    let mut problem = NormalProblem::new(task, fields, compliance, preconditioner, bounds, watch);
    let mut patience = PATIENCE;
    loop {
        let ending = if frozen {
            active_set::iterate(&mut problem)?
        } else {
            feasible::iterate(&mut problem, patience)?
        };
        if let Ending::Solved(verdict) = ending {
            let (gap, iterations) = (problem.gap, problem.iterations);
            return Ok(NormalSolution { verdict, gap, iterations });
        }
        if frozen {
            patience *= 2;
        }
        frozen = !frozen;
    }
}

/// A first pressure for a scene that repeats: the one of full contact, without its tension.
pub fn full_contact_pressure(task: &NormalTask<'_>, preconditioner: &mut Preconditioner) -> Option<Vec<f64>> {
    let mean = task.total? / task.undeformed.len() as f64;
    let mut removed = vec![0.0; task.undeformed.len()];
    preconditioner.normal(task.undeformed, &mut removed);
    // Layers on a rigid base answer a uniform pressure too; the approach takes that.
    let level = sum(&removed) / removed.len() as f64;
    for part in &mut removed {
        *part -= level;
    }
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
