//! One layer of a stack with the springs below it, and the step through both. No stacks, no bodies.

use super::complex::Wavenumber;
use super::compliance_below::{Compliance, Descent};
use super::layer::{Carry, LayerMatrices, OPAQUE};
use super::layer_constants::LayerConstants;
use super::matrix::Symmetric;
use crate::fields::{Dual, Scalar};
use crate::model::{Base, Coating, ElasticMaterial, HalfSpace, Interface};

/// A frictionless interface is a shear spring with a compliance of so many times the layer's thickness over its shear modulus: exact to
/// the last bit for `k h` down to 1e-20 and more, since every number made of it is a sum or a ratio of positive terms.
const FREE: f64 = (1_u128 << 127) as f64;

/// Springs between a layer and what lies below it: jump of displacement per traction [length/pressure].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Springs<C = f64> {
    normal: C,
    shear: C,
}

impl Springs {
    fn of(interface: &Interface, free: f64) -> Self {
        Self {
            normal: interface.normal_compliance().min(free),
            shear: interface.shear_compliance().min(free),
        }
    }
}

impl<C: Scalar> Springs<C> {
    /// Bonded.
    fn none() -> Self {
        Self { normal: C::of(0.0), shear: C::of(0.0) }
    }

    fn are_none(self) -> bool {
        self.normal.value() == 0.0 && self.shear.value() == 0.0
    }

    /// Compliance above the springs, times k, from the one below: each spring adds its own, `k` times jump per traction.
    fn over<T: Wavenumber<Constant = C>>(self, k: T, below: Compliance<T>) -> Compliance<T> {
        if self.are_none() {
            return below;
        }
        let (normal, shear) = (k * self.normal, k * self.shear);
        let Symmetric { rr, zz, rz } = below.in_plane;
        Compliance {
            in_plane: Symmetric { rr: rr + shear, zz: zz + normal, rz },
            determinant: below.determinant + rr * normal + zz * shear + normal * shear,
            tt: below.tt + shear,
        }
    }
}

/// A layer and the springs below it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StackLayer<C = f64> {
    pub(super) constants: LayerConstants<C>,
    pub(super) thickness: C,
    springs: Springs<C>,
}

impl StackLayer {
    /// That of a coating.
    pub(crate) fn of(coating: &Coating) -> Self {
        let constants = LayerConstants::new(coating.material());
        let thickness = coating.thickness();
        let free = FREE * (thickness / constants.shear_modulus());
        Self { constants, thickness, springs: Springs::of(coating.interface(), free) }
    }

    /// The same with the derivatives of its constants by a parameter: of Young's modulus, Poisson's ratio, thickness, and the compliances of
    /// its springs; `material`: that of the layer.
    pub(crate) fn with_changes(self, material: &ElasticMaterial, changes: &LayerChanges) -> StackLayer<Dual> {
        let LayerChanges { young, poisson, thickness, normal, shear } = *changes;
        StackLayer {
            constants: LayerConstants::with_changes(material, [young, poisson]),
            thickness: Dual::new(self.thickness, thickness),
            springs: Springs {
                normal: Dual::new(self.springs.normal, normal),
                shear: Dual::new(self.springs.shear, shear),
            },
        }
    }
}

/// Derivatives of the constants of a layer by a parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LayerChanges {
    /// Of Young's modulus.
    pub young: f64,
    /// Of Poisson's ratio.
    pub poisson: f64,
    /// Of the thickness.
    pub thickness: f64,
    /// Of the jump of normal displacement per pressure at the interface below it.
    pub normal: f64,
    /// Of the jump of tangential displacement per shear there.
    pub shear: f64,
}

/// The layers of a half-space and its base, with the derivatives of their constants by a parameter, from the surface down, those of the base
/// last (Young's modulus, Poisson's ratio).
pub(super) fn layers_with_changes(
    half_space: &HalfSpace,
    changes: &[LayerChanges],
) -> (Vec<StackLayer<Dual>>, Option<LayerConstants<Dual>>) {
    let none = LayerChanges::default();
    let of = |index: usize| changes.get(index).unwrap_or(&none);
    let coatings = half_space.coatings();
    let layer = |(index, coating): (usize, &Coating)| {
        StackLayer::of(coating).with_changes(coating.material(), of(index))
    };
    let LayerChanges { young, poisson, .. } = *of(coatings.len());
    let base = match half_space.base() {
        Base::Elastic(material) => Some(LayerConstants::with_changes(material, [young, poisson])),
        Base::Rigid => None,
    };
    (coatings.iter().enumerate().map(layer).collect(), base)
}

impl LayerConstants<Dual> {
    /// Constants of a material with their derivatives by a parameter, of which those of Young's modulus and Poisson's ratio are given.
    pub(crate) fn with_changes(material: &ElasticMaterial, [young, poisson]: [f64; 2]) -> Self {
        Self::of(Dual::new(material.young(), young), Dual::new(material.poisson(), poisson))
    }
}

