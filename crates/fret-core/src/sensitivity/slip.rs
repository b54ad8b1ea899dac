//! The slip of an increment, linearised: what the run adds to the accumulated slip of each cell. The formulas are those of the solver
//! (`solver/state_after.rs`).

use super::change::Tangential;
use super::energies::{Bound, Inputs, Outputs, shares_of_slip};
use super::rule::{Rule, combination, product};
use super::scene::Scene;
use super::solved::{Solved, at};
use crate::fields::Slopes;
use crate::model::CoulombFriction;
use crate::solver::{FrictionLaw, slip_until_open};

/// A cell in contact: its place there, and the shares of its drift and of its offset in its slip.
struct Slips {
    cell: usize,
    place: usize,
    shares: [f64; 2],
}

/// A cell that comes out of contact: its slip by its drift, its shear and its bound before.
struct Opens {
    cell: usize,
    by: [[f64; 5]; 2],
    bound: Bound,
}

/// The slip of an increment.
pub(super) struct Slip {
    slips: Vec<Slips>,
    opens: Vec<Opens>,
}

impl Slip {
    pub fn new(
        scene: &Scene<'_>,
        [now, before]: [&Solved; 2],
        (law, rule): (&CoulombFriction, &Rule),
    ) -> Self {
        let in_contact = now.contact.cells().enumerate().map(|(place, cell)| {
            let zones = [before.zone_of(cell), now.zone_of(cell)];
            Slips { cell, place, shares: shares_of_slip(zones, rule.pace.is_some()) }
        });
        let slips = in_contact.filter(|slips| slips.shares != [0.0; 2]).collect();
        let of_region = FrictionLaw::in_region(law, scene.region);
        let opens = |cell: usize| {
            let (pressure, shear) = (before.tractions[0][cell], before.shear_at(cell));
            if now.tractions[0][cell] > 0.0 || pressure == 0.0 || shear == [0.0; 2] {
                return None;
            }
            let bound = Bound::of((law, &of_region), (scene, cell), pressure);
            let drift = now.drift_since(before, cell);
            let [x, y, shear_x, shear_y, held] =
                Slopes::<5>::of_each([drift[0], drift[1], shear[0], shear[1], bound.value]);
            let by = slip_until_open([x, y], [shear_x, shear_y], held).map(|part| part.by);
            Some(Opens { cell, by, bound })
        };
        Self { slips, opens: (0..scene.region.len()).filter_map(opens).collect() }
    }

    /// Its change in all cells of the region.
    pub fn forward(&self, of: &Inputs<'_>) -> Tangential {
        let Inputs { before, next, paths, friction, .. } = of;
        let drift = |cell: usize| [0, 1].map(|axis| next.slid[axis][cell] - before.slid[axis][cell]);
        let none = || vec![0.0; next.gap.len()];
        let mut slip = [none(), none()];
        for Slips { cell, place, shares } in &self.slips {
            let (drift, ahead) = (drift(*cell), at(&paths.ahead, *place));
            for axis in 0..2 {
                slip[axis][*cell] = shares[0] * drift[axis] + shares[1] * ahead[axis];
            }
        }
        for Opens { cell, by, bound } in &self.opens {
            let ([x, y], [shear_x, shear_y]) = (drift(*cell), at(&before.shear, *cell));
            let by_pressure = bound.by[0] * before.pressure[*cell];
            let [coefficient, strength] = friction.at(*cell);
            let held = by_pressure + bound.by[1] * coefficient + bound.by[2] * strength;
            for (slip, by) in slip.iter_mut().zip(by) {
                slip[*cell] = product(by, &[x, y, shear_x, shear_y, held]);
            }
        }
        slip
    }

    /// Backwards, from that of the slip.
    pub fn transposed(&self, of: &Tangential, to: &mut Outputs<'_>) {
        let Outputs { before, next, paths, friction, .. } = to;
        for Slips { cell, place, shares } in &self.slips {
            for (axis, slip) in at(of, *cell).into_iter().enumerate() {
                next.slid[axis][*cell] += shares[0] * slip;
                before.slid[axis][*cell] -= shares[0] * slip;
                paths.ahead[axis][*place] += shares[1] * slip;
            }
        }
        for Opens { cell, by, bound } in &self.opens {
            let [x, y, shear_x, shear_y, held] = combination(by, &at(of, *cell));
            for (axis, (drift, shear)) in [(x, shear_x), (y, shear_y)].into_iter().enumerate() {
                next.slid[axis][*cell] += drift;
                before.slid[axis][*cell] -= drift;
                before.shear[axis][*cell] += shear;
            }
            before.pressure[*cell] += bound.by[0] * held;
            friction.add(*cell, [bound.by[1] * held, bound.by[2] * held]);
        }
    }
}
