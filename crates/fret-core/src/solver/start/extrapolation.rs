//! Tractions that an increment starts from: they go on as they did.

use std::mem::discriminant;

use ndarray::Array2;

use super::super::ContactSolver;
use super::super::memory::{Before, GridTractions};
use super::super::pace::{Pace, are_alike, pace_of, products};
use super::self_similar::{SelfSimilarGrowth, sum_of};
use crate::model::{ContactState, Control, LoadStep, Reached};

impl ContactSolver<'_> {
    /// Tractions to start from while the load keeps its direction: those of a contact that goes on growing without changing its
    /// shape, or extrapolated linearly in the load where the normal load stays.
    pub(in super::super) fn extrapolated(&self, state: &ContactState, load: &LoadStep) -> GridTractions {
        let (Some(before), Some(fraction)) = (&self.memory.before, self.continuation(load)) else {
            return GridTractions::of(state);
        };
        if let Some(grown) = self.grown(state, before, load) {
            return grown;
        }
        let then = &before.tractions;
        let extrapolate = |now: &Array2<f64>, then: &Array2<f64>| now + &((now - then) * fraction);
        GridTractions {
            pressure: extrapolate(&state.pressure, &then.pressure).mapv(|p| p.max(0.0)),
            shear: [0, 1].map(|axis| extrapolate(&state.shear[axis], &then.shear[axis])),
        }
    }

    /// Tractions of a contact whose area and force go on growing by the powers of the load by which they grew last, everything
    /// else alike; `None` where the normal load stays, or nothing is known of such powers.
    fn grown(&self, state: &ContactState, before: &Before, load: &LoadStep) -> Option<GridTractions> {
        let last_solved = self.memory.last.as_ref()?;
        let last = self.memory.last_load.as_ref()?;
        let loads = [before.load.normal, last.normal, load.normal].map(Control::value);
        if loads[1] == loads[2] || loads.iter().any(|load| *load <= 0.0) {
            return None;
        }
        let forces = [sum_of(&before.tractions.pressure), sum_of(&state.pressure)];
        let areas = [before.contact_area, last_solved.contact_area];
        let way = (loads[2] / loads[1]).ln() / (loads[1] / loads[0]).ln();
        let [area, force] = [areas, forces].map(|[then, now]| (now / then).powf(way));
        (area < 4.0).then(|| self.grown_by(area, force, state)).flatten()
    }

    /// Tractions of a contact that grows or shrinks for the first time, to the area and force of a `pressure` from coarser grids without
    /// shear; `None` before there is a contact.
    pub(in super::super) fn grown_to(
        &self,
        pressure: &Array2<f64>,
        state: &ContactState,
    ) -> Option<GridTractions> {
        let cells = |field: &Array2<f64>| field.iter().filter(|p| **p > 0.0).count() as f64;
        let area = cells(pressure) / cells(&state.pressure);
        self.grown_by(area, sum_of(pressure) / sum_of(&state.pressure), state)
    }

    /// Tractions of a contact whose area and force have grown by these factors; `None` where one of them says nothing, and in a period, where islands
    /// of contact grow each about its own middle.
    fn grown_by(&self, area: f64, force: f64, state: &ContactState) -> Option<GridTractions> {
        let last_solved = self.memory.last.as_ref()?;
        let growth = SelfSimilarGrowth {
            widening: area.sqrt(),
            strengthening: force / area,
            mirrored: self.symmetry.axes(),
        };
        let is_one = !self.response.is_periodic();
        let grows = is_one && area.is_finite() && force.is_finite() && area > 0.0 && force > 0.0;
        grows.then(|| growth.of(state, &last_solved.gap))
    }

    /// Ratio of this load increment to the last one when it goes on in the same direction.
    pub(super) fn continuation(&self, load: &LoadStep) -> Option<f64> {
        let [old, both, new] = self.increments_to(load)?;
        (both > 0.5 * (old * new).sqrt()).then(|| (both / old).min(3.0))
    }

    /// Length of this load increment over that of the last one, see [`pace_of`].
    pub(in super::super) fn pace(&self, load: &LoadStep) -> Option<Pace> {
        let (before, last) = (&self.memory.before.as_ref()?.load, self.memory.last_load.as_ref()?);
        pace_of([before.change_to(last)?, last.change_to(load)?], load)
    }

    /// Whether nothing changes in the increment to `load`.
    pub(in super::super) fn pauses(&self, load: &LoadStep) -> bool {
        self.memory.last.is_some() && self.memory.last_load.as_ref() == Some(load)
    }

    /// Takes the last load for what the controls of `load` would have prescribed to reach the same state: a stage that prescribes another
    /// kind of control than the one before goes on from its end.
    pub(in super::super) fn take_last_load_as(&mut self, load: &LoadStep, state: &ContactState) {
        let Some(last) = &mut self.memory.last_load else { return };
        let area = self.grid.cell_area();
        let rig = self.rig.of_part(self.symmetry.copies());
        let like = |last: &mut Control, wanted: Control, (sum, motion, spring): (&Array2<f64>, f64, f64)| {
            if discriminant(last) != discriminant(&wanted) {
                let force = area * sum_of(sum);
                *last = Reached { force, motion, far_end: motion + spring * force }.like(wanted);
            }
        };
        like(&mut last.normal, load.normal, (&state.pressure, state.approach, rig.normal));
        for axis in [0, 1] {
            let reached = (&state.shear[axis], state.shift[axis], rig.tangential[axis]);
            like(&mut last.tangential[axis], load.tangential[axis], reached);
        }
    }

    /// The last load increment and the one to `load`, see [`products`].
    fn increments_to(&self, load: &LoadStep) -> Option<[f64; 3]> {
        let (before, last) = (&self.memory.before.as_ref()?.load, self.memory.last_load.as_ref()?);
        Some(products(before.change_to(last)?, last.change_to(load)?, are_alike(load)))
    }
}