impl<C: Scalar> StackLayer<C> {
    /// A bonded layer.
    pub(crate) fn bonded(constants: LayerConstants<C>, thickness: C) -> Self {
        Self { constants, thickness, springs: Springs::none() }
    }

    /// The part of the layer above a cut, and the part below it with the springs.
    pub(crate) fn cut(self, within: C) -> [Self; 2] {
        let below = Self { thickness: (self.thickness - within).max(C::of(0.0)), ..self };
        [Self::bonded(self.constants, within), below]
    }

    /// Whether there is nothing of it, springs included.
    pub(crate) fn is_empty(&self) -> bool {
        self.thickness.value() == 0.0 && self.springs.are_none()
    }

    /// Whether a wave so short is not felt through the layer, to the last bit.
    pub(crate) fn is_opaque<T: Wavenumber<Constant = C>>(&self, k: T) -> bool {
        (k * self.thickness).real_part() > OPAQUE
    }

    /// Compliance at the top of the layer from the one of what lies below its springs.
    pub(crate) fn lift<T: Wavenumber<Constant = C>>(
        &self,
        k: T,
        below: Compliance<T>,
        carry: &mut Carry<T>,
    ) -> Compliance<T> {
        LayerMatrices::new(&self.constants, k * self.thickness).lift(&self.springs.over(k, below), carry)
    }

    /// The same, and the traction below the layer per traction at its top.
    pub(crate) fn lift_and_descend<T: Wavenumber<Constant = C>>(
        &self,
        k: T,
        below: Compliance<T>,
        carry: &mut Carry<T>,
    ) -> (Compliance<T>, Descent<T>) {
        let matrices = LayerMatrices::new(&self.constants, k * self.thickness);
        let below = self.springs.over(k, below);
        (matrices.lift(&below, carry), matrices.descend(&below))
    }

    /// The longest length that springs make with a body of this shear modulus \[length\]: modulus times jump per traction. A frictionless
    /// interface makes none in what pressure does.
    pub(crate) fn length_of_springs(&self, modulus: f64) -> f64 {
        let free = FREE * (self.thickness.value() / self.constants.mu.value());
        let of = |compliance: f64| if compliance < free { modulus * compliance } else { 0.0 };
        of(self.springs.normal.value()) + of(self.springs.shear.value())
    }
}

/// The longest length of a stack \[length\]: total thickness of its layers times the largest ratio of shear moduli (a stiff film spreads
/// shear so far; plates bend over less), and what springs make with the stiffest material. Zero without layers.
pub(crate) fn longest_length<C: Scalar>(layers: &[StackLayer<C>], base: Option<&LayerConstants<C>>) -> f64 {
    let moduli = || {
        let layers = layers.iter().map(|layer| layer.constants.mu.value());
        layers.chain(base.map(|base| base.mu.value()))
    };
    let stiffest = moduli().fold(0.0, f64::max);
    let softest = moduli().fold(f64::INFINITY, f64::min);
    let thickness: f64 = layers.iter().map(|layer| layer.thickness.value()).sum();
    let springs: f64 = layers.iter().map(|layer| layer.length_of_springs(stiffest)).sum();
    thickness * (stiffest / softest) + springs
}

#[cfg(test)]
mod tests {
    use super::super::frequency_response::{FrequencyResponse, Response};
    use super::super::samples::{Random, Springs as Given, golden, on_springs, stack};
    use super::{OPAQUE, StackLayer};
    use crate::model::{HalfSpace, Interface};
    use serde::Deserialize;

    #[derive(Deserialize)]
    struct Row {
        case: String,
        layers: Vec<(f64, f64, f64)>,
        interfaces: Vec<Given>,
        substrate: Option<(f64, f64)>,
        k: f64,
        zz: String,
        rr: String,
        rz: String,
        tt: String,
    }

    /// Largest relative difference; of rz relative to sqrt(rr zz), for it changes sign.
    fn difference(found: Response, exact: Response) -> f64 {
        let errors = [
            (found.zz - exact.zz) / exact.zz,
            (found.rr - exact.rr) / exact.rr,
            (found.rz - exact.rz) / (exact.rr * exact.zz).sqrt(),
            (found.tt - exact.tt) / exact.tt,
        ];
        errors.iter().fold(0.0, |worst, error| error.abs().max(worst))
    }

    fn response(half_space: &HalfSpace, k: f64) -> Response {
        FrequencyResponse::new(half_space).times_k(k)
    }

