//! The kernels of a line load on any pair of bodies: displacement of the surface at distance x from a force per unit length that
//! is uniform along y (plane strain across the line, antiplane along it).
//!
//! ```text
//! G_q(x) = 1/pi Int_0^inf [D_q(k) cos(k x) - T_q(k)] dk/k     q = zz, xx, yy: D = k C_zz, k C_rr, k C_tt
//! G_zx(x) = 1/pi Int_0^inf D_rz(k) sin(k x) dk/k
//! ```
//!
//! `T` is the displacement of the datum, a point of the body at a depth below the force, where the body has an elastic base: a
//! line load moves an infinite half-space by a logarithm that ends nowhere, so that only differences have a meaning.
//!
//! The integrals run on the logarithmic lattice of [`radial`](super::radial), with `exp(i z)` in place of the Hankel functions:
//! `f = f exp(-x^2) + Re F (1 - exp(-x^2))`, the second part along `z = x exp(i angle)`.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};
use std::sync::OnceLock;

use pulp::Scalar;
use rayon::prelude::*;

use super::complex::{Complex, Wavenumber};
use super::datum::Datum;
use super::depth_response::Transfer;
use super::hankel_lattice::{ANGLE, LEAST_LOG, STEPS_PER_E_FOLD};
use super::interpolation::{REACH, interpolated};
use super::lattice_samples::WaveResponse;
use super::panels::Panels;

/// Kernels side by side: zz, xx, yy, zx.
type Lanes = [f64; 4];

/// Weights of the transform. They depend on no case.
#[derive(Clone, Debug)]
pub(super) struct LineLattice {
    angle: f64,
    step: f64,
    /// Index of the first weight.
    lowest: i32,
    /// `step/pi [cos x exp(-x^2) - 1, sin x exp(-x^2)]`: the first without its limit at 0.
    real: Vec<[f64; 2]>,
    /// `step/pi exp(i z) (1 - exp(-z^2))`; times `-i` for the sine.
    ray: Vec<Complex>,
    /// `step/pi (sin x/x exp(-x^2) - 1)`, for the mean from 0 to a distance.
    mean_real: Vec<f64>,
    /// `step/pi exp(i z)/(i z) (1 - exp(-z^2))`
    mean_ray: Vec<Complex>,
}

impl LineLattice {
    /// The lattice of the method, made once per process.
    pub(super) fn standard() -> &'static Self {
        static STANDARD: OnceLock<LineLattice> = OnceLock::new();
        STANDARD.get_or_init(|| Self::new(ANGLE, STEPS_PER_E_FOLD))
    }

    /// A lattice with its ray at `degrees` and `steps_per_e_fold` points per e-fold.
    fn new(degrees: f64, steps_per_e_fold: u32) -> Self {
        let angle = degrees.to_radians();
        let steps = f64::from(steps_per_e_fold);
        let step = 1.0 / steps;
        let lowest = LEAST_LOG * steps_per_e_fold as i32;
        // exp(-6.1^2) and exp(-44) are below rounding
        let last_real = (steps * libm::log(6.1)).ceil() as i32;
        let last_ray = (steps * libm::log(44.0 / libm::sin(angle))).ceil() as i32;
        let scale = step * FRAC_1_PI;
        let (real, mean_real) = (lowest..=last_real)
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let (sin, filter, half_sine) = (libm::sin(x), libm::expm1(-x * x), libm::sin(0.5 * x));
                // cos x exp(-x^2) - 1 = (cos x - 1) + cos x (exp(-x^2) - 1)
                let cosine = -2.0 * half_sine * half_sine + libm::cos(x) * filter;
                let mean = sine_over_argument_m1(x) + sin / x * filter;
                ([scale * cosine, scale * sin * (1.0 + filter)], scale * mean)
            })
            .unzip();
        let (ray, mean_ray) = (lowest..=last_ray)
            .map(|m| {
                let z = Complex::polar(libm::exp(f64::from(m) * step), angle);
                let i_z = Complex::new(-z.im, z.re);
                let wave = i_z.exp() * -(-(z * z)).exp_m1() * Complex::new(scale, 0.0);
                (wave, wave / i_z)
            })
            .unzip();
        Self { angle, step, lowest, real, ray, mean_real, mean_ray }
    }

    /// Angle of the ray.
    pub(super) fn angle(&self) -> f64 {
        self.angle
    }

    /// Step of the lattice in the logarithm.
    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// Index of the first weight.
    pub(super) fn lowest(&self) -> i32 {
        self.lowest
    }

    /// Weights `[cosine - 1, sine]` on the axis, counted from the first; beyond the last the filter leaves nothing.
    pub(super) fn real_at(&self, place: usize) -> [f64; 2] {
        self.real.get(place).copied().unwrap_or([-self.step * FRAC_1_PI, 0.0])
    }

    /// Weight of `exp(i z)` on the ray, counted from the first.
    pub(super) fn ray_at(&self, place: usize) -> Option<Complex> {
        self.ray.get(place).copied()
    }

    /// Index of the last weight on the axis.
    pub(super) fn last_real(&self) -> i32 {
        self.lowest + self.real.len() as i32 - 1
    }

    /// Index of the last weight on the ray.
    pub(super) fn last_ray(&self) -> i32 {
        self.lowest + self.ray.len() as i32 - 1
    }
}

