use super::super::complex::Complex;
use super::super::samples::{Random, golden, material, stack};
use super::*;
use serde::Deserialize;

#[derive(Deserialize)]
struct Row {
    case: String,
    layers: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
    k: f64,
    zz: String,
    rr: String,
    rz: String,
    tt: String,
}

fn worst_error(row: &Row) -> f64 {
    let found = FrequencyResponse::new(&stack(&row.layers, row.substrate)).at(row.k);
    let [zz, rr, rz, tt] = [&row.zz, &row.rr, &row.rz, &row.tt].map(|text| text.parse().unwrap());
    difference(found, Response { zz, rr, rz, tt })
}

/// Largest relative difference; of rz relative to the larger of itself and a thousandth of sqrt(rr zz), for it changes sign.
fn difference(found: Response, exact: Response) -> f64 {
    let coupling = exact.rz.abs().max(1e-3 * (exact.rr * exact.zz).sqrt());
    let errors = [
        (found.zz - exact.zz) / exact.zz,
        (found.rr - exact.rr) / exact.rr,
        (found.rz - exact.rz) / coupling,
        (found.tt - exact.tt) / exact.tt,
    ];
    errors.iter().fold(0.0, |worst, error| error.abs().max(worst))
}

/// A response made of layers as they are given, equal neighbours not joined.
fn unjoined(layers: &[(f64, f64, f64)], substrate: Option<(f64, f64)>) -> FrequencyResponse {
    let layer = |&(e, nu, thickness): &(f64, f64, f64)| {
        StackLayer::bonded(LayerConstants::new(&material((e, nu))), thickness)
    };
    FrequencyResponse {
        layers: layers.iter().map(layer).collect(),
        base: substrate.map(|elasticity| LayerConstants::new(&material(elasticity))),
        conducts: false,
    }
}

#[test]
fn golden_rows_are_met() {
    for row in golden::<Row>("frequency_response.json") {
        let error = worst_error(&row);
        // 1e-15 but for the row next to a zero of rz, which the rounding of the decimal inputs moves by 2e-14
        assert!(error < 3e-14, "{} k = {:e}: {error:.1e}", row.case, row.k);
    }
}

#[test]
fn random_stacks_are_met() {
    for row in golden::<Row>("frequency_response_random.json") {
        let error = worst_error(&row);
        assert!(error < 1e-14, "{} k = {:e}: {error:.1e}", row.case, row.k); // measured 2.3e-15
    }
}

#[test]
fn stiff_coating_of_osullivan_and_king() {
    // closed form of the bilayer, nine digits
    let response = FrequencyResponse::new(&stack(&[(2.0, 0.3, 1.0)], Some((1.0, 0.3))));
    for (k, zz, rr, rz, tt) in [
        (0.01, 181.347_124_5, 177.241_007_5, 51.014_286_33, 256.176_595_5),
        (0.1, 17.644_838, 14.654_794_1, 4.569_528_915, 22.758_996_79),
        (1.0, 1.346_452_02, 1.010_106_576, 0.448_645_922_5, 1.422_831_735),
        (4.0, 0.229_166_412_1, 0.228_519_941_9, 0.066_302_777_96, 0.325_072_691_7),
    ] {
        assert!(difference(response.at(k), Response { zz, rr, rz, tt }) < 1e-9); // digits given
    }
}

#[test]
fn a_layer_cut_in_two_answers_as_before() {
    let mut random = Random::seeded(1);
    for case in 0..400 {
        let whole: Vec<(f64, f64, f64)> = (0..random.whole(1, 5))
            .map(|_| (random.log_uniform(1e-3, 1e3), random.poisson(), random.log_uniform(1e-3, 1.0)))
            .collect();
        let halves: Vec<_> = whole.iter().flat_map(|&(e, nu, h)| [(e, nu, 0.5 * h); 2]).collect();
        let base = (case % 2 == 0).then_some((1.0, 0.3));
        let k = random.log_uniform(1e-8, 1e3);
        let error = difference(unjoined(&halves, base).times_k(k), unjoined(&whole, base).times_k(k));
        assert!(error < 2e-13, "{whole:?} {base:?} k = {k}: {error:.1e}"); // near zeros of rz; else 1e-14
    }
}

#[test]
fn one_material_in_a_hundred_thousand_layers_is_a_half_space() {
    let layers = vec![(210e9, 0.3, 1e-5); 100_000];
    let split = unjoined(&layers, Some((210e9, 0.3)));
    let whole = unjoined(&[], Some((210e9, 0.3)));
    for k in [1e-3, 1.0, 30.0, 1e3] {
        let error = difference(split.times_k(k), whole.times_k(k));
        assert!(error < 1e-14, "k = {k}: {error:.1e}"); // compensated increments keep it at 4e-16
    }
}

