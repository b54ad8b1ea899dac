//! How a point at depth answers a traction wave at the surface: stress and displacement at one wavenumber.
//!
//! The stack is cut at the depth. The compliance of what lies below the cut and of every cut above is carried upward in hybrid
//! layer matrices, and with it the traction that arrives at the depth: `t_bottom = (1 + Z C)^-1 E^T t_top`, layer by layer. `E`
//! carries `exp(-k h)`, so every wave decays from where it starts and nothing grows; `I + Z C` is never near singular.

use super::complex::Wavenumber;
use super::compliance_below::{Compliance, Descent};
use super::layer::Carry;
use super::layer_constants::LayerConstants;
use super::stack_layer::{LayerChanges, StackLayer, layers_with_changes, longest_length};
use crate::fields::{Dual, Scalar};
use crate::model::{Base, HalfSpace};

/// Relative distance from an interface that is rounding of a sum of thicknesses.
const ROUNDING: f64 = 1e-9;

/// A layered half-space cut at a depth, seen from one layer.
#[derive(Clone, Debug)]
pub(crate) struct DepthResponse<C = f64> {
    depth: f64,
    /// From the surface down to the depth.
    above: Vec<StackLayer<C>>,
    /// From the depth down.
    below: Vec<StackLayer<C>>,
    base: Option<LayerConstants<C>>,
    /// Of the layer the point lies in.
    constants: LayerConstants<C>,
    /// Longest length in the half-space, see `FrequencyResponse::longest_length`.
    longest: f64,
}

/// Stress and displacement at depth per unit traction wave at the surface, in the frame of the wavevector.
///
/// With `q_x = i Q`, `p = P`: `sigma_zz = -(normal . (Q, P))`, `sigma_xz = -i (shear . (Q, P))`, `sigma_xx = along . (Q, P)`,
/// `sigma_yy = across . (Q, P)`, `k u_x = i (tangential . (Q, P))`, `k u_z = depthwise . (Q, P)`; and per `q_y`:
/// `sigma_yz = -twist_shear`, `sigma_xy = i in_plane_shear`, `k u_y = sideways`. Pairs are `[per Q, per P]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transfer<T> {
    pub normal: [T; 2],
    pub shear: [T; 2],
    pub along: [T; 2],
    pub across: [T; 2],
    pub tangential: [T; 2],
    pub depthwise: [T; 2],
    pub twist_shear: T,
    pub in_plane_shear: T,
    pub sideways: T,
}

impl DepthResponse {
    /// Cuts a half-space at `depth` \[length\] and looks from layer `layer` (0 at the surface; the number of coatings: the
    /// substrate), in or at the faces of which the depth must lie.
    pub(crate) fn new(half_space: &HalfSpace, layer: usize, depth: f64) -> Self {
        let layers: Vec<StackLayer> = half_space.coatings().iter().map(StackLayer::of).collect();
        let base = match half_space.base() {
            Base::Elastic(material) => Some(LayerConstants::new(material)),
            Base::Rigid => None,
        };
        Self::cut(&layers, base, layer, depth)
    }

    /// Poisson's ratio where the point lies.
    pub(crate) fn poisson(&self) -> f64 {
        self.constants.poisson()
    }
}

impl DepthResponse<Dual> {
    /// The same with the derivatives of the constants of the layers by a parameter, from the surface down, those of the base last, and that of
    /// the depth itself.
    pub(crate) fn with_changes(
        half_space: &HalfSpace,
        changes: &[LayerChanges],
        (layer, depth): (usize, Dual),
    ) -> Self {
        let (layers, base) = layers_with_changes(half_space, changes);
        Self::cut(&layers, base, layer, depth)
    }

    /// Poisson's ratio where the point lies.
    pub(crate) fn poisson(&self) -> Dual {
        self.constants.nu
    }
}

impl<C: Scalar> DepthResponse<C> {
    fn cut(layers: &[StackLayer<C>], base: Option<LayerConstants<C>>, layer: usize, depth: C) -> Self {
        let layer = if base.is_none() { layer.min(layers.len() - 1) } else { layer.min(layers.len()) };
        let top = layers[..layer].iter().fold(C::of(0.0), |top, layer| top + layer.thickness);
        let mut within = (depth - top).max(C::of(0.0));
        let rounding = ROUNDING * depth.value();
        if let Some(own) = layers.get(layer)
            && (own.thickness - within).value().abs() <= rounding
        {
            within = own.thickness;
        } else if within.value() <= rounding {
            within = C::of(0.0);
        }
        let mut above = layers[..layer].to_vec();
        let mut below = Vec::new();
        let constants = match (layers.get(layer), base) {
            (Some(own), _) => {
                let [over, under] = own.cut(within);
                above.push(over);
                below.push(under);
                below.extend_from_slice(&layers[layer + 1..]);
                own.constants
            }
            (None, Some(substrate)) => {
                above.push(StackLayer::bonded(substrate, within));
                substrate
            }
            (None, None) => unreachable!("a rigid base always carries a coating"),
        };
        above.retain(|layer| !layer.is_empty());
        below.retain(|layer| !layer.is_empty());
        let depth = depth.value();
        let longest = depth.max(longest_length(layers, base.as_ref()));
        Self { depth, above, below, base, constants, longest }
    }

