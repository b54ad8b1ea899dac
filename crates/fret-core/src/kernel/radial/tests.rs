use super::super::bessel::bessel_j;
use super::super::pair_response::PairResponse;
use super::super::quadrature::GaussRule;
use super::super::quartets::SurfaceDisplacement;
use super::super::samples::{Random, golden, pair, under_rigid};
use super::*;
use pulp::Scalar;
use serde::Deserialize;

impl RadialKernels<1> {
    /// Those of the surfaces of a pair, from `least` to `greatest` distance; `least` is also the radius of the disc.
    pub(crate) fn of_surface(pair: &PairResponse, least: f64, greatest: f64) -> Self {
        let lattice = KernelLattice::new::<SurfaceDisplacement, 1>(pair, least, greatest);
        KernelSource::<SurfaceDisplacement, 1>::points(&lattice, greatest)
    }
}

/// Z0, A0, B2, Z1 at one radius.
fn at_radius(kernels: &RadialKernels<1>, r: f64) -> Lanes {
    let [[z0, a0, b2, z1]] = kernels.at_square::<Scalar>(r * r);
    [z0, a0, b2 * r * r, z1 * r]
}

/// `k C` of Z0, A0, B2, Z1.
fn lanes(pair: &PairResponse, k: f64) -> Lanes {
    SurfaceDisplacement::LIST[0].lanes(k, &pair.transfer(k))
}

/// The kernels by plain Gauss quadrature on the real axis, of what differs from the coating's half-space.
fn by_quadrature(pair: &PairResponse, r: f64, thickness: f64) -> Lanes {
    let rule = GaussRule::new(16);
    let far = lanes(pair, 1e4 / thickness);
    let mut sum = [0.0; 4];
    // decades below 1/h in quarters, for transitions far below it; then steps that resolve exp(-2 k h) and J(k r)
    let mut edges: Vec<f64> =
        (0..=56).map(|n| 10.0_f64.powf(f64::from(n) / 4.0 - 14.0) / thickness).collect();
    let width = f64::min(0.5 / thickness, 2.0 / r);
    while edges[edges.len() - 1] < 40.0 / thickness {
        edges.push(edges[edges.len() - 1] + width);
    }
    edges.insert(0, 0.0);
    for edge in edges.windows(2) {
        let pieces = ((edge[1] - edge[0]) / width).ceil();
        let half = 0.5 * (edge[1] - edge[0]) / pieces;
        for piece in 0..pieces as u32 {
            for (point, weight) in &rule.points {
                let k = edge[0] + half * (2.0 * f64::from(piece) + 1.0 + point);
                let response = lanes(pair, k);
                let j = bessel_j(k * r);
                for lane in 0..4 {
                    sum[lane] += half
                        * weight
                        * (response[lane] - far[lane])
                        * j[SurfaceDisplacement::LIST[0].orders()[lane]];
                }
            }
        }
    }
    [0, 1, 2, 3].map(|lane| (sum[lane] + far[lane] / r) / TAU)
}

fn worst(found: Lanes, exact: Lanes) -> f64 {
    (0..4).fold(0.0_f64, |worst, lane| worst.max((found[lane] - exact[lane]).abs())) / exact[0].abs()
}

