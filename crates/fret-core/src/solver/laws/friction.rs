//! The friction law, whole: the bound on shear, the disc it spans, what a cell does under it, how shear turns with slip, and what
//! slip dissipates. Another law of the same kind (shear bounded by a function of the pressure, opposed to slip) is written here and
//! nowhere else.
//!
//! Coulomb: `|q| <= b(p)`; where `|q| = b` the surfaces may slip, along `q`, the shear on the lower body; elsewhere they stick.
//! `b = min(mu p, tau)` with the shear strength `tau` of the interface, where it has one.

use crate::fields::Reals;
use crate::model::{CellValues, CoulombFriction};

use super::super::contact_set::ContactSet;
use super::super::region::Region;

/// A cell is on its friction circle from this fraction of the radius on: shear is put there by a multiplication.
const ON_CIRCLE: f64 = 1.0 - 1e-10;
/// Fraction of a bound that is rounding.
const ROUNDING: f64 = 1e-10;

/// Parameters of the law in some cells: of a region, or packed over a contact.
#[derive(Debug, Clone, Default)]
pub struct FrictionLaw {
    /// Friction coefficient mu [-].
    coefficient: Vec<f64>,
    /// Shear strength tau of the interface [pressure]; empty where it has none.
    max_shear: Vec<f64>,
}

/// Friction bounds of some cells under their pressures.
#[derive(Debug, Clone, Default)]
pub struct FrictionBound {
    /// `b(p)` [pressure].
    pub bound: Vec<f64>,
    /// Its derivative by the pressure [-].
    pub slope: Vec<f64>,
}

impl FrictionLaw {
    /// The law of `friction` in the cells of a region.
    pub fn in_region(friction: &CoulombFriction, region: Region) -> Self {
        let [_, columns] = region.shape;
        let at = |cell: usize| [region.origin[0] + cell / columns, region.origin[1] + cell % columns];
        let values = |values: &CellValues| -> Vec<f64> {
            (0..region.len()).map(|cell| values.at(at(cell)[0], at(cell)[1])).collect()
        };
        let max_shear = friction.max_shear().map(values).unwrap_or_default();
        Self { coefficient: values(friction.coefficient()), max_shear }
    }

    /// The law in the cells of a contact.
    pub fn packed(&self, contact: &ContactSet) -> Self {
        let max_shear = if self.max_shear.is_empty() { Vec::new() } else { contact.packed(&self.max_shear) };
        Self { coefficient: contact.packed(&self.coefficient), max_shear }
    }

    /// Bound [pressure] and its slope [-] of one cell under a pressure that is not negative.
    pub fn at(&self, cell: usize, pressure: f64) -> (f64, f64) {
        let mu = self.coefficient[cell];
        match self.max_shear.get(cell) {
            Some(&tau) if tau < mu * pressure => (tau, 0.0),
            _ => (mu * pressure, mu),
        }
    }

    /// The bounds under `pressure` [pressure], which is not negative.
    pub fn bound(&self, pressure: &[f64]) -> FrictionBound {
        let mut found = FrictionBound::default();
        self.find_bound(pressure, &mut found);
        found
    }

    /// The same, keeping the memory.
    pub fn find_bound(&self, pressure: &[f64], found: &mut FrictionBound) {
        let FrictionBound { bound, slope } = found;
        bound.clear();
        slope.clear();
        for (cell, pressure) in pressure.iter().enumerate() {
            let (here, its_slope) = self.at(cell, *pressure);
            bound.push(here);
            slope.push(its_slope);
        }
    }
}

/// Energy that friction takes from a cell that slips, per area: the mean of its bounds before and after the increment, along the slip.
pub fn dissipation([before, after]: [f64; 2], slip: [f64; 2]) -> f64 {
    0.5 * (before + after) * slip[0].hypot(slip[1])
}