    #[test]
    fn golden_rows_of_springs_are_met() {
        let rows = golden::<Row>("frequency_response_interfaces.json");
        assert_eq!(rows.len(), 120);
        for row in rows {
            let half_space = on_springs(&stack(&row.layers, row.substrate), &row.interfaces);
            let found = FrequencyResponse::new(&half_space).at(row.k);
            let [zz, rr, rz, tt] = [&row.zz, &row.rr, &row.rz, &row.tt].map(|text| text.parse().unwrap());
            let error = difference(found, Response { zz, rr, rz, tt });
            assert!(error < 1e-14, "{} k = {:e}: {error:.1e}", row.case, row.k); // a few roundings, as of bonded layers
        }
    }

    #[test]
    fn stiff_springs_bond_and_soft_shear_springs_let_slide() {
        let mut random = Random::seeded(31);
        for case in 0..200 {
            let bonded = random.half_space(3, 1e3, case % 2 == 0);
            let count = bonded.coatings().len();
            let k = random.log_uniform(1e-3, 10.0);
            let stiff = on_springs(&bonded, &vec![Some((Some(1e40), Some(1e40))); count]);
            assert_eq!(response(&stiff, k), response(&bonded, k)); // 1e-40 is nothing beside rounding
            let free = on_springs(&bonded, &vec![Some((None, Some(0.0))); count]);
            let soft = on_springs(&bonded, &vec![Some((None, Some(1e-25))); count]);
            // what is left of a spring so soft is 1e-25 over the layers' own stiffness, 1e-6 k h at the least
            let error = difference(response(&soft, k), response(&free, k));
            assert!(error < 1e-14, "{bonded:?} k = {k}: {error:.1e}");
        }
    }

    #[test]
    fn a_layer_that_slides_on_a_rigid_base_is_the_closed_form() {
        // k C_zz = 2 (1 - nu^2)/E sinh^2 x/(x + sinh x cosh x), x = k h (Johnson 1985, Contact Mechanics, 5.8);
        // across: coth x over the shear modulus, a sheet that nothing holds
        for nu in [0.0, 0.3, 0.5] {
            let layer = on_springs(&stack(&[(2.6, nu, 1.0)], None), &[Some((None, Some(0.0)))]);
            for x in [1e-5, 0.01, 0.3, 1.0, 4.0, 30.0] {
                let found = response(&layer, x);
                let (s, c) = (libm::sinh(x), libm::cosh(x));
                let exact = 2.0 * (1.0 - nu * nu) / 2.6 * s * s / (x + s * c);
                assert!((found.zz - exact).abs() < 1e-14 * exact, "nu {nu}, x {x}: {} {exact}", found.zz);
                let across = 2.0 * (1.0 + nu) / 2.6 * c / s;
                assert!((found.tt - across).abs() < 1e-14 * across, "nu {nu}, x {x}");
            }
        }
    }

    #[test]
    fn a_stiff_thin_plate_on_springs_bends_as_one_on_a_winkler_foundation() {
        // 1/C = kn + D k^4, D = E h^3/(12 (1 - nu^2)); next order (k h)^2. A rigid one is the springs alone.
        let (young, nu, h, spring) = (1e6, 0.3, 0.01, 2.0);
        let plate = on_springs(&stack(&[(young, nu, h)], None), &[Some((Some(spring), None))]);
        let bending = young * h * h * h / (12.0 * (1.0 - nu * nu));
        for k in [0.1, 0.5, 1.0, 2.0, 4.0] {
            let found = FrequencyResponse::new(&plate).at(k);
            // bonded against shear: the plate's lower face does not stretch, which makes it four times stiffer
            let expected = 1.0 / (spring + 4.0 * bending * k * k * k * k);
            assert!((found.zz / expected - 1.0).abs() < 3e-3, "k {k}: {} {expected}", found.zz);
        }
        let free = on_springs(&stack(&[(young, nu, h)], None), &[Some((Some(spring), Some(0.0)))]);
        for k in [0.1, 0.5, 1.0, 2.0, 4.0] {
            let found = FrequencyResponse::new(&free).at(k);
            let expected = 1.0 / (spring + bending * k * k * k * k);
            assert!((found.zz / expected - 1.0).abs() < 3e-3, "k {k}: {} {expected}", found.zz);
        }
    }

    #[test]
    fn compliance_on_springs_is_positive_definite_and_more_than_bonded() {
        let mut random = Random::seeded(32);
        for case in 0..1000 {
            let bonded = random.half_space(5, 1e4, case % 2 == 0);
            let springs = random.on_springs(&bonded, 1e6);
            let k = random.log_uniform(1e-6, 1e2);
            let (softer, stiffer) = (response(&springs, k), response(&bonded, k));
            let Response { zz, rr, rz, tt } = softer;
            assert!(zz > 0.0 && rr > 0.0 && tt > 0.0 && rr * zz > rz * rz, "{springs:?} k = {k}");
            // one rounding, where the springs are not felt
            assert!(zz >= stiffer.zz * (1.0 - 1e-14) && rr >= stiffer.rr * (1.0 - 1e-14));
            assert!(tt >= stiffer.tt * (1.0 - 1e-14));
        }
    }

