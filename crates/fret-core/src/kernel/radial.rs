//! The four radial kernels of any pair of bodies: displacement at distance r from a point force.
//!
//! ```text
//! r G_q(r) = 1/(2 pi) Int_0^inf D_q(x/r) J_n(x) dx
//!
//! Z0: D = k C_zz, n = 0                 A0: D = k (C_rr + C_tt)/2, n = 0
//! Z1: D = k C_rz, n = 1                 B2: D = k (C_rr - C_tt)/2, n = 2
//!
//! G_zz = Z0    G_xx, G_yy = A0 -/+ cos(2 phi) B2    G_xy = -sin(2 phi) B2    G_zx, G_zy = (cos phi, sin phi) Z1
//! ```
//!
//! Radii and wavenumbers share one logarithmic lattice, so the transform is a sum with fixed weights: a digital filter (Ghosh
//! 1971; Anderson 1979), here made from the exact Hankel functions on a ray of the complex plane. Since `J = J exp(-x^2) +
//! Re H (1 - exp(-x^2))` and H decays off the axis, the second part is taken along `z = x exp(i angle)`; both integrands are
//! analytic in `log x`, so the trapezoidal rule converges geometrically, whatever the thickness, the contrast and the base.

use std::f64::consts::{FRAC_1_PI, TAU};

use rayon::prelude::*;

use super::complex::{Complex, Wavenumber};
use super::frequency_response::{Response, ResponseTimesK};
use super::hankel_lattice::{HankelLattice, Lanes};
use super::pair_response::PairResponse;
use super::panels::Panels;

/// Points on either side in the interpolation between lattice radii: enough for kernels that fall like `exp(-20 r/r_0)`, as
/// they do on a rigid base.
pub(super) const REACH: usize = 12;

/// The response of the pair on the lattice of wavenumbers `exp(m step)/radius`, on the axis and on the ray.
struct LatticeResponse<'a> {
    lattice: &'a HankelLattice,
    /// Index m of the first wavenumber; below it the response is constant.
    first: i32,
    real: Vec<Lanes>,
    ray: Vec<[Lanes; 2]>,
}

fn lanes<T: Wavenumber>(response: ResponseTimesK<T>) -> [T; 4] {
    let ResponseTimesK { zz, rr, rz, tt } = response;
    [zz, (rr + tt) * 0.5, (rr - tt) * 0.5, rz]
}

impl<'a> LatticeResponse<'a> {
    /// Samples the response for radii from `radius exp(-before step)` to `greatest`.
    fn new(lattice: &'a HankelLattice, pair: &PairResponse, radius: f64, greatest: f64, before: i32) -> Self {
        let longest = greatest.max(pair.longest_length());
        let first = (libm::log(1e-8 * (radius / longest)) / lattice.step).floor() as i32;
        let first = first.max(lattice.lowest + before);
        let wavenumber = |m: i32| libm::exp(f64::from(m) * lattice.step) / radius;
        let real = (first..lattice.last_real() + before + 1)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| lanes(pair.times_wavenumber(wavenumber(m))))
            .collect();
        let direction = Complex::polar(1.0, lattice.angle);
        let ray = (first..lattice.last_ray() + before + 1)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let response = lanes(pair.times_wavenumber(direction * wavenumber(m)));
                [response.map(|d| d.re), response.map(|d| d.im)]
            })
            .collect();
        Self { lattice, first, real, ray }
    }

    /// `r G(r)` of the four kernels at `r = radius exp(n step)`.
    fn transformed(&self, n: i32) -> Lanes {
        let skipped = (self.first + n - self.lattice.lowest) as usize;
        let mut real = [0.0; 4];
        for (response, weight) in self.real.iter().zip(&self.lattice.real[skipped..]) {
            for lane in 0..4 {
                real[lane] += response[lane] * weight[lane];
            }
        }
        let mut ray = [0.0; 4];
        for (response, weight) in self.ray.iter().zip(&self.lattice.ray[skipped..]) {
            for lane in 0..4 {
                ray[lane] += response[0][lane] * weight[0][lane] - response[1][lane] * weight[1][lane];
            }
        }
        let tail = self.lattice.tail(self.first + n);
        let constant = self.real[0];
        [
            real[0] + ray[0] + tail * constant[0],
            real[1] + ray[1] + tail * constant[1],
            real[2] + ray[2] + tail * self.tail_on_ray(2, -4.0 * FRAC_1_PI),
            real[3] + ray[3],
        ]
    }

    /// `Int_0^radius G(r) r dr / radius` of the kernels Z0 and A0.
    fn over_disc(&self) -> [f64; 2] {
        let skipped = (self.first - self.lattice.lowest) as usize;
        let tail = self.lattice.tail(self.first);
        [0, 1].map(|lane| {
            let real: f64 =
                self.real.iter().zip(&self.lattice.disc_real[skipped..]).map(|(d, w)| d[lane] * w).sum();
            let ray: f64 = self
                .ray
                .iter()
                .zip(&self.lattice.disc_ray[skipped..])
                .map(|(d, w)| d[0][lane] * w.re - d[1][lane] * w.im)
                .sum();
            real + ray + tail * (0.5 * self.real[0][lane] + self.tail_on_ray(lane, -2.0 * FRAC_1_PI))
        })
    }

    /// `Re [D exp(i angle) i factor]` at the first wavenumber.
    fn tail_on_ray(&self, lane: usize, factor: f64) -> f64 {
        let [re, im] = self.ray[0];
        let turned = Complex::new(re[lane], im[lane]) * Complex::polar(1.0, self.lattice.angle);
        -turned.im * factor
    }
}

