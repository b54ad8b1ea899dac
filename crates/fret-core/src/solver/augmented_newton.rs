//! Semismooth Newton method on the projection equations, whose iterates need not be feasible (Alart & Curnier 1991; Christensen, Klarbring, Pang &
//! Stromberg 1998). With `y = p - g / K_n` and `w = q + slip / K_t` of every cell:
//!
//! ```text
//! p = max(y, 0),    q = Proj(w) onto the disc of radius b(y)
//! ```
//!
//! The bound takes the augmented pressure y, so that its derivative ties shear to pressure and gap at once. Nothing is projected on the way; how
//! much of a step is taken costs nothing, since displacements are linear in it: so the squared residual falls in every step, and active sets
//! that wander where they are read off feasible tractions settle here. Linear problems are those of `newton.rs`.

mod equations;
mod linear_step;
mod point;

use super::contact_problem::{ContactProblem, Solution};
use super::iterate::Iterate;
use super::newton;
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;
use equations::Equations;
use point::Point;

/// Left over by the equations, of the pressure, where the quick way goes on; and where that does not help, times this.
const NEAR: f64 = 1e-3;
const NEARER: f64 = 1e-3;
/// Below this fraction of the tolerance the quick way has nothing left to do but to say so.
const ENOUGH: f64 = 0.1;

/// Given up after so many steps that do not gain a tenth together: what is left over is rounding, or no step leads further.
const LOST_AFTER: usize = 10;
/// Halvings of a step at the most.
const MOST_HALVINGS: usize = 9;
/// A step is short enough when the residual falls by this fraction of it.
const FALL: f64 = 0.1;

/// The forcing term where the residual does not fall fast; where the response is stiff, what is left over of the linear problem is in the long
/// waves, which move all of the contact.
const FORCING: f64 = 0.03;
const FORCING_STIFF: f64 = 0.01;

/// The method on its way.
pub struct AugmentedNewton<'a> {
    equations: Equations<'a>,
    here: Point,
    /// What the equations leave over at `here` [pressure].
    merit: f64,
    forcing: f64,
    steps: usize,
    /// Least merit so far, and steps since a tenth of it was gained.
    best: f64,
    stalled: usize,
}

impl<'a> AugmentedNewton<'a> {
    /// From tractions, feasible or not.
    pub fn new(
        problem: &'a ContactProblem<'a>,
        tractions: &Tractions,
        operators: &mut RegionOperators,
    ) -> Self {
        let equations = Equations::new(problem, tractions, operators);
        let mut displacements = Displacements::zeros(tractions.pressure.len());
        operators.compliance.full(tractions.parts(), displacements.parts_mut());
        let here = equations.start(tractions, displacements);
        let merit = equations.merit(&here);
        Self { equations, here, merit, forcing: most_forcing(operators), steps: 0, best: merit, stalled: 0 }
    }

    /// Solves the equations by iterates that need not be feasible until the quick way, which judges what is found, goes on from there; `None` where none
    /// leads to a solution. Ends with the tractions and displacements at the solution, or at what was reached.
    ///
    /// # Errors
    /// When the iteration is stopped.
    pub fn solve(
        mut self,
        (tractions, displacements): (&mut Tractions, &mut Displacements),
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<Option<Solution>, SolveError> {
        let mut goal = NEAR.min(NEARER * self.left_over());
        let enough = ENOUGH * settings.tolerance;
        loop {
            let goes_on = self.advance(goal.max(enough), operators, settings, callback)? && goal > enough;
            if !self.left_over().is_finite() || !self.projected(tractions, displacements, operators) {
                return Ok(None);
            }
            let near = Iterate::new(self.equations.problem, tractions, displacements, operators);
            match newton::solve_from(near.near_motion(self.here.motion), operators, settings, callback) {
                Err(SolveError::NotConverged { .. }) if goes_on => {}
                Err(SolveError::NotConverged { .. }) => return Ok(None),
                other => return other.map(Some),
            }
            goal *= NEARER;
        }
    }

    /// Goes on until the equations leave less than `goal` of the pressure over. False where no step leads there.
    ///
    /// # Errors
    /// When the iteration is stopped.
    pub fn advance(
        &mut self,
        goal: f64,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<bool, SolveError> {
        loop {
            let residual = self.left_over();
            if callback(self.steps, residual).is_break() {
                return Err(SolveError::Stopped);
            }
            if residual < goal {
                return Ok(true);
            }
            let is_lost = self.steps == settings.max_newton_iterations || self.stalled == LOST_AFTER;
            if is_lost || !residual.is_finite() {
                return Ok(false);
            }
            self.steps += 1;
            operators.augmented_steps += 1;
            let Some(next) = self.equations.newton_point(&self.here, operators, settings, self.forcing)
            else {
                return Ok(false);
            };
            self.go_towards(&next);
            let most = most_forcing(operators);
            self.forcing = self.forcing.min(most);
        }
    }

    /// Where it stands.
    pub fn into_tractions(self) -> Tractions {
        self.here.tractions
    }

    /// What the equations leave over, of the pressure.
    pub fn left_over(&self) -> f64 {
        self.merit / self.here.size()
    }

    /// Takes as much of the step to `next` as makes the residual fall enough; where no part does, the best of those tried.
    fn go_towards(&mut self, next: &Point) {
        let mut best: Option<(f64, Point)> = None;
        let mut fraction = 1.0;
        for _ in 0..=MOST_HALVINGS {
            let trial = self.here.towards(next, fraction);
            let merit = self.equations.merit(&trial);
            if best.as_ref().is_none_or(|best| merit < best.0) {
                best = Some((merit, trial));
            }
            if merit < self.merit * (1.0 - FALL * fraction) {
                break;
            }
            fraction *= 0.5;
        }
        if let Some((merit, point)) = best {
            let ratio = merit / self.merit;
            // Eisenstat & Walker 1996, their second choice.
            self.forcing = if ratio < 1.0 { (0.5 * ratio.powf(1.5)).max(1e-4) } else { f64::INFINITY };
            (self.merit, self.here) = (merit, point);
            self.stalled += 1;
            if merit < 0.9 * self.best {
                (self.best, self.stalled) = (merit, 0);
            }
        }
    }

    /// The tractions projected onto what the laws allow, slipping cells on their circles, with their displacements.
    fn projected(
        &self,
        tractions: &mut Tractions,
        displacements: &mut Displacements,
        operators: &mut RegionOperators,
    ) -> bool {
        let is_held = self.equations.project(&self.here, tractions);
        operators.compliance.full(tractions.parts(), displacements.parts_mut());
        is_held
    }
}

fn most_forcing(operators: &RegionOperators) -> f64 {
    if operators.preconditioner.is_stiff() { FORCING_STIFF } else { FORCING }
}

#[cfg(test)]
mod tests;
