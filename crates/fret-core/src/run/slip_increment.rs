//! What slips between two states that follow each other: its length, the energy that friction dissipates, and what it wears off.

use ndarray::{Array2, Zip};

use crate::model::{AccumulatedSlip, ContactState, CoulombFriction, Integration, WearLaw, WearRule, Zone};
use crate::solver::{dissipation, friction_bounds, length_of_way};

/// What lies between two states that follow each other.
#[derive(Debug, Clone, Copy)]
pub struct SlipIncrement<'a> {
    /// Before and after.
    pub states: [&'a ContactState; 2],
    /// The friction law that lay over the grid in each of them.
    pub laws: [&'a CoulombFriction; 2],
    /// How slip is integrated.
    pub integration: Integration,
    /// Whether the contact travels over both surfaces. All of the increment then counts as slip in cells that the contact comes to and in those that
    /// it leaves behind.
    pub travels: bool,
}

impl SlipIncrement<'_> {
    /// Length of the slip path in every cell [length].
    pub fn path(&self) -> Array2<f64> {
        let [before, after] = self.states;
        Array2::from_shape_fn(after.zone.dim(), |at| {
            let slip = [0, 1].map(|axis| after.slip[axis][at] - before.slip[axis][at]);
            if slip == [0.0; 2] {
                return 0.0;
            }
            let shear = self.states.map(|state| [0, 1].map(|axis| state.shear[axis][at]));
            length_of_way(self.integration, slip, self.states.map(|state| state.zone[at]), shear)
        })
    }

    /// Adds what slips: the mean of the bounds at both ends along the path, and its length. The half of it at an end where a travelling contact is
    /// not is no slip: the bound there is zero, and so is its length.
    pub fn add_slip(&self, to: &mut AccumulatedSlip) {
        self.add_dissipation(1.0, &mut to.energy_density);
        if self.travels {
            for part in self.slip_by_ends() {
                to.distance += &part.distance;
            }
        } else {
            to.distance += &self.path();
        }
    }

    /// What [`SlipIncrement::add_slip`] adds, by what each of both states has a part in: the pressure there, and half of the way.
    pub fn slip_by_ends(&self) -> [AccumulatedSlip; 2] {
        let half = self.path() * 0.5;
        [0, 1].map(|end| {
            let state = self.states[end];
            let bounds = friction_bounds(self.laws[end], &state.pressure);
            let mut distance = half.clone();
            if self.travels {
                Zip::from(&mut distance).and(&state.zone).for_each(|distance, zone| {
                    if *zone == Zone::Open {
                        *distance = 0.0;
                    }
                });
            }
            AccumulatedSlip { energy_density: bounds * &half, distance, cycles: 0 }
        })
    }

    /// Adds `factor` times the energy that friction dissipates by area [pressure x length]: the mean of the bounds at both ends along the way.
    fn add_dissipation(&self, factor: f64, energy: &mut Array2<f64>) {
        let [first, last] = [0, 1].map(|end| friction_bounds(self.laws[end], &self.states[end].pressure));
        Zip::from(energy).and(&first).and(&last).and(&self.path()).for_each(|energy, first, last, way| {
            *energy += factor * dissipation([*first, *last], *way);
        });
    }

    /// What [`SlipIncrement::add_wear`] adds, by what each of both states has a part in: the pressure before, and after.
    pub fn wear_by_ends(&self, rule: &WearRule) -> [Array2<f64>; 2] {
        let k = rule.coefficient.unwrap_or(1.0);
        let path = self.path();
        [0, 1].map(|end| {
            let mut worn = match rule.law {
                WearLaw::Energy => friction_bounds(self.laws[end], &self.states[end].pressure),
                WearLaw::Archard => self.states[end].pressure.clone(),
            };
            Zip::from(&mut worn).and(&path).for_each(|worn, way| *worn *= 0.5 * k * way);
            worn
        })
    }

    /// Adds the depth [length] worn off; where each layer has a coefficient of its own, the work by area [pressure x length] that they wear by.
    /// Cells that stick at both ends have no slip.
    pub fn add_wear(&self, rule: &WearRule, depth: &mut Array2<f64>) {
        let k = rule.coefficient.unwrap_or(1.0);
        match rule.law {
            WearLaw::Energy => self.add_dissipation(k, depth),
            WearLaw::Archard => {
                let [first, last] = self.states.map(|state| &state.pressure);
                Zip::from(depth).and(first).and(last).and(&self.path()).for_each(
                    |depth, first, last, way| {
                        *depth += k * dissipation([*first, *last], *way);
                    },
                );
            }
        }
    }
}