    /// Depth of the point \[length\].
    pub(crate) fn depth(&self) -> f64 {
        self.depth
    }

    /// The longest length of the problem \[length\].
    pub(crate) fn longest_length(&self) -> f64 {
        self.longest
    }

    /// Response at a real or complex wavenumber.
    pub(crate) fn at<T: Wavenumber<Constant = C>>(&self, k: T) -> Transfer<T> {
        let opaque = self.below.iter().position(|layer| layer.is_opaque(k));
        let (mut compliance, below) = match (opaque, &self.base) {
            (Some(index), _) => (self.below[index].constants.half_space(), &self.below[..index]),
            (None, Some(base)) => (base.half_space(), &self.below[..]),
            (None, None) => (Compliance::rigid(), &self.below[..]),
        };
        let mut carry = Carry::none();
        for layer in below.iter().rev() {
            compliance = layer.lift(k, compliance, &mut carry);
        }
        let at_depth = compliance;
        let mut descent = Descent::none();
        for layer in self.above.iter().rev() {
            if layer.is_opaque(k) {
                descent = Descent::opaque();
                break;
            }
            let (lifted, through) = layer.lift_and_descend(k, compliance, &mut carry);
            descent = descent.after(through);
            compliance = lifted;
        }
        self.transfer(&at_depth, &descent)
    }

