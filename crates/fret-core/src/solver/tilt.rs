//! Tilt of the upper body: a plane taken off the gap. Where a moment of the pressure is prescribed its tilt is solved for with all other motions;
//! here is what goes before and after.

use super::settings::{IterationCallback, SolveError};
use super::{ContactSolver, Increment};
use crate::model::{ContactState, LoadStep};

impl ContactSolver<'_> {
    /// The same solver whose upper body is tilted: that of a state that it goes on from.
    pub fn set_tilt(&mut self, tilt: [f64; 2]) {
        if tilt == self.tilt {
            return;
        }
        let level = self.level.get_or_insert_with(|| self.undeformed.clone());
        let (grid, middle) = (self.grid, self.middle);
        let [x, y] = [0, 1].map(|axis| {
            let at = |index| tilt[axis] * (middle[axis] + grid.centre(axis, index));
            (0..grid.cells()[axis]).map(at).collect::<Vec<f64>>()
        });
        for ((i, j), gap) in self.undeformed.indexed_iter_mut() {
            *gap = level[[i, j]] - (x[i] + y[j]);
        }
        self.tilt = tilt;
        self.coarse = None;
    }

    /// Solves one increment of the part in front of the mirrors, from the tilt that is prescribed, or that of the state before.
    pub(super) fn solve_tilted(
        &mut self,
        state: &ContactState,
        load: &LoadStep,
        callback: IterationCallback<'_>,
    ) -> Result<Increment, SolveError> {
        self.take_plastic_depth(state);
        self.set_tilt([0, 1].map(|axis| load.tilt[axis].motion().unwrap_or(state.tilt[axis])));
        let moment = load.tilt.map(|tilt| tilt.force().unwrap_or(0.0));
        if moment == [0.0; 2] {
            return self.solve(state, load, callback);
        }
        self.check_carries(load, moment)?;
        let solved = self.solve(state, load, callback)?;
        if solved.outcome.contact_cells == 0 { Err(no_tilt(moment, 0.0)) } else { Ok(solved) }
    }

    /// Whether the body reaches as far as the centre of a pressure with the prescribed force and `moment` [force x length].
    fn check_carries(&self, load: &LoadStep, moment: [f64; 2]) -> Result<(), SolveError> {
        let Some(force) = load.normal.force() else { return Ok(()) };
        let size = moment[0].hypot(moment[1]);
        let (grid, middle, beyond) = (self.grid, self.middle, self.beyond_the_body());
        let level = self.level.as_ref().unwrap_or(&self.undeformed);
        let mut farthest = 0.0_f64;
        for ((i, j), _) in level.indexed_iter().filter(|(_, gap)| **gap < beyond) {
            let at = [middle[0] + grid.centre(0, i), middle[1] + grid.centre(1, j)];
            farthest = farthest.max((at[0] * moment[0] + at[1] * moment[1]) / size);
        }
        let most = force.max(0.0) * farthest;
        if size < most { Ok(()) } else { Err(no_tilt(moment, most / size)) }
    }
}

/// No tilt gives this moment, of which a `fraction` is carried.
fn no_tilt(moment: [f64; 2], fraction: f64) -> SolveError {
    let asked = if moment[0].abs() >= moment[1].abs() { moment[0] } else { moment[1] };
    SolveError::NoTilt { asked, reached: fraction * asked }
}
