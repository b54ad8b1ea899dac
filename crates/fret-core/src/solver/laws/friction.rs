//! The friction law, whole: the bound on shear, the disc it spans, what a cell does under it, how shear turns with slip, and what
//! slip dissipates. Another law of the same kind (shear bounded by a function of the pressure, opposed to slip) is written here; what
//! outside of the solver assumes a bound of at most `mu p` stands in `docs/developers/extend.md`.
//!
//! Coulomb: `|q| <= b(p)`; where `|q| = b` the surfaces may slip, along `q`, the shear on the lower body; elsewhere they stick.
//! `b = min(mu p, tau)` with the shear strength `tau` of the interface, where it has one.

use std::ops::Range;

use ndarray::Array2;

use crate::fields::{CellRule, Reals, Scalar, each_cell, length, length_of, reset};
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
    /// Friction coefficient mu [-] where it is the same everywhere and nothing else bounds shear.
    uniform: Option<f64>,
    /// Else that of every cell.
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
        if let (CellValues::Uniform(coefficient), None) = (friction.coefficient(), friction.max_shear()) {
            return Self { uniform: Some(*coefficient), ..Self::default() };
        }
        let values = |values: &CellValues| -> Vec<f64> {
            (0..region.len()).map(|cell| region.at(cell)).map(|[i, j]| values.at(i, j)).collect()
        };
        let max_shear = friction.max_shear().map(values).unwrap_or_default();
        Self { uniform: None, coefficient: values(friction.coefficient()), max_shear }
    }

    /// Whether shear is bounded by one coefficient everywhere, and by nothing else: then a normal force tells what is carried.
    pub fn is_uniform(&self) -> bool {
        self.uniform.is_some()
    }

    /// Whether the interface has a shear strength.
    pub fn has_strength(&self) -> bool {
        !self.max_shear.is_empty()
    }

    /// The law in the cells of a contact.
    pub fn packed(&self, contact: &ContactSet) -> Self {
        self.map(|of_cells| contact.packed(of_cells))
    }

    /// The law with every field of the cells made another one.
    pub fn map(&self, field: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let mapped = |of_cells: &[f64]| if of_cells.is_empty() { Vec::new() } else { field(of_cells) };
        Self {
            uniform: self.uniform,
            coefficient: mapped(&self.coefficient),
            max_shear: mapped(&self.max_shear),
        }
    }

    /// Bound [pressure] and its slope [-] of one cell under a pressure that is not negative.
    pub fn at(&self, cell: usize, pressure: f64) -> (f64, f64) {
        let (mut bound, mut slope) = ([0.0], [0.0]);
        self.bounds_in(cell..cell + 1, &[pressure], [&mut bound, &mut slope]);
        (bound[0], slope[0])
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
        reset(bound, pressure.len());
        reset(slope, pressure.len());
        self.bounds_in(0..pressure.len(), pressure, [bound, slope]);
    }

    /// Bounds and their slopes in a range of cells.
    fn bounds_in(&self, cells: Range<usize>, pressure: &[f64], to: [&mut [f64]; 2]) {
        let Self { uniform, coefficient, max_shear } = self;
        if let Some(coefficient) = *uniform {
            each_cell(&UniformCoulomb { coefficient }, [pressure], to);
        } else if max_shear.is_empty() {
            each_cell(&Coulomb, [pressure, &coefficient[cells]], to);
        } else {
            each_cell(&CoulombToStrength, [pressure, &coefficient[cells.clone()], &max_shear[cells]], to);
        }
    }
}

/// Bounds of all cells of a grid under their pressures [pressure].
pub fn bounds_on_grid(friction: &CoulombFriction, pressure: &Array2<f64>) -> Array2<f64> {
    let whole = Region::whole(pressure.dim().into());
    let FrictionBound { bound, .. } = FrictionLaw::in_region(friction, whole).bound(&whole.gather(pressure));
    let mut field = Array2::zeros(pressure.dim());
    whole.place(&bound, &mut field);
    field
}

/// The bound `mu p` with one mu for all cells.
struct UniformCoulomb {
    coefficient: f64,
}

