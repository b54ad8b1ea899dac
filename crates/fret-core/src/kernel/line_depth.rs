//! Stress at depth under strips of a line contact: what a unit traction on one strip does under another.
//!
//! ```text
//! K(x) = 1/pi Int_0^inf S(k) cos(k x) dk, even        K(x) = 1/pi Int_0^inf S(k) sin(k x) dk, odd
//! ```
//!
//! with the responses `S` of [`depth_response`](super::depth_response). A strip's integral is a difference of the antiderivative at
//! its edges, which is tabulated on the logarithmic lattice of [`line_kernels`](super::line_kernels): sines over k, and cosines over k
//! up to a constant that the difference drops.

use std::f64::consts::FRAC_1_PI;

use ndarray::Array3;
use rayon::prelude::*;

use super::cells::CellCoefficients;
use super::complex::{Complex, Wavenumber};
use super::depth_response::Transfer;
use super::interpolation::{REACH, interpolated};
use super::lattice_samples::WaveResponse;
use super::line_kernels::LineLattice;

/// Kernels side by side: from pressure xx, yy, zz, xz; from `q_x` the same; from `q_y` xy, yz.
const LANES: usize = 10;
/// Which of them are even in x.
const EVEN: [bool; LANES] = [true, true, true, false, false, false, false, true, false, true];
/// Load and component of each: pressure, `q_x`, `q_y`; xx, yy, zz, xy, xz, yz.
const PLACES: [[usize; 2]; LANES] =
    [[0, 0], [0, 1], [0, 2], [0, 4], [1, 0], [1, 1], [1, 2], [1, 4], [2, 3], [2, 5]];

type Lanes = [f64; LANES];

/// `S` of all kernels: the stresses of a wave along x.
fn lanes<T: Wavenumber>(t: &Transfer<T>) -> [T; LANES] {
    [
        t.along[1],
        t.across[1],
        -t.normal[1],
        t.shear[1],
        t.along[0],
        t.across[0],
        -t.normal[0],
        -t.shear[0],
        -t.in_plane_shear,
        -t.twist_shear,
    ]
}

/// Antiderivatives of the kernels at distances `half exp(n step)`.
struct Primitives {
    /// `1/step` per e-fold, and the first index.
    step: f64,
    margin: i32,
    half: f64,
    values: Vec<Lanes>,
}

impl Primitives {
    fn new(response: &impl WaveResponse, half: f64, greatest: f64) -> Self {
        let lattice = LineLattice::standard();
        let step = lattice.step();
        let margin = REACH as i32 + 1;
        let longest = greatest.max(response.longest_length());
        // sines are the argument below, cosines 1 but for its square
        let first = (libm::log(1e-8 * (half / longest)) / step).floor() as i32;
        let first = first.max(lattice.lowest() + margin);
        // beyond 100 over the depth nothing arrives: exp(-96) on the ray
        let last = match response.depth() {
            depth if depth > 0.0 => (libm::log(100.0 * (half / depth)) / step).ceil() as i32,
            _ => i32::MAX,
        };
        let wavenumber = |m: i32| libm::exp(f64::from(m) * step) / half;
        let end = |of_lattice: i32| (of_lattice + margin + 1).min(last).max(first + 1);
        let real: Vec<Lanes> = (first..end(lattice.last_real()))
            .into_par_iter()
            .with_min_len(32)
            .map(|m| lanes(&response.transfer(wavenumber(m))))
            .collect();
        let direction = Complex::polar(1.0, lattice.angle());
        let ray: Vec<[Lanes; 2]> = (first..end(lattice.last_ray()))
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let found = lanes(&response.transfer(direction * wavenumber(m)));
                [found.map(|value| value.re), found.map(|value| value.im)]
            })
            .collect();
        let count = (libm::log(greatest / half) / step).ceil() as i32 + 2 * margin;
        let one = step * FRAC_1_PI;
        let at = |n: i32| {
            let skipped = (first + n - lattice.lowest()) as usize;
            let below = real[0].map(|value| value * lattice.real_at(skipped)[1] / libm::expm1(step));
            let mut sum = below;
            for (lane, value) in sum.iter_mut().enumerate() {
                if !EVEN[lane] {
                    *value = 0.0; // cosines leave their square there
                }
            }
            for (m, values) in real.iter().enumerate() {
                let [cosine, sine] = lattice.real_at(skipped + m);
                // the constant of the cosines belongs to wavenumbers below 1/half
                let cosine = if first + m as i32 > 0 { cosine + one } else { cosine };
                for lane in 0..LANES {
                    sum[lane] += values[lane] * if EVEN[lane] { sine } else { -cosine };
                }
            }
            for (m, [re, im]) in ray.iter().enumerate() {
                let Some(weight) = lattice.ray_at(skipped + m) else { break };
                for lane in 0..LANES {
                    // Re(-i S e^(i z)) and -Re(S e^(i z))
                    sum[lane] += if EVEN[lane] {
                        re[lane] * weight.im + im[lane] * weight.re
                    } else {
                        im[lane] * weight.im - re[lane] * weight.re
                    };
                }
            }
            sum
        };
        let values = (-margin..count - margin).into_par_iter().with_min_len(8).map(at).collect();
        Self { step, margin, half, values }
    }

    /// The antiderivatives at a distance `x >= half`, by Lagrange's polynomial through the lattice around it.
    fn at(&self, x: f64) -> Lanes {
        let position = libm::log(x / self.half) / self.step + f64::from(self.margin);
        interpolated(&self.values, position)
    }
}

