//! The frictionless problem: which iteration works when, and what it starts from.

mod active_set;
pub mod coarse_grids;
mod equations;
mod first_pressure;
pub mod grid_transfer;
mod problem;
mod projected_cg;
mod sparse;
mod yielding;

use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use crate::compliance::SurfaceCompliance;
use crate::fields::lower;

use active_set::Care;
pub use equations::NormalEquations;
pub use first_pressure::first_pressure;
pub use problem::NormalSolution;
use problem::{Ending, NormalIteration};

/// Iterations of projected conjugate gradients that need not halve the residual before the active set is tried.
const MAX_STALLED: usize = 20;

/// Solves the normal equations from a pressure without tension and with the force prescribed; where surfaces yield, from any. Both fields end at the solution: pressure [pressure] and its normal displacement
/// [length].
///
/// Projected conjugate gradients come first, the active set where the response is stiff; each takes over when the other stalls, waits longer and takes
/// more care each time.
///
/// # Errors
/// When the iteration does not converge or is stopped.
pub fn solve_normal(
    task: &NormalEquations<'_>,
    [pressure, displacement]: [&mut [f64]; 2],
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<NormalSolution, SolveError> {
    if let Some(tilt) = task.tilt()
        && !tilt.restore(pressure)
    {
        // Nothing of it carries the moment; of all cells some do.
        if !tilt.on_all_cells(pressure) {
            return Err(SolveError::NotConverged { reached: f64::INFINITY, iterations: 0 });
        }
    }
    if let (Some(total), Some(hardness)) = (task.load.total, task.load.hardness)
        && total > hardness * pressure.len() as f64
    {
        return Err(SolveError::NotConverged { reached: f64::INFINITY, iterations: 0 });
    }
    if let Some(hardness) = task.load.hardness
        && !yielding::make_feasible(pressure, task.load.total, hardness)
    {
        let own = operators.compliance.self_influence().normal;
        pressure.copy_from_slice(&first_pressure(task, own));
    }
    let mut by_active_set = operators.preconditioner.is_stiff();
    if !by_active_set {
        let fields = [&mut *pressure, &mut *displacement];
        if let Some(solution) = sparse::solve(task, fields, operators, settings.tolerance, callback)? {
            return Ok(solution);
        }
    }
    let fields = [pressure, displacement];
    let mut problem = NormalIteration::new(task, fields, operators, settings.tolerance, callback);
    let mut max_stalled = MAX_STALLED;
    let mut care = Care::default();
    loop {
        let ending = if by_active_set {
            active_set::iterate(&mut problem, care)?
        } else {
            projected_cg::iterate(&mut problem, max_stalled)?
        };
        if let Ending::Solved(mut residual) = ending {
            let gives = task.load.given_way(problem.pressure);
            lower(problem.displacement, gives);
            residual.approach -= gives;
            let (gap, iterations) = (problem.gap, problem.iterations);
            return Ok(NormalSolution { residual, gap, iterations });
        }
        if by_active_set {
            max_stalled = max_stalled.saturating_mul(2);
            care = care.more();
        }
        by_active_set = !by_active_set;
    }
}
