//! The frame of the upper body: what the contact leaves on its cells, which lie over others at the end of each increment.

use ndarray::Array2;

use crate::fields::{InPlane, Outside};
use crate::model::{ContactState, Motion};
use crate::plan::Plan;
use crate::solver::SolveError;

/// How the upper body moves over the grid, on which its own cells lay without a shift.
#[derive(Debug, Clone, Copy)]
pub struct UpperFrame {
    motion: Motion,
    /// Whether the surfaces repeat.
    repeats: bool,
}

impl UpperFrame {
    /// Of a plan.
    pub fn of(plan: &Plan) -> Self {
        Self { motion: Motion::over(&plan.grid), repeats: plan.case.periodic.is_both() }
    }

    fn outside(self) -> Outside {
        if self.repeats { Outside::Repeats } else { Outside::Zero }
    }

    fn back_from(self, state: &ContactState) -> InPlane {
        self.motion.back_from(self.motion.place(state.shift, state.twist))
    }

    /// A field over the grid in a state, on the cells of the body that lie there.
    pub fn brought_back(self, over_grid: &Array2<f64>, state: &ContactState) -> Array2<f64> {
        self.back_from(state).of(over_grid, self.outside())
    }

    /// Adds a field over the grid in a state to what the cells of the body that lie there have collected.
    ///
    /// # Errors
    /// When it leaves the grid, on which the body lay without a shift.
    pub fn collect(
        self,
        over_grid: &Array2<f64>,
        state: &ContactState,
        to: &mut Array2<f64>,
    ) -> Result<(), SolveError> {
        let back = self.back_from(state);
        if !self.repeats && back.leaves(over_grid) {
            return Err(SolveError::ContactAtEdge);
        }
        *to += &back.of(over_grid, self.outside());
        Ok(())
    }
}
