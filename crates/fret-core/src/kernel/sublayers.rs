//! How many uniform sublayers stand for a graded coating: as many as the surface's response asks for.

use std::iter::once;

use super::frequency_response::{FrequencyResponse, Response};
use crate::model::{Base, Coating, HalfSpace, Layer, MaterialError};

/// Relative change of the response by cutting, that [`layered_half_space`] is asked for when nobody says.
pub const RESPONSE_BOUND: f64 = 1e-4;
/// More sublayers than this stand for no coating.
pub const MOST_SUBLAYERS: usize = 4096;
/// Number of sublayers the search starts from.
const FIRST_COUNT: usize = 8;
/// Wavenumbers per factor ten at which responses are compared.
const PER_DECADE: i32 = 8;

/// Why no half-space was made of the layers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SublayerError {
    /// The half-space itself.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A gradient too steep for the bound.
    #[error(
        "layer {layer}: {MOST_SUBLAYERS} sublayers still change the response of the surface by {change:.1e} of itself; asked for {bound:.1e}"
    )]
    TooSteep {
        /// Index of the layer, from 0 at the surface.
        layer: usize,
        /// Change of the response expected with so many sublayers.
        change: f64,
        /// Bound asked for.
        bound: f64,
    },
}

/// Half-space of layers, outermost first: graded ones cut into the number of sublayers they name, or else into so many that the
/// surface's frequency response errs by less than `bound` [-].
///
/// Judged at wavenumbers from 1e-3 over the thickest to 1e3 over the thinnest graded coating, eight per decade: `zz`, `rr` and
/// `tt` relative to themselves, `rz` to `sqrt(zz rr)`. The response errs by order `1/n^2`
/// ([`GradedCoating::sublayers`](crate::model::GradedCoating::sublayers)), so `4/3` of its change by doubling `n` estimates the
/// error; several graded coatings share the bound equally. An estimate, not a proof: it sees what 8 and 16 sublayers, and every
/// row of a table, see. About 100 sublayers for a modulus that changes tenfold and a bound of 1e-4; a few ms.
///
/// # Errors
/// When [`MOST_SUBLAYERS`] do not meet the bound, as for a modulus that vanishes towards the surface, or the base is rigid and
/// there is no layer.
pub fn layered_half_space(layers: &[Layer], base: Base, bound: f64) -> Result<HalfSpace, SublayerError> {
    let mut counts: Vec<usize> = layers
        .iter()
        .map(|layer| match layer {
            Layer::Graded { sublayers: Some(count), .. } => *count,
            Layer::Graded { sublayers: None, .. } | Layer::Uniform(_) => FIRST_COUNT,
        })
        .collect();
    let open: Vec<usize> =
        layers.iter().enumerate().filter_map(|(n, layer)| is_open(layer).then_some(n)).collect();
    let share = bound / open.len().max(1) as f64;
    loop {
        let half_space = cut(layers, &counts, base)?;
        let mut refined = counts.clone();
        for &layer in &open {
            let mut doubled = counts.clone();
            doubled[layer] *= 2;
            let finer = cut(layers, &doubled, base)?;
            let error = 4.0 / 3.0 * largest_change(&half_space, &finer, wavenumbers(layers));
            if error <= share {
                continue;
            }
            if counts[layer] >= MOST_SUBLAYERS {
                return Err(SublayerError::TooSteep { layer, change: error, bound: share });
            }
            // order two says how many; a little more, so that the next judgement is the last one
            let expected = 1.05 * counts[layer] as f64 * (error / share).sqrt();
            refined[layer] = (expected.ceil() as usize).clamp(counts[layer] + 1, MOST_SUBLAYERS);
        }
        if refined == counts {
            return Ok(half_space);
        }
        counts = refined;
    }
}

/// Whether the number of sublayers is still to be found.
fn is_open(layer: &Layer) -> bool {
    matches!(layer, Layer::Graded { coating, sublayers: None } if !coating.is_uniform())
}