    #[test]
    fn scaling_lengths_and_moduli_by_powers_of_two_changes_no_bit() {
        let (length, modulus) = (2.0_f64.powi(-20), 2.0_f64.powi(37));
        for springs in [(Some(3.0), Some(0.7)), (None, Some(0.0)), (Some(0.1), None)] {
            let scaled = |stiffness: f64| stiffness * (modulus / length);
            let one = on_springs(&stack(&[(4.0, 0.2, 0.3)], Some((1.0, 0.3))), &[Some(springs)]);
            let other = on_springs(
                &stack(&[(4.0 * modulus, 0.2, 0.3 * length)], Some((modulus, 0.3))),
                &[Some((springs.0.map(scaled), springs.1.map(scaled)))],
            );
            for k in [1e-4, 0.3, 2.0, 70.0] {
                assert_eq!(response(&one, k), response(&other, k / length).over(1.0 / modulus));
            }
        }
    }

    /// Shear moduli 1, 2 and 10: .75 of layers, ten times as far for the ratio of the moduli; springs of compliance 1/4 and 1/2 make
    /// lengths 10/4 and 10/2; an interface without friction makes none.
    #[test]
    fn the_longest_length_counts_layers_and_springs() {
        let bonded = stack(&[(2.6, 0.3, 0.5), (5.2, 0.3, 0.25)], Some((26.0, 0.3)));
        for (springs, expected) in [
            (None, 7.5),
            (Some((Some(4.0), Some(2.0))), 15.0),
            (Some((Some(4.0), Some(0.0))), 10.0),
            (Some((None, Some(2.0))), 12.5),
        ] {
            let response = FrequencyResponse::new(&on_springs(&bonded, &[springs, None]));
            let found = response.longest_length();
            assert!((found / expected - 1.0).abs() < 1e-14, "{springs:?}: {found} {expected}");
            assert_eq!(response.shortest_length(), Some(0.25));
        }
        let plain = FrequencyResponse::new(&stack(&[], Some((26.0, 0.3))));
        assert_eq!((plain.longest_length(), plain.shortest_length()), (0.0, None));
    }

    /// A wave that is not felt through a layer has the response of a half-space of the layer's material, to the last bit; one of a
    /// length near the thickness feels what lies below.
    #[test]
    fn short_waves_do_not_see_through_a_layer() {
        let (layered, alone) = (stack(&[(1.0, 0.3, 0.25)], Some((9.0, 0.1))), stack(&[], Some((1.0, 0.3))));
        let layer = StackLayer::of(&layered.coatings()[0]);
        let shortest = OPAQUE / 0.25;
        assert!(layer.is_opaque(1.001 * shortest) && !layer.is_opaque(0.999 * shortest));
        assert!(difference(response(&layered, 1.001 * shortest), response(&alone, 1.0)) < 1e-15);
        assert!(difference(response(&layered, 5.0 / 0.25), response(&alone, 1.0)) > 1e-6);
    }

    #[test]
    fn layers_on_springs_are_not_joined_and_bonded_ones_are() {
        let equal = stack(&[(1.0, 0.3, 0.2), (1.0, 0.3, 0.3)], Some((1.0, 0.3)));
        assert!(equal.single_material().is_some() && equal.simplified().coatings().is_empty());
        let spring = Some((Some(1.0), None));
        let lower = on_springs(&equal, &[None, spring]);
        assert!(lower.single_material().is_none());
        let joined = lower.simplified();
        assert_eq!(joined.coatings().len(), 1);
        assert_eq!(joined.coatings()[0].thickness(), 0.5);
        assert_eq!(joined.coatings()[0].interface(), &Interface::springs(Some(1.0), None).unwrap());
        let upper = on_springs(&equal, &[spring, None]);
        assert_eq!(upper.simplified().coatings().len(), 1);
        assert_eq!(upper.simplified().coatings()[0].thickness(), 0.2);
    }

    /// Whatever the units: layers of moduli far above and far below their thickness.
    #[test]
    fn an_interface_without_friction_makes_no_length() {
        for (thickness, young) in [(1e-6, 2.6e9), (3.0, 0.26), (0.25, 26.0), (1e6, 2.6e-9)] {
            let bonded = stack(&[(young, 0.3, thickness)], Some((2.0 * young, 0.3)));
            let free = on_springs(&bonded, &[Some((None, Some(0.0)))]);
            let found = FrequencyResponse::new(&free).longest_length();
            assert!((found / (2.0 * thickness) - 1.0).abs() < 1e-14, "{thickness:e} {young:e}: {found:e}");
        }
    }
}