#[test]
fn kernels_agree_with_quadrature_along_the_real_axis() {
    type Case = (&'static [(f64, f64, f64)], Option<(f64, f64)>, f64);
    let cases: [Case; 8] = [
        (&[(2.0, 0.3, 1.0)], Some((1.0, 0.3)), 3e-14),
        (&[(1e3, 0.3, 1.0)], Some((1.0, 0.3)), 1e-12), // the quadrature's rounding: it adds what is 1e3 times larger
        (&[(1e-3, 0.2, 1.0)], Some((1.0, 0.4)), 1e-11), // the 1/r of the substrate emerges from a film 1e3 times softer
        (&[(1.0, 0.5, 1.0)], Some((10.0, 0.3)), 3e-12),
        (&[(3.0, 0.25, 0.2), (0.3, 0.45, 0.5), (8.0, -0.5, 0.3)], Some((1.0, 0.3)), 3e-13),
        (&[(1.0, 0.3, 1.0)], None, 1e-10), // at r = 6 h zz is 1e-5 of what it was at h
        (&[(1.0, 0.5, 1.0)], None, 1e-11), // zz passes through zero near r = 3
        (&[(1.0, 0.5, 0.5), (100.0, 0.3, 0.1), (1.0, 0.5, 0.4)], Some((100.0, 0.3)), 1e-11),
    ];
    for (layers, substrate, tolerance) in cases {
        let pair = PairResponse::new(&pair(layers, substrate));
        let kernels = RadialKernels::of_surface(&pair, 0.01, 100.0);
        let thinnest = layers.iter().map(|layer| layer.2).fold(1.0, f64::min);
        let radii =
            if substrate.is_some() { [0.03, 0.7, 1.9, 6.0, 60.0] } else { [0.03, 0.3, 0.7, 1.9, 6.0] };
        for r in radii {
            let error = worst(at_radius(&kernels, r), by_quadrature(&pair, r, thinnest));
            assert!(error < tolerance, "{layers:?} {substrate:?} r = {r}: {error:.1e}");
        }
    }
}

#[derive(Deserialize)]
struct Row {
    layers: Vec<(f64, f64, f64)>,
    substrate: Option<(f64, f64)>,
    r: f64,
    z0: String,
    a0: String,
    b2: String,
    z1: String,
}

#[test]
fn golden_rows_of_harsh_stacks_are_met() {
    for row in golden::<Row>("radial_kernels.json") {
        let exact: Lanes = [&row.z0, &row.a0, &row.b2, &row.z1].map(|text| text.parse().unwrap());
        let pair = PairResponse::new(&pair(&row.layers, row.substrate));
        let found = at_radius(&RadialKernels::of_surface(&pair, 0.5, 30.0), row.r);
        let largest = exact.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        for lane in 0..4 {
            let error = (found[lane] - exact[lane]).abs() / largest;
            // over the largest of the four, since zz passes through zero there: 7e-12 at twelve times the thickness of a
            // film 1e6 times softer than its base, where the response at 1/r is still 1e5 times the kernel
            assert!(error < 2e-11, "{:?} r = {}, lane {lane}: {error:.1e}", row.layers, row.r);
        }
    }
}

#[test]
fn published_point_force_corrections() {
    // coating minus its own half-space, h = 1, E2 = 1, nu = 0.3; ten digits: u_z by P, u_r by P, and the two parts of u by Q
    let rows = [
        (2.0, 1.0, [0.122_059_701_9, -0.022_516_308_0, 0.059_863_047_1, 0.001_322_489_8]),
        (2.0, 5.0, [0.028_637_793_8, -0.005_736_140_7, 0.027_861_999_5, -0.003_902_520_6]),
        (2.0, 20.0, [0.007_215_580_7, -0.001_701_244_2, 0.008_566_045_8, -0.001_687_397_9]),
        (0.5, 1.0, [-0.262_696_176_3, 0.059_452_235_7, -0.167_465_749_4, -0.002_972_469_7]),
        (0.5, 5.0, [-0.057_745_339_4, 0.014_572_587_0, -0.065_564_353_7, 0.010_628_196_7]),
    ];
    for (young, r, [normal, radial, mean, double]) in rows {
        let coated = PairResponse::new(&pair(&[(young, 0.3, 1.0)], Some((1.0, 0.3))));
        let coating = PairResponse::new(&pair(&[], Some((young, 0.3))));
        let total = at_radius(&RadialKernels::of_surface(&coated, 0.1, 50.0), r);
        let own = at_radius(&RadialKernels::of_surface(&coating, 0.1, 50.0), r);
        let rise = [0, 1, 2, 3].map(|lane| total[lane] - own[lane]);
        for (found, expected) in rise.iter().zip([normal, mean, double, -radial]) {
            assert!((found - expected).abs() < 1e-10, "{young}, {r}: {rise:?}"); // digits given
        }
    }
}

#[test]
fn a_constant_response_is_a_homogeneous_half_space() {
    // r G = D/(2 pi) at every radius
    let response = PairResponse::new(&pair(&[], Some((2.6, 0.3))));
    let kernels = RadialKernels::of_surface(&response, 0.5, 1e3);
    let exact = lanes(&response, 1.0);
    for n in 0..200 {
        let r = 0.5 * 2000.0_f64.powf(f64::from(n) / 200.0);
        let error = worst(at_radius(&kernels, r), exact.map(|d| d / (TAU * r)));
        assert!(error < 1e-14, "{r}: {error:.1e}"); // sums of 2000 terms, weights good to 2e-14 where they are small
    }
    for (found, exact) in kernels.innermost()[0].iter().zip(exact).take(2) {
        assert!((found - 0.5 * exact).abs() < 1e-14 * exact);
    }
}

#[test]
fn other_rays_and_steps_give_the_same_kernels() {
    // a pole of the response inside 15 degrees, or too coarse a lattice, would show here; the twins' own rounding is 1e-11
    // at 8 degrees, where the weights die off late
    let twins = [(HankelLattice::new(8.0, 56), 5e-11), (HankelLattice::new(18.0, 64), 5e-12)];
    let mut random = Random::seeded(6);
    for case in 0..200 {
        let rigid = case % 3 == 0;
        let half_space =
            if case % 2 == 0 { random.half_space(4, 1e4, rigid) } else { sandwich(&mut random, rigid) };
        // plates on springs have poles at 45 degrees
        let half_space = if case < 120 { half_space } else { random.on_springs(&half_space, 1e4) };
        let pair = PairResponse::new(&under_rigid(half_space.clone()));
        let standard = RadialKernels::of_surface(&pair, 0.01, 30.0);
        for (twin, tolerance) in &twins {
            let other = KernelLattice::on::<SurfaceDisplacement, 1>(twin, &pair, 0.01, 30.0);
            let other = KernelSource::<SurfaceDisplacement, 1>::points(&other, 30.0);
            for r in [0.012, 0.1, 0.5, 1.0, 3.0, 8.0, 25.0] {
                let (one, two) = (at_radius(&standard, r), at_radius(&other, r));
                // where the kernel has decayed, rounding of what the transform adds remains
                let there = lanes(&pair, 2.0 / r);
                let added = there[0].max(there[1]) / (TAU * r);
                let size = one[0].abs() + 1e-3 * added;
                for lane in 0..4 {
                    let error = (one[lane] - two[lane]).abs() / size;
                    assert!(error < *tolerance, "{half_space:?} r = {r}, lane {lane}: {error:.1e}");
                }
            }
        }
    }
}

/// Stiff plates and incompressible layers in turn: the stacks whose poles come nearest to the axis.
fn sandwich(random: &mut Random, rigid: bool) -> crate::model::HalfSpace {
    let layers: Vec<(f64, f64, f64)> = (0..random.whole(2, 4))
        .map(|n| {
            let thickness = random.log_uniform(1e-2, 1.0);
            if n % 2 == 0 { (random.log_uniform(10.0, 1e4), 0.3, thickness) } else { (1.0, 0.5, thickness) }
        })
        .collect();
    super::super::samples::stack(&layers, (!rigid).then_some((random.log_uniform(1.0, 1e4), 0.3)))
}
