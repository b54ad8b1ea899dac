//! The scheme of the published three-level methods (Panagiotopoulos 1975): pressure at given shear, then shear at given pressure, until
//! the laws of both hold at once. It takes several times as many operator applications as the Newton method: a cross-check of that, and
//! what is left where its active sets wander from every start.

use super::contact_problem::{ContactProblem, Pressure, Solution};
use super::newton;
use super::normal::{NormalEquations, solve_normal};
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::fields::add_scaled;

/// Fraction of the residual reached so far to which pressure and shear are solved in their turn.
const INNER: f64 = 0.1;

/// Sweeps at the most.
const MOST_SWEEPS: usize = 200;

/// Solves the coupled equations from feasible `tractions` with their `displacements`; both end at the solution.
///
/// # Errors
/// When the sweeps do not converge or are stopped.
pub fn solve(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Solution, SolveError> {
    let cells = problem.undeformed.len();
    let unloaded = Tractions::zeros(cells);
    let mut from_pressure = Displacements::zeros(cells);
    let mut from_shear = Displacements::zeros(cells);
    let mut best = f64::INFINITY;
    for sweep in 0..MOST_SWEEPS {
        let (residual, solution) = newton::evaluate(problem, tractions, displacements, operators);
        best = best.min(residual);
        if callback(sweep, residual).is_break() {
            return Err(SolveError::Stopped);
        }
        if residual < settings.tolerance {
            return Ok(Solution { iterations: sweep, ..solution });
        }
        let tolerance = (INNER * residual.min(1.0)).max(0.3 * settings.tolerance);
        let inner = SolverSettings { tolerance, ..*settings };
        // Pressure, over the surface that the shear has displaced.
        let [x, y] = tractions.shear.parts();
        operators.compliance.full([&unloaded.pressure, x, y], from_shear.parts_mut());
        let mut undeformed = problem.undeformed.to_vec();
        add_scaled(&mut undeformed, 1.0, &from_shear.normal);
        let equations =
            NormalEquations { undeformed: &undeformed, load: problem.normal, positions: problem.positions };
        let fields = [&mut tractions.pressure[..], &mut from_pressure.normal];
        solve_normal(&equations, fields, operators, &inner, callback)?;
        // Shear, under that pressure and its tangential displacement.
        let [x, y] = unloaded.shear.parts();
        operators.compliance.full([&tractions.pressure, x, y], from_pressure.parts_mut());
        let mut before = problem.before.clone();
        before.add_scaled(-1.0, &from_pressure.tangential);
        let given = ContactProblem { pressure: Pressure::Given, before: &before, ..*problem };
        newton::make_shear_feasible(&given, tractions, operators);
        operators.compliance.tangential(tractions.shear.parts(), from_shear.tangential.parts_mut());
        match newton::solve(&given, tractions, &mut from_shear, operators, &inner, callback) {
            // What was reached is where the next sweep begins.
            Ok(_) | Err(SolveError::NotConverged { .. }) => {}
            Err(error) => return Err(error),
        }
        operators.compliance.full(tractions.parts(), displacements.parts_mut());
    }
    Err(SolveError::NotConverged { reached: best, iterations: MOST_SWEEPS })
}
