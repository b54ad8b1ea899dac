//! Semismooth Newton method for pressure and shear at once (Christensen, Klarbring, Pang & Stromberg 1998; Alart & Curnier 1991), as a
//! primal-dual active set strategy (Hintermueller, Ito & Kunisch 2003): what every cell does is read off feasible tractions, the
//! problem linearised on these sets is solved inexactly by a Krylov method, and what comes out is projected onto what the laws
//! allow, with exact resultants; until all laws hold. Where the pressure is given, the same for shear alone.

use super::contact_problem::{ContactProblem, Solution};
use super::contact_set::ContactSet;
use super::globalisation::ForcingTerm;
use super::iterate::Iterate;
use super::laws::active_sets::ActiveSets;
use super::laws::friction::FrictionBound;
use super::laws::projection::ShearProjection;
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::model::TangentialField;

/// Shear of slipping cells that a solution leaves inside its circles, by less than the tolerance, is put there so many times.
const MOST_ROUNDS_TO_CIRCLES: usize = 3;
/// Where the pressure is unknown, given up as well when so many iterations in a row have brought no residual smaller by a tenth: active sets
/// wander, and the other way is cheaper from there. By trial, rough contacts and stiff films: those that gain nothing for so long
/// hardly ever settle, and where the response is stiff each of them is dear.
const LOST_WITHOUT_GAIN: usize = 3;
const LOST_WITHOUT_GAIN_STIFF: usize = 2;
const LOST_WITHOUT_GAIN_IN_STIFF_PERIOD: usize = 1;
/// Under stiff coatings in free space as well after so many applications that leave so much of the pressure over: by trial, films 100 to 5000 times
/// stiffer on 96 and 192 cells per side, where it seldom found its way from there.
const MOST_APPLICATIONS_STIFF: usize = 30;
const LEFT_OVER: f64 = 0.3;

/// Solves the equations from feasible `tractions` with their `displacements`; both end at the solution, or at what was reached.
///
/// # Errors
/// When the iteration does not converge or is stopped.
pub fn solve(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Solution, SolveError> {
    let iterate = Iterate::new(problem, tractions, displacements, operators);
    solve_from(iterate, operators, settings, callback)
}

/// The same from an iterate.
///
/// # Errors
/// As [`solve`].
pub fn solve_from(
    mut iterate: Iterate<'_>,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Solution, SolveError> {
    let mut forcing = ForcingTerm::default();
    let mut circles_left = MOST_ROUNDS_TO_CIRCLES;
    // Shear alone has no other way to be left to; in the staggered scheme it is half a step.
    let most_without_gain =
        match (operators.preconditioner.is_stiff(), operators.preconditioner.is_in_period()) {
            (false, _) => LOST_WITHOUT_GAIN,
            (true, false) => LOST_WITHOUT_GAIN_STIFF,
            (true, true) => LOST_WITHOUT_GAIN_IN_STIFF_PERIOD,
        };
    let has_another_way = iterate.is_of_both();
    let may_be_lost = operators.preconditioner.is_stiff() && !operators.preconditioner.is_in_period();
    let begun = operators.compliance.applications;
    for iteration in 0..settings.max_newton_iterations {
        let residual = iterate.evaluate();
        if callback(iteration, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < settings.tolerance {
            if circles_left > 0 && iterate.puts_slipping_cells_on_their_circles() {
                circles_left -= 1;
                iterate.find_displacements(operators);
                continue;
            }
            return Ok(iterate.solution(iteration));
        }
        let target = forcing.next(residual, settings.tolerance);
        let spent = operators.compliance.applications - begun;
        let is_lost = may_be_lost && spent >= MOST_APPLICATIONS_STIFF && residual > LEFT_OVER;
        if has_another_way && (is_lost || forcing.without_gain >= most_without_gain) {
            return Err(not_converged(iteration, &forcing));
        }
        iterate.find_sets();
        iterate.find_step(target, settings, operators);
        if !iterate.take_step() {
            return Err(not_converged(iteration, &forcing));
        }
        iterate.find_displacements(operators);
    }
    Err(not_converged(settings.max_newton_iterations, &forcing))
}

fn not_converged(iterations: usize, forcing: &ForcingTerm) -> SolveError {
    SolveError::NotConverged { reached: forcing.best, iterations }
}

/// The residual of tractions with their `displacements`, and what goes with it.
pub fn evaluate(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &RegionOperators,
) -> (f64, Solution) {
    let mut iterate = Iterate::new(problem, tractions, displacements, operators);
    let residual = iterate.evaluate();
    (residual, iterate.solution(0))
}

/// Brings shear to what the friction law allows under its pressure, with exact resultants.
pub fn make_shear_feasible(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    operators: &RegionOperators,
) {
    let own = operators.compliance.self_influence().tangential;
    project_shear(problem, tractions, |contact, shear, bound| {
        ActiveSets::of(shear, &TangentialField::zeros(contact.len()), bound, own)
    });
}

/// The same on the active sets of a contact, its shear and the bound of that.
pub fn project_shear(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    sets: impl FnOnce(&ContactSet, &TangentialField, &FrictionBound) -> ActiveSets,
) {
    let contact = ContactSet::loaded(&tractions.pressure);
    let bound = problem.friction.packed(&contact).bound(&contact.packed(&tractions.pressure));
    let mut shear = contact.packed_tangential(&tractions.shear);
    let sets = sets(&contact, &shear, &bound);
    let (motions, resultant) = (problem.motions_of(&contact), problem.to_restore(&shear, &bound.bound));
    ShearProjection::default().project(&mut shear, &sets, &bound.bound, &motions, resultant);
    contact.scatter_tangential(&shear, &mut tractions.shear);
}