/// Shear across the wave on a layer of modulus mu on a half-space of modulus 1: `(1 + tanh x/mu)/(1 + mu tanh x)`.
#[test]
fn a_hundred_thousand_layers_answer_as_one_of_their_thickness() {
    let count = 100_000;
    let (mu, shear) = (7.0, 2.6);
    let split =
        unjoined(&vec![(mu * shear, 0.3, 1.0 / f64::from(count)); count as usize], Some((shear, 0.3)));
    let whole = unjoined(&[(mu * shear, 0.3, 1.0)], Some((shear, 0.3)));
    for k in [1e-4, 0.01, 0.3, 1.0, 3.0] {
        let (found, one) = (split.times_k(k), whole.times_k(k));
        let t = libm::tanh(k);
        let exact = (1.0 + t / mu) / (1.0 + mu * t);
        // each thickness is a rounding off, all to one side: 1e-16 of tanh; and some roundings of the compensated sum
        assert!((found.tt / exact - 1.0).abs() < 5e-16, "k = {k}: {:.1e}", found.tt / exact - 1.0);
        let error = difference(found, one);
        assert!(error < 2e-15, "k = {k}: {error:.1e}");
    }
}

#[test]
fn thousands_of_layers_agree_with_the_layers_they_split() {
    let mut random = Random::seeded(7);
    for rigid in [false, true] {
        let few: Vec<(f64, f64, f64)> =
            (0..10).map(|_| (random.log_uniform(1.0, 1e6), random.poisson(), 0.1)).collect();
        let many: Vec<_> = few.iter().flat_map(|&(e, nu, h)| [(e, nu, h / 256.0); 256]).collect();
        let base = (!rigid).then_some((1.0, 0.3));
        for k in [1e-8, 1e-3, 0.1, 1.0, 10.0, 300.0] {
            let error = difference(unjoined(&many, base).times_k(k), unjoined(&few, base).times_k(k));
            assert!(error < 1e-12, "rigid {rigid}, k = {k}: {error:.1e}"); // ulp of rounding in 2560 layers at worst
        }
    }
}

#[test]
fn compliance_is_positive_definite_at_every_wavenumber() {
    let mut random = Random::seeded(2);
    for case in 0..2000 {
        let half_space = random.half_space(8, 1e6, case % 2 == 0);
        let response = FrequencyResponse::new(&half_space);
        let k = random.log_uniform(1e-8, 1e3);
        let Response { zz, rr, rz, tt } = response.times_k(k);
        assert!(zz > 0.0 && rr > 0.0 && tt > 0.0 && rr * zz > rz * rz, "{half_space:?} k = {k}");
    }
}

#[test]
fn a_softer_layer_makes_a_softer_body() {
    let mut random = Random::seeded(3);
    for case in 0..500 {
        let half_space = random.half_space(5, 1e3, case % 2 == 0);
        let mut layers: Vec<(f64, f64, f64)> = half_space
            .coatings()
            .iter()
            .map(|coating| (coating.material().young(), coating.material().poisson(), coating.thickness()))
            .collect();
        let base = match half_space.base() {
            Base::Elastic(material) => Some((material.young(), material.poisson())),
            Base::Rigid => None,
        };
        let k = random.log_uniform(1e-4, 1e2);
        let before = unjoined(&layers, base).times_k(k);
        let chosen = random.whole(0, layers.len() - 1);
        layers[chosen].0 *= 0.9;
        let after = unjoined(&layers, base).times_k(k);
        // one rounding, where the layer is not felt
        assert!(after.zz >= before.zz * (1.0 - 1e-14) && after.rr >= before.rr * (1.0 - 1e-14));
        assert!(after.tt >= before.tt * (1.0 - 1e-14));
    }
}

