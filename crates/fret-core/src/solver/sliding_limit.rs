//! What a contact carries that slides, where its pressure decides it: at a prescribed approach the normal force falls while it is dragged along; where
//! friction differs from place to place, pressure goes over from one place to another.

use super::augmented_newton::AugmentedNewton;
use super::contact_problem::ContactProblem;
use super::contact_set::ContactSet;
use super::increment_problem::{COUPLED_LIMIT, IncrementProblem};
use super::newton;
use super::operators::RegionOperators;
use super::prescribed::TangentialLoads;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;

/// Residual to which sliding is solved.
const SLIDING: f64 = 1e-6;
/// A force above this times that of sliding is not carried. On the way there it may be a little more: up to 1.004 times on films of 0.2 to
/// 0.5 contact radii that keep their volume (friction 0.8 and 1.5).
const LIMIT: f64 = 1.01;
/// Motions that are tried, at most: where a contact may turn, its pressure decides how it slides, and how it slides its pressure.
const MOST_MOTIONS: usize = 12;
/// Relative change of what is carried at which a motion is the one before.
const SAME: f64 = 1e-5;

/// What a contact that slides carries of the forces and moments that are prescribed.
pub struct SlidingLimit {
    /// Their fraction [-]; `None` where it is known before, or not found.
    fraction: Option<f64>,
}

impl SlidingLimit {
    /// Refuses more than a contact carries before it slides; where that is unknown, by the pressure without friction.
    ///
    /// # Errors
    /// When it is.
    pub fn check(
        &self,
        increment: &IncrementProblem<'_>,
        frictionless: &Tractions,
    ) -> Result<(), SolveError> {
        match self.fraction {
            Some(fraction) if LIMIT * fraction < 1.0 => Err(increment.above_limit(fraction)),
            Some(_) => Ok(()),
            None => increment.check_limit(frictionless, COUPLED_LIMIT),
        }
    }

    /// Refuses what is more than is carried in sliding, where no way has led to a solution.
    ///
    /// # Errors
    /// When it is.
    pub fn check_unsolved(&self, increment: &IncrementProblem<'_>) -> Result<(), SolveError> {
        match self.fraction {
            Some(fraction) if fraction < 1.0 => Err(increment.above_limit(fraction)),
            _ => Ok(()),
        }
    }
}

/// What a contact carries that slides as a whole, from `start`: along the force, or by the motion that its own pressure carries least of.
///
/// # Errors
/// When the iteration is stopped.
pub fn sliding_limit(
    increment: &IncrementProblem<'_>,
    problem: &ContactProblem<'_>,
    start: &Tractions,
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<SlidingLimit, SolveError> {
    let unknown = SlidingLimit { fraction: None };
    let (prescribed, turns) = (increment.prescribed(), problem.tangential.held()[2]);
    let is_known = problem.normal.total.is_some() && problem.friction.is_uniform() && !turns;
    if is_known || prescribed == [0.0; 3] {
        return Ok(unknown);
    }
    let all = problem.motions_of(&ContactSet::of(increment.region.len(), |_| true));
    let settings = SolverSettings { tolerance: SLIDING, ..*settings };
    let (mut tractions, mut displacements) = (start.clone(), Displacements::zeros(increment.region.len()));
    let mut fraction = None;
    for _ in 0..MOST_MOTIONS {
        let motion = increment.sliding(&tractions).motion;
        let farthest = (0..increment.region.len())
            .map(|cell| all.at(motion, cell))
            .fold(0.0_f64, |most, [x, y]| most.max(x.hypot(y)));
        // Slip by the size of the region: what sheared the contact before is nothing beside it.
        let motion = motion.map(|part| part * problem.positions.length / farthest);
        let tangential = TangentialLoads { motion, ..TangentialLoads::default() };
        let sliding = ContactProblem { tangential, ..*problem };
        let ends = (&mut tractions, &mut displacements);
        if !slides(&sliding, ends, operators, &settings, callback)? {
            return Ok(unknown);
        }
        let work = |cell: usize| {
            let ([x, y], [qx, qy]) = (all.at(motion, cell), tractions.shear.at(cell));
            x * qx + y * qy
        };
        let asked: f64 = (0..3).map(|mode| prescribed[mode] * motion[mode]).sum();
        let carried = (0..increment.region.len()).map(work).sum::<f64>() / asked;
        let last = fraction.replace(carried);
        if !turns || last.is_some_and(|last: f64| (carried - last).abs() < SAME * last) {
            break;
        }
    }
    Ok(SlidingLimit { fraction })
}

/// Solves a contact that slides; false where no solution is found.
fn slides(
    problem: &ContactProblem<'_>,
    (tractions, displacements): (&mut Tractions, &mut Displacements),
    operators: &mut RegionOperators,
    settings: &SolverSettings,
    callback: IterationCallback<'_>,
) -> Result<bool, SolveError> {
    newton::make_shear_feasible(problem, tractions, operators);
    operators.compliance.full(tractions.parts(), displacements.parts_mut());
    let start = tractions.clone();
    match newton::solve(problem, tractions, displacements, operators, settings, callback) {
        Err(SolveError::NotConverged { .. }) => {
            let from = AugmentedNewton::new(problem, &start, operators);
            Ok(from.solve((tractions, displacements), operators, settings, callback)?.is_some())
        }
        other => other.map(|_| true),
    }
}