/// Stress under the middle of the strip at offset `i` by unit pressure, and unit shear across and along the line, on the strip at 0;
/// shape `(strips, 1)`. Good to about 1e-13 of the traction.
pub(crate) fn line_stress_coefficients(
    response: &impl WaveResponse,
    strips: usize,
    spacing: f64,
    with_shear: bool,
) -> CellCoefficients<6> {
    let half = 0.5 * spacing;
    let primitives = Primitives::new(response, half, strips as f64 * spacing);
    let edges: Vec<Lanes> = (0..strips).map(|i| primitives.at((i as f64 + 0.5) * spacing)).collect();
    let loads = if with_shear { 3 } else { 1 };
    let mut values = Array3::zeros((strips, 6 * loads, 1));
    for i in 0..strips {
        for (lane, [load, component]) in PLACES.into_iter().enumerate().filter(|(_, [load, _])| *load < loads)
        {
            values[[i, 6 * load + component, 0]] = match (i, EVEN[lane]) {
                (0, true) => 2.0 * edges[0][lane],
                (0, false) => 0.0,
                _ => edges[i][lane] - edges[i - 1][lane],
            };
        }
    }
    CellCoefficients::new(values)
}

#[cfg(test)]
mod tests {
    use super::super::depth_response::DepthResponse;
    use super::super::samples::stack;
    use super::*;
    use std::f64::consts::PI;

    /// xx, zz, xz at (x, z) by unit pressure on the strip from -1/2 to 1/2 of a half-plane (Johnson 1985, *Contact Mechanics*, 2.5).
    fn by_pressure(x: f64, z: f64) -> [f64; 3] {
        let [near, far] = [0.5, -0.5].map(|edge| libm::atan2(x - edge, z));
        let (angle, sines) = (far - near, 0.5 * (libm::sin(2.0 * far) - libm::sin(2.0 * near)));
        let cosines = 0.5 * (libm::cos(2.0 * near) - libm::cos(2.0 * far));
        [-(angle - sines) / PI, -(angle + sines) / PI, -cosines / PI]
    }

    /// The same by unit shear along x, on the half-plane.
    fn by_shear(x: f64, z: f64) -> [f64; 3] {
        let [near, far] = [x - 0.5, x + 0.5].map(|x| x.hypot(z));
        let logarithm = libm::log(far / near);
        let [one, other] = [0.5, -0.5].map(|edge| libm::atan2(x - edge, z));
        let cosines = 0.5 * (libm::cos(2.0 * one) - libm::cos(2.0 * other));
        let (angle, sines) = (other - one, 0.5 * (libm::sin(2.0 * other) - libm::sin(2.0 * one)));
        // sigma_xx = -(2/pi) Int q x^3/r^4, sigma_zz = -(2/pi) Int q x z^2/r^4, tau = -(2/pi) Int q x^2 z/r^4
        [-(2.0 * logarithm - cosines) / PI, -cosines / PI, -(angle - sines) / PI]
    }