/// The four radial kernels of a pair, ready for integration over cells: Z0, A0, B2/r^2, Z1/r as polynomials in r^2 (so that
/// cells need no root and no angle), and the integrals of Z0 and A0 over a disc around the force.
#[derive(Clone, Debug)]
pub(crate) struct RadialKernels {
    panels: Panels,
    disc_radius: f64,
    disc: [f64; 2],
}

impl RadialKernels {
    /// Tabulates the kernels from `least` to `greatest` distance; `least` is also the radius of the disc.
    pub(crate) fn new(pair: &PairResponse, least: f64, greatest: f64) -> Self {
        match pair.constant() {
            Some(response) => Self::homogeneous(response, least, greatest),
            None => Self::layered(HankelLattice::standard(), pair, least, greatest),
        }
    }

    /// Half-spaces without layers: `r G = D/(2 pi)` at every radius.
    fn homogeneous(response: Response, least: f64, greatest: f64) -> Self {
        let Response { zz, rr, rz, tt } = response;
        let times_r = lanes(ResponseTimesK { zz, rr, rz, tt }).map(|d| d / TAU);
        let panels = Panels::new(least * least, greatest * greatest, |square| per_radius(times_r, square));
        Self { panels, disc_radius: least, disc: [least * times_r[0], least * times_r[1]] }
    }

    /// Any pair, by its frequency response on the given lattice.
    pub(crate) fn layered(lattice: &HankelLattice, pair: &PairResponse, least: f64, greatest: f64) -> Self {
        // a panel reaches a quarter octave of the square beyond its ends, the interpolation REACH points further
        let margin = REACH as i32 + 1 + (0.5 * libm::log(1.25) / lattice.step).ceil() as i32;
        let response = LatticeResponse::new(lattice, pair, least, greatest, margin);
        let last = (libm::log(greatest / least) / lattice.step).ceil() as i32 + margin;
        let times_r: Vec<Lanes> =
            (-margin..last + 1).into_par_iter().with_min_len(8).map(|n| response.transformed(n)).collect();
        let panels = Panels::new(least * least, greatest * greatest, |square| {
            let position = libm::log(square.sqrt() / least) / lattice.step + f64::from(margin);
            per_radius(interpolated(&times_r, position), square)
        });
        Self { panels, disc_radius: least, disc: response.over_disc().map(|mean| mean * least) }
    }

    /// Z0, A0, B2/r^2, Z1/r at `r^2`.
    #[inline(always)]
    pub(crate) fn at_square(&self, square: f64) -> Lanes {
        self.panels.at(square)
    }

    /// Radius of the disc \[length\].
    pub(crate) fn disc_radius(&self) -> f64 {
        self.disc_radius
    }

    /// Integrals over the disc of Z0 and A0 [length/pressure].
    pub(crate) fn over_disc(&self) -> [f64; 2] {
        self.disc.map(|integral| TAU * integral)
    }
}

fn per_radius(times_r: Lanes, square: f64) -> Lanes {
    let r = square.sqrt();
    [times_r[0] / r, times_r[1] / r, times_r[2] / (r * square), times_r[3] / square]
}

/// `(-1)^j binomial(23, j)`: barycentric weights of evenly spaced points.
pub(super) const BARYCENTRIC: [f64; 2 * REACH] = {
    let mut weights = [1.0; 2 * REACH];
    let mut j = 1;
    while j < 2 * REACH {
        weights[j] = -weights[j - 1] * (2 * REACH - j) as f64 / j as f64;
        j += 1;
    }
    weights
};

