//! What the equations of a region do not say of a solution: forces that a prescribed approach leaves too large, shear across the only axis, contact at
//! the edge of the grid.

use ndarray::Array2;

use super::region::Region;
use super::{Carried, ContactSolver, Outcome, SolveError};
use crate::model::{ContactState, LoadStep};

impl ContactSolver<'_> {
    /// Whether what was found is a solution: as far as the equations of the region do not say.
    pub(super) fn check(
        &self,
        load: &LoadStep,
        after: &ContactState,
        outcome: &Outcome,
        iterations: usize,
    ) -> Result<(), SolveError> {
        self.check_equilibrium(load, outcome, iterations)?;
        self.check_across(after, iterations)?;
        if self.beyond.is_body() && self.touches_edge(&after.pressure) {
            return Err(SolveError::ContactAtEdge);
        }
        Ok(())
    }

    /// Whether the forces asked for are those of the solution: with a prescribed approach they may be more than friction carries.
    fn check_equilibrium(
        &self,
        load: &LoadStep,
        outcome: &Outcome,
        iterations: usize,
    ) -> Result<(), SolveError> {
        self.check_friction_carries(load, outcome.resultants.normal, 1.0 + self.settings.tolerance)?;
        let reached = outcome.residual.equilibrium;
        if reached <= self.settings.tolerance {
            return Ok(());
        }
        Err(SolveError::NotConverged { reached, iterations })
    }

    /// Whether all cells of a region at the hardness carry more than the prescribed normal force.
    pub(super) fn hardness_bears(&self, load: &LoadStep, region: Region) -> bool {
        let Some((force, hardness)) = load.normal.force().zip(self.hardness) else { return true };
        force < hardness * region.len() as f64 * self.grid.cell_area()
    }

    /// Whether those of the whole grid do.
    pub(super) fn check_hardness_bears(&self, load: &LoadStep) -> Result<(), SolveError> {
        if self.hardness_bears(load, Region::whole(self.grid.cells())) {
            return Ok(());
        }
        if self.beyond.is_body() && !self.response.is_periodic() {
            return Err(SolveError::ContactAtEdge);
        }
        let asked = load.normal.force().unwrap_or(0.0);
        let bound = self.hardness.unwrap_or(0.0) * self.grid.len() as f64 * self.grid.cell_area();
        Err(SolveError::AboveHardness { asked, bound })
    }

    /// Whether there is no shear across the one axis along which it acts: its displacement is left out, so that nothing else would
    /// tell.
    fn check_across(&self, state: &ContactState, iterations: usize) -> Result<(), SolveError> {
        let Some(axis) = self.shear_axis else { return Ok(()) };
        let size = |field: &Array2<f64>| field.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let (across, bound) = (size(&state.shear[1 - axis]), self.friction.largest() * size(&state.pressure));
        if across <= self.settings.tolerance * bound {
            return Ok(());
        }
        let reached = if bound > 0.0 { across / bound } else { 1.0 };
        Err(SolveError::NotConverged { reached, iterations })
    }

    /// Whether the prescribed tangential force is at most a `fraction` of what the friction coefficient carries.
    pub(super) fn check_friction_carries(
        &self,
        load: &LoadStep,
        normal: f64,
        fraction: f64,
    ) -> Result<(), SolveError> {
        let asked = tangential_force(load);
        let bound = self.friction.largest() * normal.max(0.0);
        if asked > bound * fraction {
            return Err(SolveError::AboveSliding { asked, bound, by: Carried::Coefficient });
        }
        Ok(())
    }
}

/// Size of the prescribed tangential force [force].
fn tangential_force(load: &LoadStep) -> f64 {
    let [x, y] = load.tangential.map(|control| control.force().unwrap_or(0.0));
    x.hypot(y)
}