impl CellRule<1, 2, 0> for UniformCoulomb {
    #[inline(always)]
    fn at<R: Reals>(&self, [pressure]: [R; 1], [bound, slope]: &mut [R; 2]) -> [R; 0] {
        *slope = pressure.all(self.coefficient);
        *bound = *slope * pressure;
        []
    }
}

/// The bound `mu p`.
struct Coulomb;

impl CellRule<2, 2, 0> for Coulomb {
    #[inline(always)]
    fn at<R: Reals>(&self, [pressure, coefficient]: [R; 2], [bound, slope]: &mut [R; 2]) -> [R; 0] {
        *bound = coefficient * pressure;
        *slope = coefficient;
        []
    }
}

/// The bound `min(mu p, tau)`.
struct CoulombToStrength;

impl CellRule<3, 2, 0> for CoulombToStrength {
    #[inline(always)]
    fn at<R: Reals>(&self, [pressure, coefficient, strength]: [R; 3], [bound, slope]: &mut [R; 2]) -> [R; 0] {
        let coulomb = coefficient * pressure;
        *bound = coulomb.if_at_most(strength, coulomb, strength);
        *slope = coulomb.if_at_most(strength, coefficient, pressure.all(0.0));
        []
    }
}

/// Energy that friction takes from a cell that slips, per area: the mean of its bounds before and after the increment, along its way.
pub fn dissipation<R: Reals>([before, after]: [R; 2], way: R) -> R {
    (before + after) * 0.5 * way
}

/// Slip of a cell until it comes out of contact [length], from its drift [length] in that increment, and its shear and its bound before.
///
/// Its pressure falls to zero, evenly say, until a moment that may be any of the increment: on average half of the drift is slip. It is
/// along the shear that it had, and where that was below the bound, less in proportion: pressure has to fall first. None where it moves
/// the other way.
pub fn slip_until_open<R: Scalar>(drift: [R; 2], shear: [R; 2], bound: R) -> [R; 2] {
    let along = drift[0] * shear[0] + drift[1] * shear[1];
    let size = length_of(shear) * bound;
    let slides = size.value() > 0.0 && along.value() > 0.0;
    if slides { shear.map(|part| along * 0.5 / size * part) } else { [R::of(0.0); 2] }
}

/// Whether a cell slips, in a solution: the shear that would hold it, `q + slip / K`, lies outside the disc, by more than the shear lies
/// inside, which is what the solution is off. `stiffness` is 1 / K of its own influence [pressure/length].
pub fn slips(shear: [f64; 2], slip: [f64; 2], bound: f64, stiffness: f64) -> bool {
    let trial = [0, 1].map(|axis| shear[axis] + stiffness * slip[axis]);
    let inside = bound - length(shear);
    bound <= 0.0 || length(trial) - bound > inside.max(bound * ROUNDING)
}

/// Whether shear lies inside its friction circle, by more than rounding.
pub fn is_inside(shear: [f64; 2], bound: f64) -> bool {
    length(shear) < bound * ON_CIRCLE
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
    /// 1 where it slips: its shear is on the circle, grows with the pressure, and can turn. Neither, where there is no bound, or where it
    /// [barely touches](Limits::barely): what just enters contact follows the pressure, along its slip.
    pub slip: R,
    /// Direction of the shear of a cell that does not stick.
    pub direction: [R; 2],
    /// Slip compliance `|slip| / b` [length/pressure]: the tangential displacement across the slip by which a unit of shear across it
    /// is turned.
    pub slip_compliance: R,
}

/// Limits of what a cell does, of a whole contact.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// The slip compliance of a bound below this grows no more [pressure].
    pub least: f64,
    /// A cell whose bound is below this barely touches: it does not stick as long as the shear that would hold it, `q + slip / K`, lies outside
    /// its disc. The linearised problem knows no bound of cells that stick, and one at the edge would have to hold what all around it lets
    /// slip. 0: no such cells [pressure].
    pub barely: f64,
    /// 1 / K of a cell [pressure/length].
    pub stiffness: f64,
}