/// `sin x/x - 1`.
fn sine_over_argument_m1(x: f64) -> f64 {
    if x > 0.5 {
        return libm::sin(x) / x - 1.0;
    }
    // -x^2/3! + x^4/5! - ...: nine terms leave 1e-22 at 0.5
    let square = x * x;
    (1..=9).rev().fold(0.0, |rest, n| {
        let divisor = f64::from((2 * n) * (2 * n + 1));
        -square / divisor * (1.0 + rest)
    })
}

/// The response of the pair and of its datum on the lattice of wavenumbers `exp(m step)/radius`.
struct LatticeResponse<'a> {
    lattice: &'a LineLattice,
    /// Index m of the first wavenumber; below it response minus datum grows in proportion to the wavenumber.
    first: i32,
    real: Vec<Lanes>,
    ray: Vec<[Lanes; 2]>,
    /// Terms up to this one are summed as response minus datum, which both have the same limit at 0.
    split: usize,
    /// `step/pi` times the sum of response minus datum before the split, of minus the datum behind it, and of all below the first.
    level: Lanes,
}

fn lanes<T: Wavenumber>(of: &Transfer<T>) -> [T; 4] {
    let ([rr, _], [rz, zz]) = (of.tangential, of.depthwise);
    [zz, rr, of.sideways, rz]
}

impl<'a> LatticeResponse<'a> {
    /// Samples the response for distances from `radius exp(-before step)` to `greatest`.
    fn new(
        lattice: &'a LineLattice,
        pair: &impl WaveResponse,
        datum: &Datum<impl WaveResponse>,
        radius: f64,
        greatest: f64,
        before: i32,
    ) -> Self {
        let longest = greatest.max(pair.longest_length()).max(datum.longest_length());
        let first = (libm::log(1e-8 * (radius / longest)) / lattice.step).floor() as i32;
        let first = first.max(lattice.lowest + before);
        let wavenumber = |m: i32| libm::exp(f64::from(m) * lattice.step) / radius;
        let real: Vec<Lanes> = (first..lattice.last_real() + before + 1)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| lanes(&pair.transfer(wavenumber(m))))
            .collect();
        let direction = Complex::polar(1.0, lattice.angle);
        let ray = (first..lattice.last_ray() + before + 1)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let response = lanes(&pair.transfer(direction * wavenumber(m)));
                [response.map(|d| d.re), response.map(|d| d.im)]
            })
            .collect();
        // the datum moves no more where its depth is 60 wavelengths over 2 pi
        let last_datum = (libm::log(60.0 * (radius / datum.depth())) / lattice.step).ceil() as i32;
        let datum: Vec<[f64; 3]> = (first..(last_datum + 1).max(first + 1))
            .into_par_iter()
            .with_min_len(32)
            .map(|m| datum.times_wavenumber(wavenumber(m)))
            .collect();
        let split = datum.len().min(real.len());
        let scale = lattice.step * FRAC_1_PI;
        let mut level = [0.0; 4];
        for lane in 0..3 {
            // smallest last: what is left below the first wavenumber, then upwards
            let mut sum = (real[0][lane] - datum[0][lane]) / libm::expm1(lattice.step);
            for (response, datum) in real[..split].iter().zip(&datum) {
                sum += response[lane] - datum[lane];
            }
            for datum in &datum[split..] {
                sum -= datum[lane];
            }
            level[lane] = scale * sum;
        }
        Self { lattice, first, real, ray, split, level }
    }

    /// Sums over the axis of weights without their limit 1 at 0, and that limit where the level does not hold it.
    fn on_axis(&self, lane: usize, weight: impl Fn(usize) -> f64) -> f64 {
        let one = self.lattice.step * FRAC_1_PI;
        let below: f64 = self.real[..self.split].iter().enumerate().map(|(m, d)| d[lane] * weight(m)).sum();
        let above = self.real.iter().enumerate().skip(self.split);
        below + above.map(|(m, d)| d[lane] * (weight(m) + one)).sum::<f64>()
    }

    /// `G(x)` of the four kernels at `x = radius exp(n step)`.
    fn transformed(&self, n: i32) -> Lanes {
        let lattice = self.lattice;
        let skipped = (self.first + n - lattice.lowest) as usize;
        // beyond the last weight the filter leaves nothing: cos x exp(-x^2) - 1 is -1 there
        let beyond = [-lattice.step * FRAC_1_PI, 0.0];
        let weight = |part: usize| {
            move |m: usize| lattice.real.get(skipped + m).map_or(beyond[part], |weights| weights[part])
        };
        let mut values = [0.0; 4];
        for lane in 0..3 {
            values[lane] = self.level[lane] + self.on_axis(lane, weight(0));
        }
        let sine = weight(1);
        // below the first wavenumber: sin x = x
        let tail = self.real[0][3] * sine(0) / libm::expm1(lattice.step);
        values[3] = tail + self.real.iter().enumerate().map(|(m, d)| d[3] * sine(m)).sum::<f64>();
        for (response, weight) in self.ray.iter().zip(&lattice.ray[skipped..]) {
            for lane in 0..3 {
                values[lane] += response[0][lane] * weight.re - response[1][lane] * weight.im;
            }
            values[3] += response[0][3] * weight.im + response[1][3] * weight.re;
        }
        values
    }

    /// Means of the kernels zz, xx and yy from 0 to `radius`.
    fn means(&self) -> [f64; 3] {
        let skipped = (self.first - self.lattice.lowest) as usize;
        let beyond = -self.lattice.step * FRAC_1_PI;
        [0, 1, 2].map(|lane| {
            let weight = |m: usize| self.lattice.mean_real.get(skipped + m).copied().unwrap_or(beyond);
            let weights = &self.lattice.mean_ray[skipped..];
            let term = |d: &[Lanes; 2], w: &Complex| d[0][lane] * w.re - d[1][lane] * w.im;
            // below the first wavenumber these weights grow in proportion to it
            let tail = term(&self.ray[0], &weights[0]) / libm::expm1(self.lattice.step);
            let ray = tail + self.ray.iter().zip(weights).map(|(d, w)| term(d, w)).sum::<f64>();
            self.level[lane] + self.on_axis(lane, weight) + ray
        })
    }
}

