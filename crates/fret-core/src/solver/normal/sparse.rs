//! Sparse contact: the frictionless problem on the cells that are in contact or may come into it. On these alone its fields are held and passed
//! over, its displacements are found in single precision, and its approximate inverse is that of the whole region cut off after a few cells. What
//! single precision and the other cells leave is taken up, round after round, by displacements of the whole region in double precision, of
//! which the residual is judged (iterative refinement, an outer loop over active cells).

use super::super::contact_set::ContactSet;
use super::super::linear::inverse::unit_of;
use super::super::operators::RegionOperators;
use super::super::region_fields::RegionFields;
use super::super::settings::{IterationCallback, SolveError};
use super::near_inverse::NearInverse;
use super::problem::{Ending, NormalIteration};
use super::response::NormalResponse;
use super::{NormalEquations, NormalSolution, projected_cg};
use super::super::laws::complementarity::{CellLaw, normal_residual};
use crate::compliance::SurfaceCompliance;
use crate::fields::dot;

/// Contact is sparse on less than this fraction of the cells.
const SPARSE_BELOW: f64 = 0.125;
/// On fewer cells nothing is gained.
const FEWEST_CELLS: usize = 1 << 14;
/// Cells take part whose gap is less than this many times the largest violation.
const REACH: f64 = 1.5;
/// A round brings the residual down to this fraction, if the cells that take part allow it.
const ROUND: [f64; 2] = [0.02, 1e-3];
/// Rounds at the most: each divides the residual by a number.
const MOST_ROUNDS: usize = 30;

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
    let cells = pressure.len();
    if cells < FEWEST_CELLS {
        return Ok(None);
    }
    let law = CellLaw { self_influence: operators.compliance.self_influence().normal, hardness: None };
    let mut gap = Vec::new();
    let mut iterations = 0;
    let mut before = f64::INFINITY;
    let mut inverse = None;
    for round in 0..MOST_ROUNDS {
        let contact = ContactSet::loaded(pressure);
        if contact.len() as f64 > SPARSE_BELOW * cells as f64 || contact.len() == 0 {
            return Ok(None);
        }
        operators.compliance.normal(pressure, displacement);
        iterations += 1;
        let approach = task.load.approach_under(pressure);
        let read = (&*displacement, task.undeformed);
        let residual = normal_residual(pressure, read, law, approach, &mut gap);
        eprintln!("round: {} of {cells} residual {:e} iterations {iterations}", contact.len(), residual.residual);
        if callback(iterations, residual.residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual.residual < tolerance {
            return Ok(Some(NormalSolution { residual, gap, iterations }));
        }
        if !(residual.residual < 0.5 * before) {
            return Ok(None);
        }
        before = residual.residual;
        let reach = REACH * super::super::laws::complementarity::violation(&gap, pressure, law);
        let chosen = ContactSet::of(cells, |cell| pressure[cell] > 0.0 || gap[cell] < reach);
        let inverse = inverse.get_or_insert_with(|| NearInverse::new(operators));
        let goal = (ROUND[round.min(1)] * residual.residual).max(0.5 * tolerance);
        let mut here = SparseResponse::new(operators, &chosen, inverse);
        let mut packed = chosen.packed(pressure);
        let mut moved = vec![0.0; chosen.len()];
        here.displacement(&packed, &mut moved);
        // What the response of these cells leaves out of their displacements goes with the gap before deformation.
        let mut undeformed = chosen.packed(task.undeformed);
        let whole = chosen.packed(displacement);
        for ((gap, whole), here) in undeformed.iter_mut().zip(&whole).zip(&moved) {
            *gap += whole - here;
        }
        let inner = NormalEquations { undeformed: &undeformed, load: task.load, positions: task.positions };
        let done = iterations;
        let mut stop = |count: usize, found: f64| callback(done + count, found);
        let mut problem =
            NormalIteration::new(&inner, [&mut packed, &mut moved], &mut here, goal, &mut stop);
        let ending = projected_cg::iterate(&mut problem, 20)?;
        iterations += problem.iterations;
        eprintln!("   chosen {} iterations {} goal {goal:e} {ending:?}", chosen.len(), problem.iterations);
        chosen.place(&packed, 1.0, pressure);
        if matches!(ending, Ending::Stalled) {
            return Ok(None);
        }
    }
    Ok(None)
}

/// The response of some cells of a region.
struct SparseResponse<'a> {
    operators: &'a mut RegionOperators,
    inverse: &'a mut NearInverse,
    fields: RegionFields<f32>,
}

impl<'a> SparseResponse<'a> {
    fn new(operators: &'a mut RegionOperators, cells: &ContactSet, inverse: &'a mut NearInverse) -> Self {
        let mut fields = RegionFields::default();
        fields.begin(cells, operators.region.len());
        inverse.begin(cells);
        Self { operators, inverse, fields }
    }
}

impl NormalResponse for SparseResponse<'_> {
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let Some(mut single) = self.operators.compliance.normal_single() else { return };
        let unit = unit_of(dot(pressure, pressure).sqrt());
        let factors = [unit, unit * single.unit()];
        self.fields.carry(&[pressure], &mut [displacement], factors, |from, to| single.apply(from, to));
    }

    fn inverse(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.operators.preconditioner.passes += 1;
        self.inverse.apply(displacement, pressure);
    }

    fn self_influence(&self) -> f64 {
        self.operators.compliance.self_influence().normal
    }
}
