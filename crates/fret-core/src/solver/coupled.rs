//! Pressure and shear of one increment together, and what is done where the Newton method does not converge.

use super::augmented_newton::AugmentedNewton;
use super::contact_problem::{Pressure, Solution};
use super::increment_problem::{IncrementProblem, Solved};
use super::laws::projection::project_pressure;
use super::nested_start::nested_start;
use super::newton;
use super::normal::solve_normal;
use super::operators::{Method, RegionOperators};
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::sliding_limit::sliding_limit;
use super::staggered;
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use crate::model::Scheme;

/// Residual to which the frictionless start of a first contact is solved.
const ROUGH: f64 = 1e-2;
/// Residual of the pressure without friction that a second start, and the limit of friction, are taken from.
const FRICTIONLESS: f64 = 1e-6;

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
    let touched = increment.touched;
    let mut displacements = Displacements::zeros(increment.region.len());
    let before = increment.displacement_before(last.filter(|_| touched), operators);
    // A contact that has shrunk to less than a cell leaves no pressure to go on from: nor does a first one.
    let goes_on = touched && make_pressure_feasible(&mut tractions, increment);
    if !goes_on {
        tractions.shear.clear();
        tractions.pressure = increment.first_pressure(operators);
        let rough = SolverSettings { tolerance: ROUGH, ..*settings };
        let fields = [&mut tractions.pressure[..], &mut displacements.normal];
        solve_normal(&increment.normal_equations(), fields, operators, &rough, callback)?;
        make_pressure_feasible(&mut tractions, increment);
    }
    let counted_from = increment.counted_from(&before);
    let problem = increment.contact_problem(Pressure::Unknown, &counted_from);
    newton::make_shear_feasible(&problem, &mut tractions, operators);
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    let start = tractions.clone();
    let (p, u) = (&mut tractions, &mut displacements);
    let mut solution = match settings.scheme {
        Scheme::Monolithic => newton::solve(&problem, p, u, operators, settings, callback),
        Scheme::Staggered => staggered::solve(&problem, p, u, operators, settings, callback),
    };
    if let (Err(SolveError::NotConverged { .. }), Scheme::Monolithic, true) =
        (&solution, settings.scheme, settings.another_way)
    {
        let mut found = None;
        let (preconditioner, load_stays) = (&operators.preconditioner, !increment.changes_normal_load());
        if preconditioner.is_stiff()
            && !(load_stays && preconditioner.is_in_period())
            && let Some(from) = nested_start((&problem, load_stays), &start, operators, method, callback)?
        {
            found = from.solve((p, u), operators, settings, callback)?;
        }
        if found.is_none() {
            let from = AugmentedNewton::new(&problem, &start, operators);
            found = from.solve((p, u), operators, settings, callback)?;
        }
        if found.is_none() && !increment.path.turns() {
            let frictionless = without_friction(increment, &start, operators, settings, callback)?;
            let slides = sliding_limit(increment, &problem, &frictionless, operators, settings, callback)?;
            slides.check(increment, &frictionless)?;
            let from = AugmentedNewton::new(&problem, &frictionless, operators);
            found = from.solve((p, u), operators, settings, callback)?;
            if found.is_none() {
                p.clone_from(&frictionless);
                newton::make_shear_feasible(&problem, p, operators);
                operators.compliance.full(p.parts(), u.parts_mut());
                found = swept(staggered::solve(&problem, p, u, operators, settings, callback))?;
            }
            if found.is_none() {
                slides.check_unsolved(increment)?;
            }
        }
        solution = found.map_or(solution, Ok);
    }
    let solution = solution?;
    let drift = increment.drift(&before, &displacements.tangential, solution.tangential.motion);
    Ok(Solved { tractions, displacements, drift, solution, yielded: Vec::new() })
}

/// What sweeps of pressure and shear in turn found, the last of all ways; `None` where they do not converge.
fn swept(solved: Result<Solution, SolveError>) -> Result<Option<Solution>, SolveError> {
    match solved {
        Err(SolveError::NotConverged { .. }) => Ok(None),
        other => other.map(Some),
    }
}

/// Brings predicted pressure to what its laws allow. Shear keeps its ratio to the pressure, and so a cell under `mu p` stays on its circle.
/// False when a force is prescribed and no pressure is left to carry it.
fn make_pressure_feasible(tractions: &mut Tractions, increment: &IncrementProblem<'_>) -> bool {
    let total = increment.normal.total;
    if let Some(total) = total {
        let found: f64 = tractions.pressure.iter().map(|p| p.max(0.0)).sum();
        if found > 0.0 {
            for q in tractions.shear.x.iter_mut().chain(&mut tractions.shear.y) {
                *q *= total / found;
            }
        }
    }
    project_pressure(&mut tractions.pressure, total, increment.tilt_motions().as_ref())
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
