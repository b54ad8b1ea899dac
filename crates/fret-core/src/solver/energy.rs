//! The first law of thermodynamics in an increment: the work that is put in, what is stored, what friction takes, what goes with worn
//! surfaces, and what an increment of finite length leaves unresolved.
//!
//! With the means of the tractions at both ends, `p = (p0 + p1)/2` and `q = (q0 + q1)/2`, the elastic energy changes by the work of these on
//! the change of the displacements, exactly: the response is linear and reciprocal. The displacements are rigid motions and bulk strains less
//! the drift s and the change of the gap g, so that over all cells
//!
//! ```text
//! external work = change of elastic energy + sum q . s + sum p (g0 - g1).
//! ```
//!
//! Slip takes the first sum in the limit of short increments, and the second vanishes: pressure acts where the gap is zero. Of an increment of
//! finite length the slip is known better than by that sum, see `state_after`. What remains is the energy that it leaves unresolved. Where
//! surfaces yield by `w` there is `sum p w` besides, of which yielding takes `sum H w`: it goes on at the hardness `H`.
//! Theory: `docs/theory/second-order.md`.

use ndarray::Array2;

use super::increment_problem::{IncrementProblem, Solved};
use super::operators::RegionOperators;
use super::region::Region;
use super::tractions::Displacements;
use crate::model::ContactState;

/// The state before an increment, under the surfaces and the bodies of now, in the cells of the region.
pub struct StateBefore {
    /// Gap [length]; empty where bodies have not touched: then it is that before deformation.
    gap: Vec<f64>,
    /// Its displacements, where they were found anew.
    pub displacements: Option<Displacements>,
    /// Energy that went with what has worn off since it was solved, per area of a cell [pressure x length]: by the change of the gap under its
    /// pressure, and in all.
    worn: [f64; 2],
}

impl StateBefore {
    /// The last state of the same surfaces, of known gap.
    pub fn of_gap(gap: &Array2<f64>, region: Region) -> Self {
        Self { gap: region.gather(gap), displacements: None, worn: [0.0; 2] }
    }
}

impl IncrementProblem<'_> {
    /// The state before, of surfaces that may have changed since. Where the bodies touched, its displacements are found by operators.
    pub fn state_before(&self, operators: Option<&mut RegionOperators>) -> StateBefore {
        let Self { region, state, .. } = self;
        let area = self.grid.cell_area() * self.copies as f64;
        if operators.is_none() && !self.touched {
            let worn = [0.0, state.elastic_energy / area];
            return StateBefore { gap: Vec::new(), displacements: None, worn };
        }
        let found = operators.map(|operators| self.displacements_of_state(operators, true));
        let mut gap = Vec::with_capacity(region.len());
        let (mut opened, mut stored) = (0.0, 0.0);
        for cell in 0..region.len() {
            let at = region.at(cell);
            let [normal, x, y] =
                found.as_ref().map_or([0.0; 3], |found| found.parts().map(|part| part[cell]));
            let here = self.gap_before(cell, normal);
            gap.push(here);
            opened += state.pressure[at] * here;
            stored += state.pressure[at] * normal + state.shear[0][at] * x + state.shear[1][at] * y;
        }
        let worn = [opened, opened + state.elastic_energy / area - 0.5 * stored];
        StateBefore { gap, displacements: found, worn }
    }

    /// Gap in the state before by a normal displacement [length].
    fn gap_before(&self, cell: usize, displacement: f64) -> f64 {
        let tilted = self.tilted(self.region.at(cell), self.tilt);
        let moved = self.moved.as_ref().map_or(0.0, |moved| moved[cell]);
        self.undeformed[cell] - moved + tilted + displacement - self.state.approach
    }

    /// By how much a body with this tilt is deeper in a cell than in the state before [length].
    fn tilted(&self, at: [usize; 2], tilt: [f64; 2]) -> f64 {
        let change = |axis: usize| tilt[axis] - self.state.tilt[axis];
        (0..2).map(|axis| change(axis) * (self.stretch.middle[axis] + self.grid.centre(axis, at[axis]))).sum()
    }

    /// Adds to the energies of the state after an increment in which friction `dissipated` so much and the bulk stresses did the work
    /// `by_bulk`, both per area of a cell [pressure x length]. Surfaces that
    /// move work by their slopes under the pressure, and by the displacements that they carry along under the shear.
    pub fn account(
        &self,
        solved: &Solved,
        before: &StateBefore,
        [dissipated, by_bulk]: [f64; 2],
        after: &mut ContactState,
    ) {
        let Self { grid, region, state, .. } = self;
        let mut work = by_bulk;
        let (mut slipped, mut opened, mut given_way, mut yielded) = (0.0, 0.0, 0.0, 0.0);
        let hardness = self.normal.hardness.unwrap_or(0.0);
        let approached = after.approach - state.approach;
        let moved = [0, 1].map(|axis| after.shift[axis] - state.shift[axis]);
        let turned = after.twist - state.twist;
        for cell in 0..region.len() {
            let at = region.at(cell);
            let pressure = 0.5 * (state.pressure[at] + solved.tractions.pressure[cell]);
            if pressure == 0.0 {
                continue;
            }
            let shear = solved.tractions.shear.at_or_zero(cell);
            let [x, y] = [0, 1].map(|axis| 0.5 * (state.shear[axis][at] + shear[axis]));
            let [from_x, from_y] = self.arm(at);
            let [to_x, to_y] = [moved[0] - turned * from_y, moved[1] + turned * from_x];
            let drift = solved.drift.at_or_zero(cell);
            work += pressure * (approached + self.tilted(at, after.tilt)) + x * to_x + y * to_y;
            if let Some(moved) = &self.moved {
                work -= pressure * moved[cell];
            }
            if let Some(carried) = &self.carried {
                work += x * carried.x[cell] + y * carried.y[cell];
            }
            slipped += x * drift[0] + y * drift[1];
            let gap_before = before.gap.get(cell).copied().unwrap_or_else(|| self.gap_before(cell, 0.0));
            opened += pressure * (gap_before - solved.solution.gap[cell]);
            if let Some(depth) = solved.yielded.get(cell) {
                given_way += pressure * depth;
                yielded += hardness * depth;
            }
        }
        let area = grid.cell_area() * self.copies as f64;
        after.external_work += work * area;
        after.wear_work += before.worn[1] * area;
        after.dissipated_energy += dissipated * area;
        after.plastic_work += yielded * area;
        let unresolved = slipped + opened - dissipated - before.worn[0];
        after.unresolved_energy += (unresolved + given_way - yielded) * area;
    }
}