    #[test]
    fn strips_on_a_half_plane_follow_the_closed_forms() {
        let nu = 0.3;
        let half_space = stack(&[], Some((2.6, nu)));
        for depth in [0.0, 1e-3, 0.1, 0.7, 5.0, 60.0] {
            let response = DepthResponse::new(&half_space, 0, depth);
            let found = line_stress_coefficients(&response, 200, 1.0, true);
            for i in [0, 1, 2, 5, 30, 199] {
                let x = f64::from(i);
                let at = |load: usize, component: usize| found.kernel(load, component)[[i as usize, 0]];
                let [xx, zz, xz] = by_pressure(x, depth);
                let [shear_xx, shear_zz, shear_xz] = by_shear(x, depth);
                let [near, far] = [0.5, -0.5].map(|edge| libm::atan2(x - edge, depth));
                let logarithm = libm::log((x + 0.5).hypot(depth) / (x - 0.5).hypot(depth));
                let expected = [
                    (at(0, 0), xx),
                    (at(0, 1), nu * (xx + zz)),
                    (at(0, 2), zz),
                    (at(0, 4), xz),
                    (at(1, 0), shear_xx),
                    (at(1, 1), nu * (shear_xx + shear_zz)),
                    (at(1, 2), shear_zz),
                    (at(1, 4), shear_xz),
                    // antiplane: -(1/pi) Int q (x, z)/r^2
                    (at(2, 3), -logarithm / PI),
                    (at(2, 5), -(far - near) / PI),
                ];
                for (lane, (found, exact)) in expected.into_iter().enumerate() {
                    let error = (found - exact).abs();
                    assert!(error < 1e-13, "depth {depth}, {i}, {lane}: {found} {exact}"); // a hundred roundings of 1
                }
                assert!(at(0, 3) == 0.0 && at(1, 5) == 0.0 && at(2, 0) == 0.0);
            }
        }
    }

    #[test]
    fn both_sides_of_an_interface_share_their_traction() {
        let half_space = stack(&[(5.0, 0.3, 0.7), (0.2, 0.45, 0.4)], Some((1.0, 0.25)));
        for (layer, depth) in [(0, 0.7), (1, 0.7 + 0.4)] {
            let of = |layer| {
                line_stress_coefficients(&DepthResponse::new(&half_space, layer, depth), 60, 0.5, true)
            };
            let (upper, lower) = (of(layer), of(layer + 1));
            for (load, component) in [(0, 2), (0, 4), (1, 2), (1, 4), (2, 5)] {
                for i in 0..60 {
                    let [a, b] = [&upper, &lower].map(|side| side.kernel(load, component)[[i, 0]]);
                    assert!((a - b).abs() < 1e-13, "{load} {component} {i}: {a} {b}"); // rounding of the sums
                }
            }
        }
    }

    #[test]
    fn strips_far_and_wide_add_up_to_a_uniform_pressure() {
        // under the middle of a strip of 4001 widths at a depth of two: -p, as without edges but for depth over width
        let half_space = stack(&[(5.0, 0.3, 0.7)], Some((1.0, 0.25)));
        let found = line_stress_coefficients(&DepthResponse::new(&half_space, 1, 2.0), 2001, 1.0, false);
        let zz = found.kernel(0, 2);
        let sum = zz[[0, 0]] + 2.0 * (1..2001).map(|i| zz[[i, 0]]).sum::<f64>();
        assert!((sum + 1.0).abs() < 1e-8, "{sum}"); // cube of depth over half the width
    }

    #[test]
    fn stresses_do_not_depend_on_the_unit_of_length() {
        let stresses = |unit: f64| {
            let half_space = stack(&[(3.0, 0.3, 0.5 * unit)], Some((1.0, 0.3)));
            let response = DepthResponse::new(&half_space, 0, 0.25 * unit);
            line_stress_coefficients(&response, 40, unit, true)
        };
        let exact = stresses(1.0);
        for unit in [1.0 / 64.0, 64.0] {
            let found = stresses(unit);
            for (found, exact) in found.values.iter().zip(&exact.values) {
                // differences of antiderivatives, good to 1e-13 of the traction
                assert!((found - exact).abs() < 2e-13, "{unit}: {found} {exact}");
            }
        }
    }
}
