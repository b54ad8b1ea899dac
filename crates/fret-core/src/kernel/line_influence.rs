//! Influence coefficients of line contacts: the displacement of one strip by unit traction on another, per unit length of both.

use ndarray::Array2;

use super::cell_rules::CellQuadrature;
use super::datum::Datum;
use super::influence::{Components, InfluenceCoefficients};
use super::lattice_samples::{ResponseChange, WaveResponse};
use super::line_kernels::LineKernels;
use super::pair_response::PairResponse;
use super::stack_layer::LayerChanges;
use crate::model::ContactPair;

/// Influence coefficients of a line contact: displacement of the middle of the strip at offset `i` across the line by unit
/// traction on the strip at 0 [length/pressure], lower body minus upper. Strips of width `spacing` \[length\] reach to infinity along
/// y: plane strain for pressure and shear across, antiplane for shear along. Shape `(strips, 1)`; `xy` and `zy` are zero.
///
/// Displacements are relative to the point `datum` \[length\] below the load in each body that has an elastic base: an infinite
/// half-space has no other zero under a line load. For homogeneous half-spaces `zz` is that of Flamant,
/// `(1 - nu)/(pi G) [log(datum/x) - 1/(2 (1 - nu))]` per force; a body on a rigid base needs no datum.
///
/// Error about 1e-13 of the coefficient at offset 0 for contrasts 1e-4 to 1e4; the same method as
/// [`influence_coefficients`](super::influence_coefficients), with cosines in place of Bessel functions.
pub fn line_coefficients(
    pair: &ContactPair,
    strips: usize,
    spacing: f64,
    datum: f64,
    wanted: Components,
) -> InfluenceCoefficients {
    line_coefficients_of(&PairResponse::new(pair), pair, strips, spacing, datum, wanted)
}

/// The same coefficients from a response of that pair, whatever form it has.
pub fn line_coefficients_of(
    response: &PairResponse,
    pair: &ContactPair,
    strips: usize,
    spacing: f64,
    datum: f64,
    wanted: Components,
) -> InfluenceCoefficients {
    coefficients(response, &Datum::new(pair, datum), strips, spacing, wanted)
}

/// How the coefficients of a pair change with a parameter, by the derivatives of the constants of the layers of its lower and of its upper body,
/// from the surface down, those of the substrate last; the datum stays at its depth. By the same quadrature: to about 1e-13 of the derivative of
/// the coefficient at offset 0.
pub fn line_coefficients_by(
    pair: &ContactPair,
    changes: [&[LayerChanges]; 2],
    strips: usize,
    spacing: f64,
    datum: f64,
    wanted: Components,
) -> InfluenceCoefficients {
    let datum = Datum::change(pair, changes, datum);
    coefficients(&ResponseChange::new(pair, changes), &datum, strips, spacing, wanted)
}

fn coefficients(
    response: &impl WaveResponse,
    datum: &Datum<impl WaveResponse>,
    strips: usize,
    spacing: f64,
    wanted: Components,
) -> InfluenceCoefficients {
    let half = 0.5 * spacing;
    let kernels = LineKernels::new(response, datum, half, strips as f64 * spacing);
    let quadrature = CellQuadrature::new();
    let values: Vec<[f64; 4]> = (0..strips)
        .map(|i| match i {
            0 => {
                let [zz, xx, yy] = kernels.means();
                [zz * spacing, xx * spacing, yy * spacing, 0.0]
            }
            _ => strip(&quadrature, &kernels, i as f64 * spacing, spacing),
        })
        .collect();
    let array = |wanted: bool, lane: Option<usize>| {
        wanted.then(|| Array2::from_shape_fn([strips, 1], |(i, _)| lane.map_or(0.0, |lane| values[i][lane])))
    };
    InfluenceCoefficients {
        zz: array(wanted.normal, Some(0)),
        xx: array(wanted.tangential, Some(1)),
        yy: array(wanted.tangential, Some(2)),
        xy: array(wanted.tangential, None),
        zx: array(wanted.coupling, Some(3)),
        zy: array(wanted.coupling, None),
    }
}

