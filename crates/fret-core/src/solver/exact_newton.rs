//! The last resort: the semismooth Newton method on the projection equations with exact, dense linear algebra (Alart & Curnier 1991;
//! Christensen, Klarbring, Pang & Stromberg 1998). With `y = p - g / K_n` and `w = q + slip / K_t` of every cell:
//!
//! ```text
//! p = max(y, 0),    q = Proj(w) onto the disc of radius b(y)
//! ```
//!
//! The bound takes the augmented pressure y, so that its derivative ties shear to pressure and gap at once; and nothing is feasible on
//! the way. For contacts of some thousand unknowns: membranes on soft layers, stiff wavy films, friction near 1, where active sets read
//! off feasible tractions wander.

mod linear_system;

use super::contact_problem::{ContactProblem, Solution};
use super::contact_set::ContactSet;
use super::laws::projection::project_pressure;
use super::laws::rigid_motions::RigidMotions;
use super::laws::slip::{SlipIncrement, TangentialProblem};
use super::newton;
use super::operators::{Method, RegionOperators};
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::{CellResponse, SurfaceCompliance};
use crate::fields::norm;
use crate::model::TangentialField;

/// Iterations from one start.
const MOST_ITERATIONS: usize = 40;
/// Halvings of a step.
const MOST_HALVINGS: usize = 12;
/// Residual of the projection equations that the certified residual is sure to follow, as a fraction of the tolerance.
const ENOUGH: f64 = 1e-2;

/// Solves the equations from one of the `starts`, feasible or not; `None` where none leads to a solution, or it would be too large. What is
/// found is accepted by the same residuals as ever.
///
/// # Errors
/// When the iteration is stopped, or the response has no dense form.
pub fn solve(
    problem: &ContactProblem<'_>,
    starts: [&Tractions; 2],
    (tractions, displacements): (&mut Tractions, &mut Displacements),
    operators: &mut RegionOperators,
    method: &Method<'_>,
    callback: IterationCallback<'_>,
) -> Result<Option<Solution>, SolveError> {
    if method.settings.max_direct_unknowns == 0 {
        return Ok(None);
    }
    let response = (method.cells)()?;
    for start in starts {
        tractions.clone_from(start);
        let mut attempt = Attempt::new(problem, tractions, &response, operators);
        if attempt.iterate(tractions, operators, method.settings, callback)? {
            operators.compliance.full(tractions.parts(), displacements.parts_mut());
            match newton::solve(problem, tractions, displacements, operators, method.settings, callback) {
                Err(SolveError::NotConverged { .. }) => {}
                other => return other.map(Some),
            }
        }
    }
    Ok(None)
}

/// Tractions and rigid motions.
#[derive(Clone)]
struct Point {
    tractions: Tractions,
    displacements: Displacements,
    approach: f64,
    motion: [f64; 3],
}

impl Point {
    /// `self + fraction (other - self)`.
    fn towards(&self, other: &Self, fraction: f64) -> Self {
        let between = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + fraction * (b - a)).collect();
        let [p, qx, qy] = [0, 1, 2].map(|k| between(self.tractions.parts()[k], other.tractions.parts()[k]));
        let [normal, x, y] =
            [0, 1, 2].map(|k| between(self.displacements.parts()[k], other.displacements.parts()[k]));
        Self {
            tractions: Tractions { pressure: p, shear: TangentialField { x: qx, y: qy } },
            displacements: Displacements { normal, tangential: TangentialField { x, y } },
            approach: self.approach + fraction * (other.approach - self.approach),
            motion: [0, 1, 2].map(|k| self.motion[k] + fraction * (other.motion[k] - self.motion[k])),
        }
    }
}

/// One run of the method.
struct Attempt<'a> {
    problem: &'a ContactProblem<'a>,
    response: &'a CellResponse,
    /// Rigid motions of all cells of the region.
    motions: RigidMotions,
    /// Self-influence of a cell, normal and tangential [length/pressure].
    self_influence: [f64; 2],
    columns: usize,
    here: Point,
}

impl<'a> Attempt<'a> {
    fn new(
        problem: &'a ContactProblem<'a>,
        tractions: &Tractions,
        response: &'a CellResponse,
        operators: &mut RegionOperators,
    ) -> Self {
        let cells = problem.undeformed.len();
        let own = operators.compliance.self_influence();
        let mut displacements = Displacements::zeros(cells);
        operators.compliance.full(tractions.parts(), displacements.parts_mut());
        let mut attempt = Self {
            problem,
            response,
            motions: problem.motions_of(&ContactSet::of(cells, |_| true)),
            self_influence: [own.normal, own.tangential],
            columns: operators.region.shape[1],
            here: Point {
                tractions: tractions.clone(),
                displacements,
                approach: problem.normal.approach,
                motion: problem.tangential.motion,
            },
        };
        attempt.guess_motions();
        attempt
    }

