//! Pressure first, then shear under it: for bodies whose shear does not move the surfaces normally, and without friction.

use super::contact_problem::{Pressure, Solution};
use super::increment_problem::{IncrementProblem, Solved};
use super::laws::complementarity::{CellLaw, normal_residual};
use super::laws::limit::sliding_fraction;
use super::laws::projection::project_pressure;
use super::newton;
use super::normal::{NormalSolution, solve_normal};
use super::operators::RegionOperators;
use super::settings::{Coupling, IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::fields::sum;
use crate::model::TangentialField;

/// So far outside of its circle that no rounding takes it off.
const ON_CIRCLE: f64 = 1.0 + 1e-9;

/// Tolerances that a pressure which is kept may leave: it was solved to one, by a residual that is summed up otherwise.
const STILL: f64 = 10.0;

/// Solves an increment from predicted `tractions`. `last`: displacements of the state before, when they are known;
/// `keeps_pressure`: its pressure is the one asked for.
///
/// # Errors
/// When an iteration does not converge, or is stopped.
pub fn solve(
    increment: &IncrementProblem<'_>,
    mut tractions: Tractions,
    (last, keeps_pressure): (Option<&Displacements>, bool),
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Solved, SolveError> {
    let settings = &increment.limited(settings);
    // Nothing along the surface is asked for without friction.
    let cells = if increment.coupling == Coupling::Frictionless { 0 } else { increment.region.len() };
    let normal = vec![0.0; increment.region.len()];
    let mut displacements = Displacements { normal, tangential: TangentialField::zeros(cells) };
    let mut kept = None;
    if let (true, Some(last)) = (keeps_pressure, last) {
        tractions.pressure = increment.region.gather(&increment.state.pressure);
        displacements.normal.clone_from(&last.normal);
        let pressure = pressure_before(increment, &displacements, &tractions, operators);
        kept = Some(pressure).filter(|kept| kept.residual.residual <= STILL * settings.tolerance);
    }
    let pressure = if let Some(kept) = kept {
        kept
    } else {
        let total = increment.normal.total;
        let goes_on = increment.start.is_none()
            && increment.touched
            && project_pressure(&mut tractions.pressure, total, increment.tilt_motions().as_ref());
        if !goes_on {
            tractions.pressure = increment.first_pressure(operators);
        }
        let predicted = increment.travels.then(|| tractions.pressure.clone());
        let fields = [&mut tractions.pressure[..], &mut displacements.normal];
        let found = solve_normal(&increment.normal_equations(), fields, operators, settings, callback)?;
        if let Some(predicted) = predicted {
            make_shear_follow(&mut tractions, &predicted);
        }
        found
    };
    let mut drift = TangentialField::zeros(cells);
    let mut solution = Solution::without_slip(cells, increment.tangential.motion);
    if increment.coupling == Coupling::Frictionless
        || settings.skip_unloaded_shear && !increment.causes_shear()
    {
        tractions.shear.clear();
    } else {
        let before = increment.displacement_before(last, operators);
        let counted_from = increment.counted_from(&before);
        let problem = increment.contact_problem(Pressure::Given, &counted_from);
        if !increment.tangential.held()[2] {
            // Without a moment the limit is the sum of the bounds.
            increment.check_limit(&tractions, 1.0 / sliding_fraction(settings.tolerance))?;
        }
        newton::make_shear_feasible(&problem, &mut tractions, operators);
        operators.compliance.tangential(tractions.shear.parts(), displacements.tangential.parts_mut());
        let found =
            newton::solve(&problem, &mut tractions, &mut displacements, operators, settings, callback);
        if let (Err(SolveError::NotConverged { .. }), false) = (&found, increment.path.turns()) {
            increment.check_limit(&tractions, 1.0)?;
        }
        solution = found?;
        drift = increment.drift(&before, &displacements.tangential, solution.tangential.motion);
    }
    let NormalSolution { residual: normal, gap, iterations } = pressure;
    let solution = Solution { normal, gap, iterations: iterations + solution.iterations, ..solution };
    Ok(Solved { tractions, displacements, drift, solution, yielded: Vec::new() })
}

/// Shear predicted with a pressure keeps its ratio to the pressure, so that what slips stays on its circle; in cells that enter it has the mean ratio.
fn make_shear_follow(tractions: &mut Tractions, predicted: &[f64]) {
    let Tractions { pressure, shear } = tractions;
    let total = sum(predicted);
    for part in shear.parts_mut() {
        let mean = if total > 0.0 { sum(part) / total } else { 0.0 };
        for ((q, p), before) in part.iter_mut().zip(&*pressure).zip(predicted) {
            let ratio = if *before > 0.0 { *q / before } else { mean };
            *q = ratio * p * ON_CIRCLE;
        }
    }
}

/// What the pressure of the state before is a solution of, with its displacement.
fn pressure_before(
    increment: &IncrementProblem<'_>,
    displacements: &Displacements,
    tractions: &Tractions,
    operators: &RegionOperators,
) -> NormalSolution {
    let IncrementProblem { undeformed, normal, .. } = increment;
    let self_influence = operators.compliance.self_influence().normal;
    let (mut gap, tilt) = (Vec::new(), increment.tilt_motions());
    let (pressure, heights) = (&tractions.pressure, (&displacements.normal[..], &undeformed[..]));
    let motions = (normal.approach_under(pressure), tilt.as_ref());
    let law = CellLaw::under(normal, self_influence);
    let residual = normal_residual(pressure, heights, law, motions, &mut gap);
    NormalSolution { residual, gap, iterations: 0 }
}