/// The kernels integrated over a strip at `centre`, which is halved while it is longer than half its distance.
fn strip(quadrature: &CellQuadrature, kernels: &LineKernels, centre: f64, width: f64) -> [f64; 4] {
    let mut sum = [0.0; 4];
    if width > 0.5 * centre {
        for shift in [-0.25 * width, 0.25 * width] {
            let half = strip(quadrature, kernels, centre + shift, 0.5 * width);
            sum = [0, 1, 2, 3].map(|lane| sum[lane] + half[lane]);
        }
        return sum;
    }
    for (point, weight) in quadrature.rule(centre / width) {
        let values = kernels.at(centre + 0.5 * width * point);
        for lane in 0..4 {
            sum[lane] += weight * values[lane];
        }
    }
    sum.map(|value| 0.5 * width * value)
}

#[cfg(test)]
mod tests {
    use super::super::samples::{material, pair, stack};
    use super::*;
    use crate::model::{Body, HalfSpace};
    use std::f64::consts::PI;

    fn lanes(coefficients: &InfluenceCoefficients, i: usize) -> [f64; 4] {
        let InfluenceCoefficients { zz, xx, yy, zx, .. } = coefficients;
        [zz, xx, yy, zx].map(|array| array.as_ref().unwrap()[[i, 0]])
    }

    /// Largest difference at any offset, over the self-influence coefficient zz.
    fn difference(found: &InfluenceCoefficients, exact: &InfluenceCoefficients) -> f64 {
        let own = lanes(exact, 0)[0];
        let strips = exact.zz.as_ref().unwrap().len();
        let at = |i: usize| (0..4).map(move |lane| (lanes(found, i)[lane] - lanes(exact, i)[lane]).abs());
        (0..strips).flat_map(at).fold(0.0, f64::max) / own
    }

    #[test]
    fn homogeneous_strips_follow_flamant() {
        // Johnson (1985), Contact Mechanics, 2.2: u_z = -(1 - nu)/(pi G) log|x| + constant per force, u_x by shear the same; at the
        // depth d below a normal force -(1 - nu)/(pi G) log d + 1/(2 pi G), below a tangential one minus the latter
        for nu in [-0.5, 0.0, 0.3, 0.5] {
            let (shear, datum, width) = (1.7, 40.0, 0.6);
            let pair = pair(&[], Some((2.0 * shear * (1.0 + nu), nu)));
            let found = line_coefficients(&pair, 300, width, datum, Components::ALL);
            // primitive of log|x|
            let primitive = |x: f64| x * libm::log(x.abs() / datum) - x;
            for i in 0..300 {
                let x = i as f64 * width;
                let logarithm = primitive(x + 0.5 * width) - primitive(x - 0.5 * width);
                let exact = [
                    -(1.0 - nu) / (PI * shear) * logarithm - width / (2.0 * PI * shear),
                    -(1.0 - nu) / (PI * shear) * logarithm + width / (2.0 * PI * shear),
                    -logarithm / (PI * shear),
                    if i == 0 { 0.0 } else { 0.25 * (1.0 - 2.0 * nu) / shear * width },
                ];
                for (lane, (found, exact)) in lanes(&found, i).into_iter().zip(exact).enumerate() {
                    // rounding of the primitives' difference, whose terms are x log x
                    let tolerance = 3e-16 * (10.0 + 6.0 * x / width) * width / shear;
                    assert!((found - exact).abs() < tolerance, "nu {nu}, {i}, {lane}: {found} {exact}");
                }
            }
        }
    }