/// The half-space with given numbers of sublayers.
fn cut(layers: &[Layer], counts: &[usize], base: Base) -> Result<HalfSpace, MaterialError> {
    let mut coatings: Vec<Coating> = Vec::new();
    for (layer, &count) in layers.iter().zip(counts) {
        match layer {
            Layer::Uniform(coating) => coatings.push(*coating),
            Layer::Graded { coating, .. } => coatings.extend(coating.sublayers(count)?),
        }
    }
    HalfSpace::new(coatings, base)
}

/// Wavenumbers [rad/length] that matter for the graded layers.
fn wavenumbers(layers: &[Layer]) -> impl Iterator<Item = f64> {
    let thickness = |layer: &Layer| match layer {
        Layer::Graded { coating, .. } if !coating.is_uniform() => Some(coating.thickness()),
        Layer::Graded { .. } | Layer::Uniform(_) => None,
    };
    let thickest = layers.iter().filter_map(thickness).fold(0.0, f64::max);
    let thinnest = layers.iter().filter_map(thickness).fold(thickest, f64::min);
    let (first, last) = (1e-3 / thickest, 1e3 / thinnest);
    let steps = (libm::log10(last / first) * f64::from(PER_DECADE)) as i32;
    (0..=steps)
        .map(move |step| first * libm::pow(10.0, f64::from(step) / f64::from(PER_DECADE)))
        .chain(once(last))
}

/// Largest difference of two responses over the second one's size.
fn largest_change(one: &HalfSpace, other: &HalfSpace, wavenumbers: impl Iterator<Item = f64>) -> f64 {
    let (one, other) = (FrequencyResponse::new(one), FrequencyResponse::new(other));
    wavenumbers.map(|k| change(one.times_k(k), other.times_k(k))).fold(0.0, f64::max)
}