#[test]
fn nothing_overflows_from_zero_to_absurd_wavenumbers() {
    for half_space in
        [stack(&[(1.0, 0.3, 1.0)], Some((2.0, 0.2))), stack(&[(1.0, 0.5, 1.0), (3.0, -0.9, 1e-3)], None)]
    {
        let response = FrequencyResponse::new(&half_space);
        let coating = LayerConstants::new(half_space.surface_material()).half_space::<f64>();
        for k in [0.0, 1e-300, 1e-30, 300.0, 374.0, 375.0, 376.0, 700.0, 1e3, 1e10, 1e200, 1e300, f64::MAX] {
            let found = response.times_k(k);
            assert!([found.zz, found.rr, found.rz, found.tt].iter().all(|value| value.is_finite()), "{k}");
            if k > 1e2 {
                // a wave this short stays in the coating; 4 ulp of the layer formulas
                assert!((found.zz - coating.in_plane.zz).abs() < 1e-15 * found.zz);
                assert!((found.tt - coating.tt).abs() < 1e-15 * found.tt);
            }
            let turned = response.times_wavenumber(Complex::polar(k.min(1e300), 0.26));
            assert!(turned.zz.modulus().is_finite() && turned.rz.modulus().is_finite());
        }
    }
}

#[test]
fn long_waves_feel_the_base_and_the_compliance_of_the_coatings_as_springs() {
    // k (C - C_base) -> k times the sum over layers of h times constants of layer and base (first-order expansion)
    let (e, nu, h) = (3.0, 0.2, 0.7);
    let substrate = material((1.0, 0.35));
    let coating = LayerConstants::new(&material((e, nu)));
    let base = LayerConstants::new(&substrate).half_space::<f64>();
    let k = 1e-5;
    let found = FrequencyResponse::new(&stack(&[(e, nu, h)], Some((1.0, 0.35)))).times_k(k);
    let mu = coating.shear_modulus();
    let (b, g, a) = (0.5 / (1.0 - nu), 0.5 * (1.0 - 2.0 * nu) / (1.0 - nu), nu / (1.0 - nu));
    let (zz, rr, rz) = (base.in_plane.zz, base.in_plane.rr, base.in_plane.rz);
    let rises = [
        (found.rr - rr, 1.0 / mu + 2.0 * rz - 4.0 * mu * b * rr * rr),
        (found.zz - zz, g / mu - 2.0 * a * rz - 4.0 * mu * b * rz * rz),
        (found.rz - rz, zz - a * rr - 4.0 * mu * b * rr * rz),
        (found.tt - base.tt, 1.0 / mu - mu * base.tt * base.tt),
    ];
    for (rise, per_length) in rises {
        let expected = k * h * per_length;
        assert!((rise - expected).abs() < 1e-3 * expected.abs(), "{rise} {expected}"); // next order in k h E1/E2
    }
}

#[test]
fn thin_incompressible_layer_on_a_rigid_base() {
    // lubrication limit: zz = k^2 h^3/(3 G), rr = h/G, rz = -k h^2/(2 G)
    let response = FrequencyResponse::new(&stack(&[(3.0, 0.5, 1.0)], None));
    let k = 1e-4;
    let found = response.at(k);
    let exact = Response { zz: k * k / 3.0, rr: 1.0, rz: -0.5 * k, tt: 1.0 };
    assert!(difference(found, exact) < 1e-7); // next order (k h)^2
}

#[test]
fn scaling_lengths_and_moduli_by_powers_of_two_changes_no_bit() {
    let mut random = Random::seeded(4);
    for _ in 0..100 {
        let layers: Vec<(f64, f64, f64)> = (0..4)
            .map(|_| (random.log_uniform(1.0, 1e4), random.poisson(), random.log_uniform(1e-3, 1.0)))
            .collect();
        let k = random.log_uniform(1e-5, 1e3);
        let (length, modulus) = (2.0_f64.powi(-20), 2.0_f64.powi(37));
        let scaled: Vec<_> = layers.iter().map(|&(e, nu, h)| (e * modulus, nu, h * length)).collect();
        let before = unjoined(&layers, Some((1.0, 0.3))).times_k(k);
        let after = unjoined(&scaled, Some((modulus, 0.3))).times_k(k / length);
        assert_eq!(before, after.over(1.0 / modulus));
    }
}

#[test]
fn response_on_the_ray_continues_the_one_on_the_axis() {
    let response = FrequencyResponse::new(&stack(&[(5.0, 0.3, 1.0), (0.1, 0.5, 0.2)], Some((1.0, 0.3))));
    for k in [1e-6, 1e-2, 0.2, 0.9, 1.1, 5.0, 60.0, 500.0] {
        let axis = response.times_k(k);
        let ray = response.times_wavenumber(Complex::new(k, 0.0));
        let parts = Response { zz: ray.zz.re, rr: ray.rr.re, rz: ray.rz.re, tt: ray.tt.re };
        assert!(difference(parts, axis) < 1e-14); // the complex exponentials round differently
        assert!(ray.zz.im == 0.0 && ray.tt.im == 0.0);
    }
}