    #[test]
    fn layers_of_one_material_are_a_half_space() {
        // moduli one bit apart, so that layers are not joined and the whole transform is taken
        for (datum, thickness) in [(50.0, 2.0), (1.0, 2.0), (300.0, 1e4), (2.0, 1e-3)] {
            let layered = pair(&[(1.0 + f64::EPSILON, 0.3, thickness)], Some((1.0, 0.3)));
            let found = line_coefficients(&layered, 200, 1.0, datum, Components::ALL);
            let exact = line_coefficients(&pair(&[], Some((1.0, 0.3))), 200, 1.0, datum, Components::ALL);
            let error = difference(&found, &exact);
            assert!(error < 5e-14, "{error:.1e}"); // rounding of the sums, over an own coefficient that is small for the shallow datum
        }
    }

    #[test]
    fn thin_coatings_vanish_and_thick_ones_are_all_there_is() {
        let of = |layers: &[(f64, f64, f64)], base| {
            line_coefficients(&pair(layers, Some(base)), 24, 1.0, 24.0, Components::ALL)
        };
        let (substrate, coating) = (of(&[], (1.0, 0.3)), of(&[], (4.0, 0.2)));
        let with = |thickness| of(&[(4.0, 0.2, thickness)], (1.0, 0.3));
        // a spring: proportional to the thickness
        let (thin, thinner) = (difference(&with(1e-6), &substrate), difference(&with(1e-7), &substrate));
        assert!(thin < 1e-5 && (thin / thinner - 10.0).abs() < 0.01, "{thin:.1e} {thinner:.1e}");
        // what the substrate adds between the surface and a datum in the coating: a strain, proportional to depth over thickness
        let (thick, thicker) = (difference(&with(1e4), &coating), difference(&with(1e5), &coating));
        assert!(thick < 1e-3 && (thick / thicker - 10.0).abs() < 0.1, "{thick:.1e} {thicker:.1e}");
    }

    #[test]
    fn a_thin_layer_on_a_rigid_base_is_a_bed_of_springs() {
        // oedometric and shear springs under the strip itself: h (1 - 2 nu)/(2 G (1 - nu)), h/G; nothing elsewhere
        let (e, nu, h) = (2.6, 0.3, 1e-3);
        let found = line_coefficients(&pair(&[(e, nu, h)], None), 8, 1.0, 8.0, Components::ALL);
        let shear = e / (2.0 * (1.0 + nu));
        let own = lanes(&found, 0);
        assert!((own[0] / (h * (1.0 - 2.0 * nu) / (2.0 * shear * (1.0 - nu))) - 1.0).abs() < 1e-12); // exp(-500)
        assert!((own[1] / (h / shear) - 1.0).abs() < 1e-12 && (own[2] / (h / shear) - 1.0).abs() < 1e-12);
        assert!(lanes(&found, 1).iter().all(|value| value.abs() < 1e-14 * own[0]));
    }

    #[test]
    fn shear_along_a_line_follows_images_of_the_charge() {
        // antiplane, layer on a rigid base: images of alternating sign at depths 2 n h (a point charge above a conductor, doubled):
        // 1/(pi G) log of a hyperbolic tangent, -log tanh(pi x/(4 h))
        let (shear, h) = (1.3, 5.0);
        let pair = pair(&[(2.6 * shear, 0.3, h)], None);
        let found = line_coefficients(&pair, 40, 1.0, 8.0, Components::ALL);
        let kernel = |x: f64| -libm::log(libm::tanh(PI * x / (4.0 * h))) / (PI * shear);
        let quadrature = CellQuadrature::new();
        for i in 2..40 {
            let x = f64::from(i);
            let exact: f64 = quadrature
                .rule(2.0)
                .iter()
                .map(|(point, weight)| 0.5 * weight * kernel(x + 0.5 * point))
                .sum();
            let error = (lanes(&found, i as usize)[2] - exact).abs() / lanes(&found, 0)[2];
            assert!(error < 5e-15, "{i}: {error:.1e}"); // rounding of the sums
        }
    }