fn change(found: Response, exact: Response) -> f64 {
    [
        (found.zz - exact.zz) / exact.zz,
        (found.rr - exact.rr) / exact.rr,
        (found.rz - exact.rz) / (exact.zz * exact.rr).sqrt(),
        (found.tt - exact.tt) / exact.tt,
    ]
    .iter()
    .fold(0.0, |largest, part| part.abs().max(largest))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{material, stack};
    use super::*;
    use crate::model::{GradedCoating, YoungGradient};

    const SUBSTRATE: (f64, f64) = (1.0, 0.3);
    const POISSON: f64 = 0.25;

    fn exponential(top: f64, bottom: f64) -> GradedCoating {
        GradedCoating::new(YoungGradient::Exponential { top, bottom }, POISSON, 1.0).unwrap()
    }

    fn graded(coating: &GradedCoating, sublayers: Option<usize>) -> Layer {
        Layer::Graded { coating: coating.clone(), sublayers }
    }

    fn elastic() -> Base {
        Base::Elastic(material(SUBSTRATE))
    }

    fn response(coating: &GradedCoating, count: usize, base: Base, k: f64) -> Response {
        let half_space = cut(&[graded(coating, None)], &[count], base).unwrap();
        FrequencyResponse::new(&half_space).at(k)
    }

    /// Displacement per shear across the wave, on a coating of thickness 1 and shear modulus `G exp(a z)`: its waves are
    /// `exp(m z)` with `m^2 + a m - k^2 = 0`. What lies below answers with `base` times the shear.
    fn across(coating: &GradedCoating, base: f64, k: f64) -> f64 {
        let shear_modulus = |z: f64| coating.young_at(z) / (2.0 * (1.0 + POISSON));
        let a = libm::log(shear_modulus(1.0) / shear_modulus(0.0));
        let root = (0.25 * a * a + k * k).sqrt();
        // the growing wave is written from the lower face up, the falling one from the surface down
        let (growing, falling) = (-0.5 * a + root, -0.5 * a - root);
        // at the lower face u + base G u' = 0
        let at_face = |m: f64| 1.0 + base * shear_modulus(1.0) * m;
        let share = -libm::exp(falling) * at_face(falling) / at_face(growing);
        let growth = share * libm::exp(-growing);
        -(1.0 + growth) / (shear_modulus(0.0) * (falling + growth * growing))
    }

    fn shear_modulus((young, nu): (f64, f64)) -> f64 {
        young / (2.0 * (1.0 + nu))
    }

    #[test]
    fn shear_across_the_wave_meets_the_closed_form_with_order_two() {
        for (top, bottom) in [(4.0, 1.0), (1.0, 4.0), (10.0, 0.1), (0.1, 10.0)] {
            let coating = exponential(top, bottom);
            for base in [elastic(), Base::Rigid] {
                for k in [0.01, 0.3, 1.0, 3.0, 10.0, 100.0, 1000.0] {
                    let below = if base == Base::Rigid { 0.0 } else { 1.0 / (shear_modulus(SUBSTRATE) * k) };
                    let exact = across(&coating, below, k);
                    let error = |count| response(&coating, count, base, k).tt / exact - 1.0;
                    let (coarse, fine) = (error(64), error(128));
                    // order two, its next order 1/64 of it; or nothing to see, where the wave does not feel the coating
                    let order = (coarse / fine).abs().log2();
                    assert!(
                        (order - 2.0).abs() < 0.1 || coarse.abs() < 1e-7,
                        "{top} {k}: {order} {coarse:e}"
                    );
                    assert!(coarse.abs() < 2e-3, "{top} k = {k}: {coarse:e}"); // (ln 100)/(2 64^2) at the surface, and a bit
                }
            }
        }
    }

    #[test]
    fn more_sublayers_are_nearer_the_closed_form() {
        let coating = exponential(5.0, 0.5);
        for k in [0.1, 1.0, 10.0, 300.0] {
            let exact = across(&coating, 1.0 / (shear_modulus(SUBSTRATE) * k), k);
            let errors: Vec<f64> = (2..60)
                .map(|count| (response(&coating, count, elastic(), k).tt / exact - 1.0).abs())
                .collect();
            assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "k = {k}: {errors:?}");
        }
    }

    /// Response in the plane of the wave: the first-order system of plane-strain elasticity with a modulus that changes with
    /// depth, integrated upwards by the classical Runge-Kutta rule.
    fn integrated(coating: &GradedCoating, k: f64, steps: u32) -> Response {
        let nu = POISSON;
        let (a, b, g) = (nu / (1.0 - nu), 0.5 / (1.0 - nu), 0.5 * (1.0 - 2.0 * nu) / (1.0 - nu));
        let rate = |depth: f64, [wr, wz, tr, tz]: [f64; 4]| {
            let mu = coating.young_at(depth.clamp(0.0, 1.0)) / (2.0 * (1.0 + nu));
            [wz + tr / mu, -a * wr + g / mu * tz, 4.0 * mu * b * wr + a * tz, -tr].map(|value| k * value)
        };
        let plus = |one: [f64; 4], other: [f64; 4], h: f64| [0, 1, 2, 3].map(|n| one[n] + h * other[n]);
        let step = 1.0 / f64::from(steps);
        let lift = |mut state: [f64; 4]| {
            for n in 0..steps {
                let depth = 1.0 - f64::from(n) * step;
                let one = rate(depth, state);
                let two = rate(depth - 0.5 * step, plus(state, one, 0.5 * step));
                let three = rate(depth - 0.5 * step, plus(state, two, 0.5 * step));
                let four = rate(depth - step, plus(state, three, step));
                state = [0, 1, 2, 3]
                    .map(|n| state[n] + step / 6.0 * (one[n] + 2.0 * two[n] + 2.0 * three[n] + four[n]));
            }
            state
        };
        let below = FrequencyResponse::new(&stack(&[], Some(SUBSTRATE))).times_k(1.0);
        let (one, two) = (lift([below.rr, below.rz, 1.0, 0.0]), lift([below.rz, below.zz, 0.0, 1.0]));
        // w = C t for both states
        let determinant = one[2] * two[3] - two[2] * one[3];
        let solve = |row: usize| {
            [
                (one[row] * two[3] - two[row] * one[3]) / determinant,
                (two[row] * one[2] - one[row] * two[2]) / determinant,
            ]
        };
        let ([rr, rz], [_, zz]) = (solve(0), solve(1));
        Response { zz, rr, rz, tt: 1.0 }.over(k)
    }

    #[test]
    fn response_in_the_plane_meets_integrated_elasticity_with_order_two() {
        for (top, bottom) in [(4.0, 1.0), (1.0, 4.0), (10.0, 0.1)] {
            let coating = exponential(top, bottom);
            for k in [0.1, 0.5, 1.0, 2.0, 5.0] {
                let exact = integrated(&coating, k, 2000);
                let size = (exact.zz * exact.rr).sqrt();
                let errors = |count| {
                    let found = response(&coating, count, elastic(), k);
                    let parts = [found.zz - exact.zz, found.rr - exact.rr, found.rz - exact.rz];
                    parts.map(|part| part / size)
                };
                for (coarse, fine) in errors(64).iter().zip(errors(128)) {
                    let order = (coarse / fine).abs().log2();
                    // near a zero of the leading error there is no order to see
                    assert!(
                        (order - 2.0).abs() < 0.1 || coarse.abs() < 2e-6,
                        "{top} k = {k}: {order} {coarse:e}"
                    );
                    assert!(coarse.abs() < 1e-3, "{top} k = {k}: {coarse:e}");
                }
            }
        }
    }

    #[test]
    fn the_bound_is_kept_at_every_wavenumber_and_not_by_waste() {
        let laws = [
            YoungGradient::Exponential { top: 4.0, bottom: 1.0 },
            YoungGradient::Exponential { top: 0.01, bottom: 1.0 },
            YoungGradient::Linear { top: 10.0, bottom: 1.0 },
            YoungGradient::Linear { top: 1.0, bottom: 30.0 },
            YoungGradient::Table(vec![[0.0, 2.0], [0.1, 8.0], [0.101, 1.0], [0.4, 1.0], [1.0, 3.0]]),
        ];
        for young in laws {
            let coating = GradedCoating::new(young, POISSON, 1.0).unwrap();
            for base in [elastic(), Base::Rigid] {
                let layers = [graded(&coating, None)];
                for bound in [1e-2, RESPONSE_BOUND, 1e-5] {
                    let found = layered_half_space(&layers, base, bound).unwrap();
                    let exact = cut(&layers, &[MOST_SUBLAYERS], base).unwrap();
                    let change = largest_change(&found, &exact, wavenumbers(&layers));
                    let count = found.coatings().len();
                    println!("{:?} {bound:.0e}: {count} sublayers, {change:.1e}", coating.young_at(0.0));
                    assert!(change < 1.02 * bound, "{coating:?}: {change:e}"); // the estimate's next order
                    assert!(change > 0.1 * bound || count <= 16, "{coating:?}: {count}, {change:e}");
                }
            }
        }
    }

    #[test]
    fn a_graded_coating_between_uniform_ones_keeps_its_place() {
        let uniform =
            |young, thickness| Layer::Uniform(Coating::new(material((young, 0.2)), thickness).unwrap());
        let coating = exponential(4.0, 1.0);
        let layers = [uniform(3.0, 0.1), graded(&coating, Some(12)), uniform(2.0, 0.5)];
        let found = layered_half_space(&layers, elastic(), RESPONSE_BOUND).unwrap();
        assert_eq!(found.coatings().len(), 14);
        assert_eq!([0, 13].map(|n| found.coatings()[n].thickness()), [0.1, 0.5]);
        assert_eq!(found.coatings()[1..13], coating.sublayers(12).unwrap());
        let two = [graded(&coating, None), uniform(2.0, 0.5), graded(&exponential(1.0, 3.0), None)];
        let found = layered_half_space(&two, elastic(), 1e-3).unwrap();
        let exact = cut(&two, &[2000; 3], elastic()).unwrap();
        let change = largest_change(&found, &exact, wavenumbers(&two));
        assert!(change < 1e-3, "{change:e}");
    }

    /// Below a layer a thousand times as thick a coating is not felt: the upper one is cut as if it were alone and asked for half.
    #[test]
    fn two_graded_coatings_share_the_bound() {
        let uniform = Layer::Uniform(Coating::new(material((2.0, 0.2)), 1e3).unwrap());
        let steep = graded(&exponential(8.0, 0.5), None);
        let count = |layers: &[Layer], bound: f64| {
            let found = layered_half_space(layers, elastic(), bound).unwrap();
            found.coatings().iter().position(|coating| coating.thickness() > 100.0).unwrap()
        };
        let alone = [1e-3, 5e-4].map(|bound| count(&[steep.clone(), uniform.clone()], bound));
        assert!(alone[1] > alone[0], "{alone:?}");
        assert_eq!(count(&[steep.clone(), uniform, steep], 1e-3), alone[1]);
    }

    #[test]
    fn a_uniform_gradient_is_the_uniform_coating() {
        let layers = [graded(&exponential(3.0, 3.0), None)];
        let found = layered_half_space(&layers, elastic(), RESPONSE_BOUND).unwrap();
        assert_eq!(found, stack(&[(3.0, POISSON, 1.0)], Some(SUBSTRATE)));
    }

    #[test]
    fn a_modulus_that_vanishes_at_the_surface_is_refused() {
        let coating =
            GradedCoating::new(YoungGradient::Linear { top: 1e-12, bottom: 1.0 }, POISSON, 1.0).unwrap();
        let refused = layered_half_space(&[graded(&coating, None)], elastic(), 1e-6).unwrap_err();
        assert!(matches!(refused, SublayerError::TooSteep { layer: 0, .. }), "{refused}");
        assert_eq!(layered_half_space(&[], Base::Rigid, 1e-4), Err(MaterialError::BareRigidBase.into()));
    }

    #[test]
    fn the_change_of_a_response_is_its_largest_in_any_part() {
        // zz and rr by themselves, rz over the mean of both, tt by itself; a tenth of each in turn
        let exact = Response { zz: 2.0, rr: 8.0, rz: -1.0, tt: 5.0 };
        for (found, expected) in [
            (Response { zz: 2.2, ..exact }, 0.1),
            (Response { rr: 7.2, ..exact }, 0.1),
            (Response { rz: -1.4, ..exact }, 0.1),
            (Response { tt: 5.5, ..exact }, 0.1),
            (Response { zz: 2.2, rr: 6.4, rz: -1.2, tt: 4.5 }, 0.2),
            (exact, 0.0),
        ] {
            assert!((change(found, exact) - expected).abs() < 1e-15, "{found:?}");
        }
    }

    #[test]
    fn the_bound_is_looked_at_from_far_below_the_thickest_to_far_above_the_thinnest_graded_layer() {
        let graded = |thickness: f64| {
            let young = YoungGradient::Exponential { top: 1.0, bottom: 2.0 };
            let coating = GradedCoating::new(young, POISSON, thickness).unwrap();
            Layer::Graded { coating, sublayers: None }
        };
        let level = YoungGradient::Linear { top: 1.0, bottom: 1.0 };
        let level = GradedCoating::new(level, POISSON, 1e6).unwrap();
        let level = Layer::Graded { coating: level, sublayers: None };
        let uniform = Layer::Uniform(Coating::new(material(SUBSTRATE), 1e-6).unwrap());
        let all: Vec<f64> = wavenumbers(&[graded(0.1), uniform, graded(10.0), level, graded(1.0)]).collect();
        assert!((all[0] / 1e-4 - 1.0).abs() < 1e-14);
        assert!((all[all.len() - 1] / 1e4 - 1.0).abs() < 1e-14);
        // neighbours a share of a decade apart, the last ones perhaps nearer
        let apart = 10.0_f64.powf(1.0 / f64::from(PER_DECADE));
        let ratios: Vec<f64> = all.windows(2).map(|pair| pair[1] / pair[0]).collect();
        let (inner, last) = ratios.split_at(ratios.len() - 1);
        assert!(inner.iter().all(|ratio| (ratio / apart - 1.0).abs() < 1e-12), "{ratios:?}");
        assert!((1.0 - 1e-12..apart).contains(&last[0]), "{last:?}");
    }
}