/// Whether a cell slips, in a solution: the shear that would hold it, `q + slip / K`, lies outside the disc, by more than the shear lies
/// inside, which is what the solution is off. `stiffness` is 1 / K of its own influence [pressure/length].
pub fn slips(shear: [f64; 2], slip: [f64; 2], bound: f64, stiffness: f64) -> bool {
    let trial = [0, 1].map(|axis| shear[axis] + stiffness * slip[axis]);
    let inside = bound - shear[0].hypot(shear[1]);
    bound <= 0.0 || trial[0].hypot(trial[1]) - bound > inside.max(bound * ROUNDING)
}

/// Whether shear lies inside its friction circle, by more than rounding.
pub fn is_inside(shear: [f64; 2], bound: f64) -> bool {
    shear[0].hypot(shear[1]) < bound * ON_CIRCLE
}

/// Nearest point of the friction disc.
#[inline(always)]
pub fn onto_disc<R: Reals>([x, y]: [R; 2], bound: R) -> [R; 2] {
    let length = (x * x + y * y).sqrt();
    let fraction = length.if_at_most(bound, x.all(1.0), bound / length);
    [x * fraction, y * fraction]
}

/// A vector brought to its friction disc, with the convex potential whose gradient that is.
pub struct OnDisc<R> {
    /// The potential: half the squared length inside the disc, going on linearly outside.
    pub potential: R,
    /// The nearest point of the disc.
    pub image: [R; 2],
    /// Its fraction of the vector.
    pub fraction: R,
    /// Direction of a vector outside the disc; zero inside.
    pub along: [R; 2],
}

impl<R: Reals> OnDisc<R> {
    /// Of a vector and a bound.
    #[inline(always)]
    pub fn new([x, y]: [R; 2], bound: R) -> Self {
        let square = x * x + y * y;
        let length = square.sqrt();
        let inverse = x.all(1.0) / length;
        let fraction = length.if_at_most(bound, x.all(1.0), bound * inverse);
        let outside = length.if_at_most(bound, x.all(0.0), inverse);
        Self {
            potential: length.if_at_most(bound, square * 0.5, bound * (length - bound * 0.5)),
            image: [fraction * x, fraction * y],
            fraction,
            along: [x * outside, y * outside],
        }
    }
}

/// What a cell in contact does, for feasible shear and the slip increment that goes with it.
pub struct CellState<R> {
    /// 1 where it sticks: both components of its shear are unknown.
    pub stick: R,
    /// 1 where it slips: its shear is on the circle, grows with the pressure, and can turn. Neither, where there is no bound: what
    /// just enters contact follows the pressure, along its slip.
    pub slip: R,
    /// Direction of the shear of a cell that does not stick.
    pub direction: [R; 2],
    /// Slip stiffness `|slip| / b` [length/pressure]: the tangential displacement across the slip by which a unit of shear across it
    /// is turned.
    pub stiffness: R,
}

impl<R: Reals> CellState<R> {
    /// On the circle and dragged outward: slips. Dragged inward, or inside the disc: sticks. The stiffness of a bound below `least`
    /// grows no more.
    #[inline(always)]
    pub fn new([qx, qy]: [R; 2], [slip_x, slip_y]: [R; 2], bound: R, least: f64) -> Self {
        let (zero, one) = (qx.all(0.0), qx.all(1.0));
        let size = (qx * qx + qy * qy).sqrt();
        let towards = [qx / size, qy / size];
        let outward = slip_x * towards[0] + slip_y * towards[1];
        let on_circle = (bound * ON_CIRCLE).if_at_most(size, one, zero);
        let dragged = outward.if_at_most(zero, zero, on_circle);
        let slip = size.if_at_most(zero, zero, bound.if_at_most(zero, zero, dragged));
        let enters = bound.if_at_most(zero, one, zero);
        let drag = (slip_x * slip_x + slip_y * slip_y).sqrt();
        let entering =
            [drag.if_at_most(zero, one, slip_x / drag), drag.if_at_most(zero, zero, slip_y / drag)];
        let direction =
            |towards: R, entering: R| slip.if_at_most(zero, enters.if_at_most(zero, zero, entering), towards);
        Self {
            stick: one - slip - enters,
            slip,
            direction: [direction(towards[0], entering[0]), direction(towards[1], entering[1])],
            stiffness: slip.if_at_most(zero, zero, outward / bound.max(bound.all(least))),
        }
    }
}
