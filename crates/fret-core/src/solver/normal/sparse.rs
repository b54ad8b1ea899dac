//! Sparse contact: the frictionless problem on the cells that are in contact or may come into it. On these alone its fields are held and passed
//! over, by a response that is about right. What that and the other cells leave is corrected, round after round, by displacements of the whole region
//! in double precision, of which the residual is judged (iterative refinement, as an outer loop over active cells).

#[cfg(test)]
mod tests;

use super::equations::NormalEquations;
use super::problem::{Ending, NormalIteration, NormalSolution};
use super::projected_cg;
use crate::compliance::SurfaceCompliance;
use crate::solver::contact_set::ContactSet;
use crate::solver::laws::complementarity::{CellLaw, normal_residual, violation};
use crate::solver::normal_response::NormalResponse as _;
use crate::solver::operators::RegionOperators;
use crate::solver::settings::{IterationCallback, SolveError};

/// Contact is sparse on less than this fraction of the cells: on a tenth, products of the whole region cost as much as sums over near cells.
const SPARSE_BELOW: f64 = 0.04;
/// Not more than this fraction may take part.
const MOST_CELLS: f64 = 0.12;
/// On fewer cells nothing is gained.
const FEWEST_CELLS: usize = 1 << 14;
/// Cells take part whose gap is less than this many times the largest violation.
const REACH: f64 = 1.5;
/// A round brings the residual of the cells that take part down to this fraction.
const ROUND: f64 = 0.01;
/// Iterations that need not halve the residual before a round has failed.
const MOST_STALLED: usize = 20;
/// A round that does not bring the residual down to this fraction is the last.
const LEAST_GAIN: f64 = 0.5;

/// Solves the normal equations from a pressure without tension and with the force prescribed, where contact is sparse; `None` where it is not, or
/// where this does not get on: pressure is feasible then. Both fields end at the solution.
///
/// # Errors
/// When the iteration is stopped.
pub fn solve(
    task: &NormalEquations<'_>,
    [pressure, displacement]: [&mut [f64]; 2],
    operators: &mut RegionOperators,
    tolerance: f64,
    callback: IterationCallback<'_>,
) -> Result<Option<NormalSolution>, SolveError> {
    let all = pressure.len();
    let is_sparse = |cells: &ContactSet, fraction: f64| (cells.len() as f64) < fraction * all as f64;
    let plain = task.tilt().is_none() && task.load.hardness.is_none() && task.load.give == 0.0;
    let plain = plain && !operators.compliance.gives();
    let contact = ContactSet::loaded(pressure);
    if !plain || all < FEWEST_CELLS || contact.len() == 0 || !is_sparse(&contact, SPARSE_BELOW) {
        return Ok(None);
    }
    let mut response = operators.sparse.take();
    let law = CellLaw::under(&task.load, operators.compliance.self_influence().normal);
    let approach = task.load.approach_under(pressure);
    let (mut gap, mut iterations, mut before) = (Vec::new(), 0, f64::INFINITY);
    let solution = loop {
        operators.compliance.normal(pressure, displacement);
        iterations += 1;
        let residual =
            normal_residual(pressure, (displacement, task.undeformed), law, (approach, None), &mut gap);
        if callback(iterations, residual.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual.residual < tolerance {
            break Some(NormalSolution { residual, gap, iterations });
        }
        let reach = REACH * violation(&gap, pressure, law);
        let cells = ContactSet::of(all, |cell| pressure[cell] > 0.0 || gap[cell] < reach);
        if !(residual.residual < LEAST_GAIN * before) || !is_sparse(&cells, MOST_CELLS) {
            break None;
        }
        before = residual.residual;
        response = response.or_else(|| operators.sparse_response());
        let Some(response) = &mut response else { break None };
        response.begin(&cells);
        let (mut packed, mut moved) = (cells.packed(pressure), vec![0.0; cells.len()]);
        response.displacement(&packed, &mut moved);
        // What this response leaves out of the displacements goes with the gap before deformation.
        let mut undeformed = cells.packed(task.undeformed);
        for ((gap, whole), here) in undeformed.iter_mut().zip(cells.packed(displacement)).zip(&moved) {
            *gap += whole - here;
        }
        let here = NormalEquations { undeformed: &undeformed, ..*task };
        let goal = (ROUND * residual.residual).max(0.5 * tolerance);
        let done = iterations;
        let mut heard = |count: usize, found: f64| callback(done + count, found);
        let fields = [&mut packed[..], &mut moved];
        let mut problem = NormalIteration::new(&here, fields, response, goal, &mut heard);
        let ending = projected_cg::iterate(&mut problem, MOST_STALLED);
        iterations += problem.iterations;
        cells.place(&packed, 1.0, pressure);
        match ending {
            Ok(Ending::Solved(_)) => {}
            Err(SolveError::Stopped) => return Err(SolveError::Stopped),
            Ok(Ending::Stalled) | Err(_) => break None,
        }
    };
    operators.keep_sparse(response);
    Ok(solution)
}
