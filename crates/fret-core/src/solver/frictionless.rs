//! The pressure of an increment with its shear left as it is: first guess and solution.

use super::increment_problem::IncrementProblem;
use super::normal::{NormalSolution, first_pressure, solve_normal};
use super::operators::RegionOperators;
use super::settings::{IterationCallback, SolveError, SolverSettings};
use super::tractions::{Displacements, Tractions};
use crate::compliance::SurfaceCompliance;

impl IncrementProblem<'_> {
    /// A first pressure [pressure].
    pub fn first_pressure(&self, operators: &RegionOperators) -> Vec<f64> {
        if let Some(start) = &self.start {
            return start.clone();
        }
        let equations = self.normal_equations();
        first_pressure(&equations, operators.compliance.self_influence().normal)
    }

    /// Solves the frictionless problem from the pressure there is; `displacements` are those of the solution, along the normal.
    ///
    /// # Errors
    /// When the iteration does not converge or is stopped.
    pub fn solve_pressure(
        &self,
        tractions: &mut Tractions,
        displacements: &mut Displacements,
        operators: &mut RegionOperators,
        settings: &SolverSettings,
        callback: IterationCallback<'_>,
    ) -> Result<NormalSolution, SolveError> {
        let RegionOperators { compliance, preconditioner, .. } = operators;
        compliance.normal(&tractions.pressure, &mut displacements.normal);
        let (equations, pressure) = (self.normal_equations(), &mut tractions.pressure);
        let displacement = &mut displacements.normal;
        solve_normal(&equations, pressure, displacement, compliance, preconditioner, settings, callback)
    }
}