/// The kernels of a line load, ready for integration over strips: zz, xx, yy, zx as polynomials in the square of the distance,
/// and the means of the first three over the strip of the load itself.
#[derive(Clone, Debug)]
pub(super) struct LineKernels {
    panels: Panels<1>,
    means: [f64; 3],
}

impl LineKernels {
    /// Tabulates the kernels from `least` to `greatest` distance; `least` is also the half-width over which the means are taken.
    pub(super) fn new(
        pair: &impl WaveResponse,
        datum: &Datum<impl WaveResponse>,
        least: f64,
        greatest: f64,
    ) -> Self {
        match (pair.constant(), datum.constants()) {
            (Some(response), Some(constants)) => {
                Self::homogeneous(lanes(&response), constants, datum.depth(), least, greatest)
            }
            _ => Self::layered(LineLattice::standard(), pair, datum, least, greatest),
        }
    }

    /// Half-spaces without layers (Flamant): `D/pi log(depth/x)` plus a constant.
    fn homogeneous(
        [zz, rr, tt, rz]: Lanes,
        constants: [f64; 3],
        depth: f64,
        least: f64,
        greatest: f64,
    ) -> Self {
        let self_terms = [zz, rr, tt];
        let at = |logarithm: f64| {
            [0, 1, 2].map(|lane| (self_terms[lane] * logarithm - constants[lane]) * FRAC_1_PI)
        };
        let panels = Panels::new(least * least, greatest * greatest, |square| {
            let [zz, xx, yy] = at(libm::log(depth / square.sqrt()));
            [[zz, xx, yy, rz * FRAC_PI_2 * FRAC_1_PI]]
        });
        Self { panels, means: at(libm::log(depth / least) + 1.0) }
    }

    /// Any pair, by its frequency response on the given lattice.
    fn layered(
        lattice: &LineLattice,
        pair: &impl WaveResponse,
        datum: &Datum<impl WaveResponse>,
        least: f64,
        greatest: f64,
    ) -> Self {
        // a panel reaches a quarter octave of the square beyond its ends, the interpolation REACH points further
        let margin = REACH as i32 + 1 + (0.5 * libm::log(1.25) / lattice.step).ceil() as i32;
        let response = LatticeResponse::new(lattice, pair, datum, least, greatest, margin);
        let last = (libm::log(greatest / least) / lattice.step).ceil() as i32 + margin;
        let values: Vec<Lanes> =
            (-margin..last + 1).into_par_iter().with_min_len(8).map(|n| response.transformed(n)).collect();
        let panels = Panels::new(least * least, greatest * greatest, |square| {
            let position = libm::log(square.sqrt() / least) / lattice.step + f64::from(margin);
            [interpolated(&values, position)]
        });
        Self { panels, means: response.means() }
    }

    /// zz, xx, yy, zx at a distance `x > 0`.
    pub(super) fn at(&self, x: f64) -> Lanes {
        let [kernels] = self.panels.at::<Scalar>(x * x);
        kernels
    }

    /// Means of zz, xx and yy over the loaded strip itself.
    pub(super) fn means(&self) -> [f64; 3] {
        self.means
    }
}
