//! What a contact carries that slides, where its pressure decides it: at a prescribed approach the normal force falls while it is dragged along; where
//! friction differs from place to place, pressure goes over from one place to another.

use super::contact_problem::ContactProblem;
use super::increment_problem::IncrementProblem;
use super::newton;
use super::operators::RegionOperators;
use super::prescribed::TangentialLoads;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::fields::sum;

/// Residual to which sliding is solved.
const SLIDING: f64 = 1e-6;
/// A force above this times that of sliding is not carried. On the way there it may be a little more: up to 1.004 times on films of 0.2 to
/// 0.5 contact radii that keep their volume (friction 0.8 and 1.5).
const LIMIT: f64 = 1.01;

/// Refuses tangential forces above those under which the contact slides as a whole, from `start`. Where that is not found either, nothing is
/// known.
///
/// # Errors
/// When the forces are above it, or the iteration is stopped.
pub fn check_sliding(
    increment: &IncrementProblem<'_>,
    problem: &ContactProblem<'_>,
    start: &Tractions,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<(), SolveError> {
    let loads = problem.tangential;
    let held = loads.held();
    let [x, y] = [0, 1].map(|axis| if held[axis] { loads.resultant[axis] } else { 0.0 });
    let asked = x.hypot(y);
    let is_known = problem.normal.total.is_some() && problem.friction.is_uniform();
    if is_known || held[2] || !(asked > 0.0) {
        return Ok(());
    }
    // Slip by the size of the region: what sheared the contact before is nothing beside it.
    let far = problem.positions.length / asked;
    let motion = [x * far, y * far, 0.0];
    let sliding =
        ContactProblem { tangential: TangentialLoads { motion, ..TangentialLoads::default() }, ..*problem };
    let (mut tractions, mut displacements) = (start.clone(), Displacements::zeros(increment.region.len()));
    newton::make_shear_feasible(&sliding, &mut tractions, operators);
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    let settings = SolverSettings { tolerance: SLIDING, ..*settings };
    let (ends, moved) = (&mut tractions, &mut displacements);
    match newton::solve(&sliding, ends, moved, operators, &settings, callback) {
        Err(SolveError::Stopped) => return Err(SolveError::Stopped),
        Err(_) => return Ok(()),
        Ok(_) => {}
    }
    let carried = (x * sum(&tractions.shear.x) + y * sum(&tractions.shear.y)) / asked;
    if asked <= LIMIT * carried {
        return Ok(());
    }
    let area = increment.grid.cell_area();
    let has_strength = increment.friction.has_strength();
    Err(SolveError::AboveSliding { asked: asked * area, bound: carried * area, has_strength })
}