    /// Approach and motions by force that go with the tractions to start from.
    fn guess_motions(&mut self) {
        let Self { problem, self_influence: [_, own], here, .. } = self;
        let contact = ContactSet::loaded(&here.tractions.pressure);
        if (problem.normal.total.is_some() || problem.normal.give > 0.0) && contact.len() > 0 {
            let heights =
                contact.cells().map(|cell| here.displacements.normal[cell] + problem.undeformed[cell]);
            here.approach = heights.sum::<f64>() / contact.len() as f64;
        }
        let bound = problem.friction.packed(&contact).bound(&contact.packed(&here.tractions.pressure));
        let equations = TangentialProblem {
            bound: &bound.bound,
            before: &contact.packed_tangential(problem.before),
            path: &problem.path.packed(&contact),
            motions: &problem.motions_of(&contact),
            self_influence: *own,
        };
        let shear = contact.packed_tangential(&here.tractions.shear);
        let displacement = contact.packed_tangential(&here.displacements.tangential);
        here.motion = SlipIncrement::default().find(&equations, &shear, &displacement, [0.0; 3]).motion;
    }

    /// Whether the equations were solved; then `tractions` hold the solution, projected onto what the laws allow.
    fn iterate(
        &mut self,
        tractions: &mut Tractions,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<bool, SolveError> {
        let mut merit = self.merit(&self.here);
        for iteration in 0..MOST_ITERATIONS {
            let size = norm(&self.here.tractions.pressure);
            let residual = merit.sqrt() / size;
            if callback(iteration, residual).is_break() {
                return Err(SolveError::Stopped);
            }
            if residual < ENOUGH * settings.tolerance {
                tractions.clone_from(&self.here.tractions);
                self.project(tractions);
                return Ok(true);
            }
            let (active, unknowns) = self.active_cells();
            if unknowns == 0 || unknowns > settings.max_direct_unknowns || !residual.is_finite() {
                return Ok(false);
            }
            operators.direct_solves += 1;
            let Some(mut next) = self.newton_point(&active) else { return Ok(false) };
            operators.compliance.full(next.tractions.parts(), next.displacements.parts_mut());
            let mut fraction = 1.0;
            let mut found = None;
            for _ in 0..MOST_HALVINGS {
                let trial = self.here.towards(&next, fraction);
                let there = self.merit(&trial);
                if there < merit * (1.0 - 1e-4 * fraction) {
                    found = Some((trial, there));
                    break;
                }
                fraction *= 0.5;
            }
            // Where no part of the step is better, all of it: the equations have kinks.
            (self.here, merit) = found.unwrap_or_else(|| {
                let there = self.merit(&next);
                (next, there)
            });
        }
        Ok(false)
    }

    /// Gap, augmented pressure, slip and trial shear of a cell.
    fn cell(&self, point: &Point, cell: usize) -> (f64, f64, [f64; 2]) {
        let Self { problem, self_influence: [normal, tangential], .. } = self;
        let gap = problem.undeformed[cell] + point.displacements.normal[cell] - point.approach;
        let slip = problem.path.end_of(cell, self.slip(point, cell));
        let q = point.tractions.shear.at(cell);
        let trial = [0, 1].map(|axis| q[axis] + slip[axis] / tangential);
        (gap, point.tractions.pressure[cell] - gap / normal, trial)
    }

    fn slip(&self, point: &Point, cell: usize) -> [f64; 2] {
        let [u, before] = [point.displacements.tangential.at(cell), self.problem.before.at(cell)];
        let rigid = self.motions.at(point.motion, cell);
        [0, 1].map(|axis| rigid[axis] + before[axis] - u[axis])
    }

    /// Squared length of what the equations leave over [pressure^2].
    fn merit(&self, point: &Point) -> f64 {
        let Self { problem, .. } = self;
        let mut square = 0.0;
        let mut sums = [0.0; 4];
        for cell in 0..problem.undeformed.len() {
            let p = point.tractions.pressure[cell];
            let q = point.tractions.shear.at(cell);
            let (_, augmented, trial) = self.cell(point, cell);
            let (bound, _) = problem.friction.at(cell, augmented.max(0.0));
            let size = trial[0].hypot(trial[1]);
            let fraction = if size > bound { bound / size } else { 1.0 };
            square += (p - augmented.max(0.0)).powi(2);
            for axis in 0..2 {
                square += (q[axis] - fraction * trial[axis]).powi(2);
            }
            sums[0] += p;
            sums[1] += q[0];
            sums[2] += q[1];
            if self.motions.rotates {
                let around = self.motions.rotation.at(cell);
                sums[3] += q[0] * around[0] + q[1] * around[1];
            }
        }
        let cells = point.tractions.pressure.iter().filter(|p| **p > 0.0).count().max(1) as f64;
        let (normal, loads) = (problem.normal, problem.tangential);
        if let Some(total) = normal.total {
            square += (sums[0] - total).powi(2) / cells;
        } else if normal.give > 0.0 {
            let missing = (normal.approach - point.approach) / normal.give;
            square += (sums[0] - missing).powi(2) / cells;
        }
        for mode in 0..3 {
            if loads.by_force[mode] {
                let carried = sums[1 + mode] + loads.spring[mode] * point.motion[mode];
                square += (carried - loads.resultant[mode]).powi(2) / cells;
            }
        }
        square
    }

    /// Takes away what rounding left of tension and of shear beyond the bound.
    fn project(&self, tractions: &mut Tractions) {
        project_pressure(&mut tractions.pressure, self.problem.normal.total);
        for cell in 0..tractions.pressure.len() {
            let (bound, _) = self.problem.friction.at(cell, tractions.pressure[cell]);
            let [x, y] = tractions.shear.at(cell);
            let size = x.hypot(y);
            if size > bound * (1.0 - 1e-9) && size > 0.0 {
                tractions.shear.set(cell, [x * bound / size, y * bound / size]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