    fn transfer<T: Wavenumber<Constant = C>>(
        &self,
        below: &Compliance<T>,
        descent: &Descent<T>,
    ) -> Transfer<T> {
        let (nu, mu) = (self.constants.nu, self.constants.mu);
        let across_nu = C::of(1.0) - nu;
        let (c, t) = (below.in_plane, descent.in_plane);
        let shear = [t.rr, t.rz];
        let normal = [t.zr, t.zz];
        let tangential = [0, 1].map(|n| c.rr * shear[n] + c.rz * normal[n]);
        let depthwise = [0, 1].map(|n| c.rz * shear[n] + c.zz * normal[n]);
        // Hooke's law with the stretch along the wave given and the normal traction: finite at nu = 1/2
        let along = [0, 1].map(|n| -(tangential[n] * (mu * 2.0 / across_nu) + normal[n] * (nu / across_nu)));
        let across = [0, 1].map(|n| (along[n] - normal[n]) * nu);
        let sideways = below.tt * descent.across;
        Transfer {
            normal,
            shear,
            along,
            across,
            tangential,
            depthwise,
            twist_shear: descent.across,
            in_plane_shear: sideways * mu,
            sideways,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::frequency_response::FrequencyResponse;
    use super::super::lattice_samples::WaveResponse;
    use super::super::samples::{Random, on_springs, stack};
    use super::*;

    /// What both sides of an interface share: tractions and displacements.
    fn shared(transfer: &Transfer<f64>) -> [f64; 10] {
        let Transfer { normal, shear, tangential, depthwise, twist_shear, sideways, .. } = *transfer;
        [
            normal[0],
            normal[1],
            shear[0],
            shear[1],
            tangential[0],
            tangential[1],
            depthwise[0],
            depthwise[1],
            twist_shear,
            sideways,
        ]
    }

    #[test]
    fn at_the_surface_the_traction_is_the_load_and_the_displacement_the_compliance() {
        let mut random = Random::seeded(21);
        for case in 0..50 {
            let half_space = random.half_space(4, 1e4, case % 2 == 0);
            let k = random.log_uniform(1e-6, 1e3);
            let found = DepthResponse::new(&half_space, 0, 0.0).at(k);
            let surface = FrequencyResponse::new(&half_space).times_k(k);
            assert_eq!((found.normal, found.shear), ([0.0, 1.0], [1.0, 0.0]));
            let pairs = [
                (found.tangential[0], surface.rr),
                (found.tangential[1], surface.rz),
                (found.depthwise[0], surface.rz),
                (found.depthwise[1], surface.zz),
                (found.sideways, surface.tt),
            ];
            let size = (surface.rr * surface.zz).sqrt();
            for (found, exact) in pairs {
                assert!((found - exact).abs() < 1e-13 * exact.abs().max(size), "{half_space:?} {k}");
            }
        }
    }

    #[test]
    fn published_values_of_the_bilayer_at_depth() {
        // E1/E2 = 2, h = k = 1, nu = 0.3: surface displacement of the closed form at depth, nine digits
        let found = DepthResponse::new(&stack(&[(2.0, 0.3, 1.0)], Some((1.0, 0.3))), 0, 0.0).at(1.0);
        assert!((found.depthwise[1] - 1.346_452_02).abs() < 1e-8);
        assert!((found.tangential[1] - 0.448_645_923).abs() < 1e-8);
        assert!((found.tangential[0] - 1.010_106_58).abs() < 1e-8);
    }

    #[test]
    fn a_half_space_follows_boussinesq_and_cerruti() {
        // waves in a half-space: P: n = (1 + kz) e, s = -kz e, a = (kz - 1) e; Q: n = kz e, s = (1 - kz) e, a = (kz - 2) e;
        // across: e (Johnson 1985, Contact Mechanics, chapter 13; e = exp(-kz)); any nu
        let half_space = stack(&[], Some((2.6, 0.3)));
        for kz in [1e-3, 0.3, 2.0, 30.0] {
            let (z, k) = (0.7, kz / 0.7);
            let found = DepthResponse::new(&half_space, 0, z).at(k);
            let e = libm::exp(-kz);
            let expected = [
                (found.normal[1], (1.0 + kz) * e),
                (found.normal[0], kz * e),
                (found.shear[1], -kz * e),
                (found.shear[0], (1.0 - kz) * e),
                (found.along[1], (kz - 1.0) * e),
                (found.along[0], (kz - 2.0) * e),
                (found.twist_shear, e),
                (found.in_plane_shear, e),
            ];
            for (lane, (found, exact)) in expected.into_iter().enumerate() {
                assert!((found - exact).abs() < 1e-14 * (1.0 + kz) * e, "kz {kz}, {lane}: {found} {exact}");
            }
        }
    }

    #[test]
    fn both_sides_of_an_interface_share_traction_and_displacement() {
        let mut random = Random::seeded(22);
        for case in 0..200 {
            let half_space = random.half_space(4, 1e8, case % 3 == 0);
            let k = random.log_uniform(1e-6, 60.0);
            let mut depth = 0.0;
            let sides = half_space.coatings().len() - usize::from(case % 3 == 0);
            for layer in 0..sides {
                depth += half_space.coatings()[layer].thickness();
                let upper = shared(&DepthResponse::new(&half_space, layer, depth).at(k));
                let lower = shared(&DepthResponse::new(&half_space, layer + 1, depth).at(k));
                // each pair of one load, over its larger one: single components pass through zero
                for pair in [[0, 2], [1, 3], [4, 6], [5, 7], [8, 8], [9, 9]] {
                    let size = upper[pair[0]].abs().max(upper[pair[1]].abs());
                    for n in pair {
                        assert!((upper[n] - lower[n]).abs() <= 1e-12 * size + 1e-300, "{half_space:?} {k}");
                    }
                }
            }
        }
    }

    #[test]
    fn displacement_jumps_at_springs_by_traction_over_stiffness() {
        let mut random = Random::seeded(24);
        for case in 0..200 {
            let bonded = random.half_space(3, 1e4, case % 3 == 0);
            let half_space = random.on_springs(&bonded, 1e3);
            let k = random.log_uniform(1e-4, 20.0);
            let mut depth = 0.0;
            let sides = half_space.coatings().len() - usize::from(case % 3 == 0);
            for (layer, coating) in half_space.coatings()[..sides].iter().enumerate() {
                depth += coating.thickness();
                let upper = DepthResponse::new(&half_space, layer, depth).at(k);
                let lower = DepthResponse::new(&half_space, layer + 1, depth).at(k);
                let [normal, shear] =
                    [coating.interface().normal_compliance(), coating.interface().shear_compliance()];
                for load in 0..2 {
                    let traction = lower.normal[load].abs().max(lower.shear[load].abs());
                    assert!((upper.normal[load] - lower.normal[load]).abs() <= 1e-12 * traction + 1e-300);
                    assert!((upper.shear[load] - lower.shear[load]).abs() <= 1e-12 * traction + 1e-300);
                    let size = upper.depthwise[load].abs().max(upper.tangential[load].abs());
                    let jump = upper.depthwise[load] - lower.depthwise[load];
                    assert!((jump - k * normal * lower.normal[load]).abs() <= 1e-12 * size + 1e-300);
                    let jump = upper.tangential[load] - lower.tangential[load];
                    assert!((jump - k * shear * lower.shear[load]).abs() <= 1e-12 * size + 1e-300);
                }
                let jump = upper.sideways - lower.sideways;
                let expected = k * shear * lower.twist_shear;
                assert!((jump - expected).abs() <= 1e-12 * upper.sideways + 1e-300);
            }
        }
    }

    #[test]
    fn no_shear_passes_a_frictionless_interface_and_none_stands_above_it() {
        let film = |base| on_springs(&stack(&[(3.0, 0.3, 1.0)], base), &[Some((None, Some(0.0)))]);
        for k in [1e-4, 0.1, 1.0, 5.0] {
            for layer in 0..2 {
                let found = DepthResponse::new(&film(Some((1.0, 0.3))), layer, 1.0).at(k);
                assert!(found.shear[1].abs() < 1e-20 && found.normal[1] > 0.0, "k {k}: {}", found.shear[1]);
            }
            // on a rigid base the surface sees the closed form; at the base nothing moves along the normal
            let found = DepthResponse::new(&film(None), 0, 1.0).at(k);
            assert!(found.depthwise[1] == 0.0 && found.shear[1].abs() < 1e-20);
            assert!(found.tangential[1].is_finite() && found.along[1].is_finite());
        }
    }

    #[test]
    fn equilibrium_holds_at_depth() {
        // in these terms: normal' = k shear, shear' = k along, twist_shear' = -k in_plane_shear
        let mut random = Random::seeded(23);
        for case in 0..100 {
            let half_space = random.half_space(3, 1e4, case % 2 == 0);
            let layer = random.whole(0, half_space.coatings().len() - 1);
            let top: f64 =
                half_space.coatings()[..layer].iter().map(crate::model::half_space::Coating::thickness).sum();
            let h = half_space.coatings()[layer].thickness();
            let z = top + h * (0.2 + 0.6 * random.uniform());
            let k = random.log_uniform(1e-2, 20.0);
            let step = 0.02 * h.min(1.0 / k);
            let at = |depth: f64| DepthResponse::new(&half_space, layer, depth).at(k);
            // eighth-order central difference: truncation (0.02)^8, rounding over the step
            let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
            let slope = |of: &dyn Fn(&Transfer<f64>) -> f64| {
                let pairs = weights.iter().zip(1..).map(|(weight, n)| {
                    let away = f64::from(n) * step;
                    weight * (of(&at(z + away)) - of(&at(z - away)))
                });
                pairs.sum::<f64>() / (step * k)
            };
            let here = at(z);
            for n in 0..2 {
                let size =
                    here.normal[n].abs() + here.shear[n].abs() + here.along[n].abs() + here.across[n].abs();
                let normal = slope(&|t| t.normal[n]) - here.shear[n];
                let shear = slope(&|t| t.shear[n]) - here.along[n];
                // rounding over a step that is a fiftieth of the layer or of the wave
                let tolerance = 1e-10 * size * (1.0 + 1.0 / (k * h));
                assert!(
                    normal.abs() < tolerance && shear.abs() < tolerance,
                    "{half_space:?} k {k}: {normal:e} {shear:e} of {size:e}"
                );
            }
            let twist = slope(&|t| t.twist_shear) + here.in_plane_shear;
            assert!(twist.abs() < 1e-10 * (here.twist_shear + here.in_plane_shear) * (1.0 + 1.0 / (k * h)));
        }
    }

    #[test]
    fn the_longest_length_is_that_of_the_layers_or_of_the_depth() {
        // thickness 3 times the ratio of moduli 5; and the depth itself
        let half_space = stack(&[(5.0, 0.2, 3.0)], Some((1.0, 0.2)));
        for (layer, depth, longest) in [(0, 1.0, 15.0), (1, 4.0, 15.0), (1, 40.0, 40.0)] {
            let response = DepthResponse::new(&half_space, layer, depth);
            assert!((response.longest_length() / longest - 1.0).abs() < 1e-15, "{depth}");
            // the same for tables of it
            assert_eq!(WaveResponse::longest_length(&response), response.longest_length());
            assert_eq!([response.depth(), WaveResponse::depth(&response)], [depth; 2]);
            assert!((response.poisson() - 0.2).abs() < 1e-15);
        }
    }
}