impl<R: Reals> CellState<R> {
    /// On the circle and dragged outward: slips. Dragged inward, or inside the disc: sticks, unless it barely touches.
    #[inline(always)]
    pub fn new([qx, qy]: [R; 2], [slip_x, slip_y]: [R; 2], bound: R, limits: &Limits) -> Self {
        let (zero, one) = (qx.all(0.0), qx.all(1.0));
        let size = (qx * qx + qy * qy).sqrt();
        let towards = [qx / size, qy / size];
        let outward = slip_x * towards[0] + slip_y * towards[1];
        let on_circle = (bound * ON_CIRCLE).if_at_most(size, one, zero);
        let dragged = outward.if_at_most(zero, zero, on_circle);
        let slip = size.if_at_most(zero, zero, bound.if_at_most(zero, zero, dragged));
        let trial = [qx + slip_x * limits.stiffness, qy + slip_y * limits.stiffness];
        let holding = (trial[0] * trial[0] + trial[1] * trial[1]).sqrt();
        let cannot_stick =
            bound.if_at_most(bound.all(limits.barely), holding.if_at_most(bound, zero, one - slip), zero);
        let enters = bound.if_at_most(zero, one, cannot_stick);
        let drag = (slip_x * slip_x + slip_y * slip_y).sqrt();
        let entering =
            [drag.if_at_most(zero, one, slip_x / drag), drag.if_at_most(zero, zero, slip_y / drag)];
        let direction =
            |towards: R, entering: R| slip.if_at_most(zero, enters.if_at_most(zero, zero, entering), towards);
        Self {
            stick: one - slip - enters,
            slip,
            direction: [direction(towards[0], entering[0]), direction(towards[1], entering[1])],
            slip_compliance: slip.if_at_most(zero, zero, outward / bound.max(bound.all(limits.least))),
        }
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::*;

    /// Pressure that falls evenly to zero until a moment t, slip that goes on evenly: a quarter of the bound times the motion in the mean over
    /// all t, whatever its direction across the shear; of shear below the bound its work alike.
    #[test]
    fn a_cell_that_leaves_slips_half_its_way() {
        let moments = (0..1000).map(|k| (f64::from(k) + 0.5) / 1e3);
        let mean = moments.map(|end| 0.5 * 3.0 * 0.2 * end).sum::<f64>() / 1e3;
        let slip = slip_until_open([0.2, 0.0], [3.0, 0.0], 3.0);
        assert!((dissipation([3.0, 0.0], length(slip)) - mean).abs() < 1e-12 && slip[1] == 0.0);
        let below = slip_until_open([0.12, 0.16], [1.2, 0.0], 3.0);
        assert!((dissipation([3.0, 0.0], length(below)) - 0.25 * 0.12 * 1.2).abs() < 1e-15);
        for (drift, shear, bound) in
            [([-0.2, 0.0], [3.0, 0.0], 3.0), ([0.2, 0.0], [0.0; 2], 3.0), ([0.2, 0.0], [0.0; 2], 0.0)]
        {
            assert_eq!(slip_until_open(drift, shear, bound), [0.0; 2]);
        }
    }

    /// A map whose numbers say where they stand, and a uniform shear strength: in a region they are those of its cells, row by row, and
    /// packed those of the contact.
    #[test]
    fn a_region_has_the_numbers_of_its_own_cells() {
        let map = Array2::from_shape_fn((5, 7), |(i, j)| (10 * i + j) as f64);
        let friction = CoulombFriction::map(map).unwrap().with_max_shear(CellValues::Uniform(30.0)).unwrap();
        let law = FrictionLaw::in_region(&friction, Region { origin: [1, 2], shape: [2, 3] });
        assert_eq!(law.coefficient, [12.0, 13.0, 14.0, 22.0, 23.0, 24.0]);
        assert_eq!(law.max_shear, [30.0; 6]);
        let packed = law.packed(&ContactSet::of(6, |cell| cell % 2 == 1));
        assert_eq!((packed.coefficient, packed.max_shear.len()), (vec![13.0, 22.0, 24.0], 3));
    }

    /// `min(mu p, tau)`, its slope mu below the strength and 0 above it; without a strength `mu p` throughout.
    #[test]
    fn the_bound_follows_the_pressure_up_to_the_shear_strength() {
        let coulomb = FrictionLaw { coefficient: vec![0.5; 3], ..FrictionLaw::default() };
        let uniform = FrictionLaw { uniform: Some(0.5), ..FrictionLaw::default() };
        for law in [&coulomb, &uniform] {
            let FrictionBound { bound, slope } = law.bound(&[0.0, 2.0, 100.0]);
            assert_eq!((bound, slope), (vec![0.0, 1.0, 50.0], vec![0.5; 3]));
            assert_eq!(law.at(2, 4.0), (2.0, 0.5));
        }
        let capped = FrictionLaw { max_shear: vec![3.0, 3.0, 0.0], ..coulomb };
        let mut found = FrictionBound { bound: vec![9.0; 5], slope: vec![9.0] };
        capped.find_bound(&[4.0, 8.0, 8.0], &mut found);
        assert_eq!((found.bound, found.slope), (vec![2.0, 3.0, 0.0], vec![0.5, 0.0, 0.0]));
    }

    /// With shear q = (3, 0) under a bound of 3 and a stiffness of 2: slip outward slips, slip inward and no slip stick; inside the
    /// disc only what pulls out of it by more than the shear lies inside.
    #[test]
    fn a_cell_slips_where_the_shear_that_would_hold_it_lies_outside() {
        assert!(slips([3.0, 0.0], [0.1, 0.0], 3.0, 2.0));
        assert!(!slips([3.0, 0.0], [-0.1, 0.0], 3.0, 2.0));
        assert!(!slips([3.0, 0.0], [0.0, 0.0], 3.0, 2.0));
        assert!(!slips([2.0, 0.0], [0.9, 0.0], 3.0, 2.0) && slips([2.0, 0.0], [1.1, 0.0], 3.0, 2.0));
        assert!(slips([0.0; 2], [0.0; 2], 0.0, 2.0), "nothing holds a cell without a bound");
        assert!(is_inside([2.9, 0.0], 3.0) && !is_inside([0.0, 3.0], 3.0) && !is_inside([3.0, 3.0], 3.0));
    }

    /// Work of a mean of two bounds along the way.
    #[test]
    fn what_slip_dissipates_is_the_mean_bound_times_its_length() {
        assert_eq!(dissipation([1.0, 3.0], 0.5), 1.0);
    }

    struct Images;

    impl CellRule<3, 6, 0> for Images {
        fn at<R: Reals>(&self, [x, y, bound]: [R; 3], write: &mut [R; 6]) -> [R; 0] {
            let on = OnDisc::new([x, y], bound);
            let image = onto_disc([x, y], bound);
            *write = [
                image[0] - on.image[0],
                image[1] - on.image[1],
                on.image[0],
                on.image[1],
                on.fraction,
                on.potential,
            ];
            []
        }
    }

    /// Inside the disc a vector stays; outside it is shortened to the bound. The potential is `|v|^2 / 2` inside and goes on with
    /// the slope of the bound: its difference quotient is the image.
    #[test]
    fn vectors_go_to_the_nearest_point_of_their_disc_the_gradient_of_a_potential() {
        let at = |x: f64, y: f64| -> [f64; 6] {
            let mut out = [[9.0]; 6];
            each_cell(&Images, [&[x], &[y], &[2.0]], out.each_mut().map(|field| &mut field[..]));
            out.map(|[value]| value)
        };
        assert_eq!(at(0.6, 0.8), [0.0, 0.0, 0.6, 0.8, 1.0, 0.5 * (0.6 * 0.6 + 0.8 * 0.8)]);
        let outside = at(3.0, 4.0);
        for (found, expected) in outside.iter().zip([0.0, 0.0, 1.2, 1.6, 0.4, 2.0 * (5.0 - 1.0)]) {
            assert!((found - expected).abs() < 1e-15, "{outside:?}");
        }
        for [x, y] in [[0.5, -0.2], [3.0, 4.0], [-1.9, 0.9]] {
            let step = 1e-6;
            let along_x = (at(x + step, y)[5] - at(x - step, y)[5]) / (2.0 * step);
            let along_y = (at(x, y + step)[5] - at(x, y - step)[5]) / (2.0 * step);
            let [.., image_x, image_y, _, _] = at(x, y);
            // Rounding over the step.
            assert!((along_x - image_x).abs() < 1e-9 && (along_y - image_y).abs() < 1e-9, "{x} {y}");
        }
    }
}
