//! Pressure and shear of one increment together, and what is done where the Newton method does not converge.

use super::contact_problem::{ContactProblem, Pressure, Solution};
use super::exact_newton;
use super::increment_problem::{COUPLED_LIMIT, IncrementProblem, Solved};
use super::laws::projection::project_pressure;
use super::newton;
use super::normal::solve_normal;
use super::operators::{Method, RegionOperators};
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::sliding_limit::check_sliding;
use super::staggered;
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::model::Scheme;

/// Residual to which the frictionless start of a first contact is solved.
const ROUGH: f64 = 1e-2;
/// Residual of the pressure without friction that a second start, and the limit of friction, are taken from.
const FRICTIONLESS: f64 = 1e-6;

/// Residual to which pressure and shear in turn lead to a further start; and where that does not help, times this. By trial: films a
/// thousand times stiffer than what they lie on, and pressed flat.
const NEAR: f64 = 1e-2;
const NEARER: f64 = 0.1;

/// Solves an increment from predicted `tractions`. `last`: displacements of the state before, when they are known.
///
/// # Errors
/// When no method converges, or the iteration is stopped.
pub fn solve(
    increment: &IncrementProblem<'_>,
    mut tractions: Tractions,
    last: Option<&Displacements>,
    operators: &mut RegionOperators,
    method: &Method<'_>,
    callback: IterationCallback<'_>,
) -> Result<Solved, SolveError> {
    let settings = &increment.limited(method.settings);
    let touched = increment.touched();
    let mut displacements = Displacements::zeros(increment.region.len());
    let before = increment.displacement_before(last.filter(|_| touched), operators);
    // A contact that has shrunk to less than a cell leaves no pressure to go on from: nor does a first one.
    let goes_on = touched && make_pressure_feasible(&mut tractions, increment.normal.total);
    if !goes_on {
        tractions.shear.clear();
        tractions.pressure = increment.first_pressure(operators);
        let rough = SolverSettings { tolerance: ROUGH, ..*settings };
        let fields = [&mut tractions.pressure[..], &mut displacements.normal];
        solve_normal(&increment.normal_equations(), fields, operators, &rough, callback)?;
        make_pressure_feasible(&mut tractions, increment.normal.total);
    }
    let counted_from = increment.counted_from(&before);
    let problem = increment.contact_problem(Pressure::Unknown, &counted_from);
    newton::make_shear_feasible(&problem, &mut tractions, operators);
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    if std::env::var("AUG").is_ok() {
        let goal = std::env::var("GOAL").ok().and_then(|v| v.parse().ok()).unwrap_or(1e-3);
        super::augmented::solve(&problem, &mut tractions, &mut displacements, operators, settings, goal, callback)?;
    }
    let start = (!increment.path.turns()).then(|| tractions.clone());
    let (p, u) = (&mut tractions, &mut displacements);
    let mut solution = match settings.scheme {
        Scheme::Monolithic => newton::solve(&problem, p, u, operators, settings, callback),
        Scheme::Staggered => {
            staggered::solve(&problem, p, u, operators, settings, staggered::MOST_SWEEPS, callback)
        }
    };
    if let (Err(SolveError::NotConverged { .. }), Scheme::Monolithic, Some(start)) =
        (&solution, settings.scheme, &start)
    {
        let frictionless = without_friction(increment, start, operators, settings, callback)?;
        increment.check_limit(&frictionless, COUPLED_LIMIT)?;
        check_sliding(increment, &problem, &frictionless, operators, settings, callback)?;
        tractions.clone_from(&frictionless);
        let (p, u) = (&mut tractions, &mut displacements);
        let mut found = from_sweeps(&problem, p, u, operators, settings, callback)?;
        if found.is_none() {
            let starts = [start, &frictionless];
            let ends = (&mut tractions, &mut displacements);
            found = exact_newton::solve(&problem, starts, ends, operators, method, callback)?;
        }
        solution = found.map_or(solution, Ok);
    }
    let solution = solution?;
    let drift = increment.drift(&before, &displacements.tangential, solution.tangential.motion);
    Ok(Solved { tractions, displacements, drift, solution })
}

/// Solves the equations from tractions that sweeps of pressure and shear in turn lead near to the solution, and nearer while that is not
/// enough; `None` where they do not.
///
/// # Errors
/// When the iteration is stopped.
fn from_sweeps(
    problem: &ContactProblem<'_>,
    tractions: &mut Tractions,
    displacements: &mut Displacements,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Option<Solution>, SolveError> {
    if settings.max_sweeps == 0 {
        return Ok(None);
    }
    newton::make_shear_feasible(problem, tractions, operators);
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    let mut near = NEAR;
    loop {
        let nearer = SolverSettings { tolerance: near.max(settings.tolerance), ..*settings };
        let sweeps = settings.max_sweeps;
        match staggered::solve(problem, tractions, displacements, operators, &nearer, sweeps, callback) {
            Ok(swept) if near <= settings.tolerance => return Ok(Some(swept)),
            Ok(_) => {}
            Err(SolveError::NotConverged { .. }) => return Ok(None),
            Err(error) => return Err(error),
        }
        let start = (tractions.clone(), displacements.clone());
        match newton::solve(problem, tractions, displacements, operators, settings, callback) {
            Err(SolveError::NotConverged { .. }) => (*tractions, *displacements) = start,
            other => return other.map(Some),
        }
        near *= NEARER;
    }
}

/// Brings predicted pressure to what its laws allow. Shear keeps its ratio to the pressure, and so a cell under `mu p` stays on its circle.
/// False when a force is prescribed and no pressure is left to carry it.
fn make_pressure_feasible(tractions: &mut Tractions, total: Option<f64>) -> bool {
    if let Some(total) = total {
        let found: f64 = tractions.pressure.iter().map(|p| p.max(0.0)).sum();
        if found > 0.0 {
            for q in tractions.shear.x.iter_mut().chain(&mut tractions.shear.y) {
                *q *= total / found;
            }
        }
    }
    project_pressure(&mut tractions.pressure, total)
}

/// The pressure without friction, from that of other tractions; as far as it is found.
fn without_friction(
    increment: &IncrementProblem<'_>,
    start: &Tractions,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<Tractions, SolveError> {
    let mut tractions = start.clone();
    tractions.shear.clear();
    let fields = [&mut tractions.pressure[..], &mut vec![0.0; increment.region.len()]];
    let settings = SolverSettings { tolerance: FRICTIONLESS, ..*settings };
    match solve_normal(&increment.normal_equations(), fields, operators, &settings, callback) {
        Err(SolveError::Stopped) => Err(SolveError::Stopped),
        _ => Ok(tractions),
    }
}