/// Lagrange interpolation with the lattice points around a position.
pub(super) fn interpolated(lattice: &[Lanes], position: f64) -> Lanes {
    let below = position.floor();
    let start = below as usize + 1 - REACH;
    let within = position - below + (REACH - 1) as f64;
    if within == (REACH - 1) as f64 {
        return lattice[start + REACH - 1];
    }
    let mut sums = [0.0; 4];
    let mut total = 0.0;
    for (j, (weight, values)) in BARYCENTRIC.iter().zip(&lattice[start..]).enumerate() {
        let weight = weight / (within - j as f64);
        total += weight;
        for lane in 0..4 {
            sums[lane] += weight * values[lane];
        }
    }
    sums.map(|sum| sum / total)
}

#[cfg(test)]
mod tests {
    use super::super::bessel::bessel_j;
    use super::super::hankel_lattice::ORDER;
    use super::super::quadrature::GaussRule;
    use super::super::samples::{Random, golden, pair, under_rigid};
    use super::*;
    use serde::Deserialize;

    /// Z0, A0, B2, Z1 at one radius.
    fn at_radius(kernels: &RadialKernels, r: f64) -> Lanes {
        let [z0, a0, b2, z1] = kernels.at_square(r * r);
        [z0, a0, b2 * r * r, z1 * r]
    }

    /// The kernels by plain Gauss quadrature on the real axis, of what differs from the coating's half-space.
    fn by_quadrature(pair: &PairResponse, r: f64, thickness: f64) -> Lanes {
        let rule = GaussRule::new(16);
        let far = lanes(pair.times_wavenumber(1e4 / thickness));
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
                    let response = lanes(pair.times_wavenumber(k));
                    let j = bessel_j(k * r);
                    for lane in 0..4 {
                        sum[lane] += half * weight * (response[lane] - far[lane]) * j[ORDER[lane]];
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
            let kernels = RadialKernels::new(&pair, 0.01, 100.0);
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
            let found = at_radius(&RadialKernels::new(&pair, 0.5, 30.0), row.r);
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
            let total = at_radius(&RadialKernels::new(&coated, 0.1, 50.0), r);
            let own = at_radius(&RadialKernels::new(&coating, 0.1, 50.0), r);
            let rise = [0, 1, 2, 3].map(|lane| total[lane] - own[lane]);
            for (found, expected) in rise.iter().zip([normal, mean, double, -radial]) {
                assert!((found - expected).abs() < 1e-10, "{young}, {r}: {rise:?}"); // digits given
            }
        }
    }

    #[test]
    fn a_constant_response_is_a_homogeneous_half_space() {
        // r G = D/(2 pi) at every radius, by the whole transform and by the shortcut
        let response = PairResponse::new(&pair(&[], Some((2.6, 0.3))));
        let transformed = RadialKernels::layered(HankelLattice::standard(), &response, 0.5, 1e3);
        let shortcut = RadialKernels::new(&response, 0.5, 1e3);
        for n in 0..200 {
            let r = 0.5 * 2000.0_f64.powf(f64::from(n) / 200.0);
            let error = worst(at_radius(&transformed, r), at_radius(&shortcut, r));
            assert!(error < 1e-14, "{r}: {error:.1e}"); // sums of 2000 terms, weights good to 2e-14 where they are small
        }
        for (found, exact) in transformed.over_disc().iter().zip(shortcut.over_disc()) {
            assert!((found - exact).abs() < 1e-14 * exact);
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
            let standard = RadialKernels::new(&pair, 0.01, 30.0);
            for (twin, tolerance) in &twins {
                let other = RadialKernels::layered(twin, &pair, 0.01, 30.0);
                for r in [0.012, 0.1, 0.5, 1.0, 3.0, 8.0, 25.0] {
                    let (one, two) = (at_radius(&standard, r), at_radius(&other, r));
                    // where the kernel has decayed, rounding of what the transform adds remains
                    let there = lanes(pair.times_wavenumber(2.0 / r));
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
                if n % 2 == 0 {
                    (random.log_uniform(10.0, 1e4), 0.3, thickness)
                } else {
                    (1.0, 0.5, thickness)
                }
            })
            .collect();
        super::super::samples::stack(&layers, (!rigid).then_some((random.log_uniform(1.0, 1e4), 0.3)))
    }
}