    #[test]
    fn two_bodies_add_and_their_couplings_subtract() {
        let one = stack(&[(4.0, 0.2, 1.5)], Some((1.0, 0.3)));
        let other = stack(&[(0.3, 0.45, 0.7)], Some((2.0, 0.1)));
        let of = |upper: Body, lower: Body| {
            line_coefficients(&ContactPair::new(upper, lower).unwrap(), 30, 0.5, 15.0, Components::ALL)
        };
        let both = of(Body::Elastic(other.clone()), Body::Elastic(one.clone()));
        let (first, second) = (of(Body::Rigid, Body::Elastic(one)), of(Body::Rigid, Body::Elastic(other)));
        for i in 0..30 {
            let (a, b, sum) = (lanes(&first, i), lanes(&second, i), lanes(&both, i));
            for lane in 0..4 {
                let sign = if lane == 3 { -1.0 } else { 1.0 };
                let error = (sum[lane] - (a[lane] + sign * b[lane])).abs();
                assert!(error < 2e-14 * lanes(&both, 0)[0], "{i} {lane}: {error:.1e}"); // rounding of three transforms
            }
        }
    }

    #[test]
    fn another_datum_is_another_constant() {
        let pair = pair(&[(4.0, 0.2, 1.5)], Some((1.0, 0.3)));
        let of = |datum: f64| line_coefficients(&pair, 30, 0.5, datum, Components::ALL);
        let (near, far) = (of(10.0), of(1e6));
        for lane in 0..3 {
            let constant = lanes(&far, 0)[lane] - lanes(&near, 0)[lane];
            for i in 1..30 {
                let error = (lanes(&far, i)[lane] - lanes(&near, i)[lane] - constant).abs();
                assert!(error < 1e-13 * constant, "{lane} {i}: {error:.1e}"); // 1e-14 of the farther one
            }
        }
        // deep down the half-space is the substrate: ten times deeper adds D/pi log 10 per unit load
        let deeper = lanes(&of(1e7), 0)[0] - lanes(&far, 0)[0];
        let substrate = HalfSpace::homogeneous(material((1.0, 0.3)));
        let expected =
            (1.0 - 0.3) / (PI * substrate.surface_material().shear_modulus()) * 10.0_f64.ln() * 0.5;
        assert!((deeper / expected - 1.0).abs() < 1e-5); // thickness over depth
    }

    #[test]
    fn any_contrast_and_thickness_is_finite() {
        for thickness in [1e-3, 1.0, 1e4] {
            for young in [1e-6, 1e6] {
                for base in [Some((1.0, 0.4)), None] {
                    let pair = pair(&[(young, 0.5, thickness)], base);
                    let found = line_coefficients(&pair, 64, 1.0, 64.0, Components::ALL);
                    assert!((0..64).all(|i| lanes(&found, i).iter().all(|value| value.is_finite())));
                }
            }
        }
    }

    /// Displacement per pressure goes with the length over the modulus. Powers of two round nothing, and the logarithms of the lattice
    /// are of ratios; a homogeneous half-space and layers.
    #[test]
    fn strips_are_the_same_in_every_unit() {
        let layers: [&[(f64, f64, f64)]; 2] = [&[], &[(4.0, 0.2, 1.5)]];
        for layers in layers {
            let of = |length: f64, modulus: f64| {
                let layers: Vec<_> = layers.iter().map(|(e, nu, h)| (e * modulus, *nu, h * length)).collect();
                line_coefficients(
                    &pair(&layers, Some((modulus, 0.3))),
                    40,
                    0.5 * length,
                    20.0 * length,
                    Components::ALL,
                )
            };
            let before = of(1.0, 1.0);
            for (length, modulus) in
                [(2.0_f64.powi(-17), 2.0_f64.powi(38)), (2.0_f64.powi(12), 2.0_f64.powi(-9))]
            {
                let after = of(length, modulus);
                for i in 0..40 {
                    assert_eq!(
                        lanes(&after, i).map(|value| value * modulus / length),
                        lanes(&before, i),
                        "{i}"
                    );
                }
            }
        }
    }
}
