//! The tangential displacement before an increment, from which slip is counted, and its change in an increment: the drift of the upper
//! surface over the lower.

use std::borrow::Cow;

use ndarray::Array2;

use super::contact_set::ContactSet;
use super::increment_problem::{IncrementProblem, Solved};
use super::memory::{Before, Drift};
use super::operators::RegionOperators;
use super::settings::Coupling;
use super::stretch::Stretch;
use super::tractions::Displacements;
use crate::compliance::SurfaceCompliance;
use crate::fields::add_scaled;
use crate::model::{TangentialField, Zone};

impl IncrementProblem<'_> {
    /// Tangential displacement of the state before [length], less that by the bulk stresses: slip counts its increment alone; with what
    /// moving surfaces bring along. `last`: the
    /// displacements of the state before, when they are known.
    pub fn displacement_before<'b>(
        &self,
        last: Option<&'b Displacements>,
        operators: &mut RegionOperators,
    ) -> Cow<'b, TangentialField> {
        let before = last.map_or_else(
            || Cow::Owned(self.displacements_of_state(operators, false).tangential),
            |last| Cow::Borrowed(&last.tangential),
        );
        if self.stretch.is_none() && self.carried.is_none() {
            return before;
        }
        let mut before = before.into_owned();
        if let Some(carried) = &self.carried {
            before.add_scaled(1.0, carried);
        }
        if self.stretch.is_none() {
            return Cow::Owned(before);
        }
        for cell in 0..self.region.len() {
            let [x, y] = self.stretch.at(self.grid, self.region.at(cell));
            before.x[cell] -= x;
            before.y[cell] -= y;
        }
        Cow::Owned(before)
    }

    /// Displacements of the tractions of the state before [length]; uncoupled ones along the normal where these are `wanted`.
    pub fn displacements_of_state(&self, operators: &mut RegionOperators, wanted: bool) -> Displacements {
        let pressure = self.region.gather(&self.state.pressure);
        let TangentialField { x, y } = self.region.gather_tangential(&self.state.shear);
        let mut moved = Displacements::zeros(self.region.len());
        if wanted && self.coupling != Coupling::Coupled {
            operators.compliance.normal(&pressure, &mut moved.normal);
        }
        self.displace([&pressure, &x, &y], operators, &mut moved);
        moved
    }

    /// Displacements of tractions, along the surface alone where the two are uncoupled [length].
    fn displace(
        &self,
        tractions: [&[f64]; 3],
        operators: &mut RegionOperators,
        displacements: &mut Displacements,
    ) {
        let [_, x, y] = tractions;
        let is_any = |field: &[f64]| field.iter().any(|traction| *traction != 0.0);
        if self.coupling == Coupling::Coupled {
            if tractions.into_iter().any(is_any) {
                operators.compliance.full(tractions, displacements.parts_mut());
            }
        } else if is_any(x) || is_any(y) {
            operators.compliance.tangential([x, y], displacements.tangential.parts_mut());
        }
    }

    /// Displacement from which the law counts slip.
    pub fn counted_from<'b>(&self, before: &'b TangentialField) -> Cow<'b, TangentialField> {
        if !self.path.turns() {
            return Cow::Borrowed(before);
        }
        let mut from = before.clone();
        from.add_scaled(-1.0, &self.path.ahead);
        Cow::Owned(from)
    }

    /// The bodies parted: with how far each cell drifts to there. `last` as above.
    pub fn parted(
        &self,
        apart: Solved,
        last: Option<&Displacements>,
        operators: &mut RegionOperators,
    ) -> Solved {
        if self.coupling == Coupling::Frictionless {
            return apart;
        }
        let before = self.displacement_before(last, operators);
        let drift = self.drift(&before, &apart.displacements.tangential, apart.solution.tangential.motion);
        Solved { drift, ..apart }
    }

    /// Makes the drift of cells that have come into contact what it would be in a whole increment at their rate from the moment of touch on.
    pub fn take_rate_since_touch(&self, solved: &mut Solved) {
        if self.coupling == Coupling::Frictionless {
            return;
        }
        for cell in 0..self.region.len() {
            let was_open = self.state.zone[self.region.at(cell)] == Zone::Open;
            if was_open && solved.tractions.pressure[cell] > 0.0 {
                solved.drift.set(cell, self.path.since_touch(cell, solved.drift.at(cell)));
            }
        }
    }

    /// Change of the tangential displacement of the upper body over the lower in every cell of the region.
    pub fn drift(
        &self,
        before: &TangentialField,
        after: &TangentialField,
        motion: [f64; 3],
    ) -> TangentialField {
        let all = ContactSet::of(self.region.len(), |_| true);
        let motions = self.positions.motions_of(&all, self.tangential);
        let mut drift = before.clone();
        drift.add_scaled(-1.0, after);
        for cell in 0..self.region.len() {
            let (moved, here) = (motions.at(motion, cell), drift.at(cell));
            drift.set(cell, [here[0] + moved[0], here[1] + moved[1]]);
        }
        drift
    }

    /// The drift of the last increment in every cell of the region.
    pub fn drift_to_here(
        &self,
        before: &Before,
        drift: &Drift,
        operators: &mut RegionOperators,
    ) -> TangentialField {
        let Self { region, grid, state, .. } = self;
        let change = |now: &Array2<f64>, then: &Array2<f64>| {
            let mut change = region.gather(now);
            add_scaled(&mut change, -1.0, &region.gather(then));
            change
        };
        let pressure = change(&state.pressure, &before.tractions.pressure);
        let [x, y] = [0, 1].map(|axis| change(&state.shear[axis], &before.tractions.shear[axis]));
        let mut moved = Displacements::zeros(region.len());
        self.displace([&pressure, &x, &y], operators, &mut moved);
        let [shift_x, shift_y, twist] = drift.motion;
        let mut found = moved.tangential;
        for cell in 0..region.len() {
            let [i, j] = region.at(cell);
            let u = found.at(cell);
            let turned = [-twist * grid.centre(1, j), twist * grid.centre(0, i)];
            let [x, y] = Stretch { strain: drift.strain, ..self.stretch }.at(grid, [i, j]);
            found.set(cell, [shift_x + turned[0] - u[0] - x, shift_y + turned[1] - u[1] - y]);
        }
        found
    }
}
