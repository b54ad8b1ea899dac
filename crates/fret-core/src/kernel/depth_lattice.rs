//! The logarithmic lattice of the transform: its weights, and the response of a depth at its wavenumbers.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use rayon::prelude::*;

use super::bessel::{bessel_j, hankel};
use super::complex::{Complex, Wavenumber};
use super::depth_response::{DepthResponse, DepthTransfer};
use super::hankel_lattice::{ANGLE, LEAST_LOG, STEPS_PER_E_FOLD};

/// Radii that are transformed side by side.
pub(super) const RADII: usize = 16;

/// Weights of the transform, for the Bessel orders 0 to 3. They depend on no case.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    pub step: f64,
    pub lowest: i32,
    /// `step/(2 pi) x J_n(x) exp(-x^2)`
    pub real: OrderedWeights,
    /// `step/(2 pi) z H_n(z) (1 - exp(-z^2))`, real part and minus the imaginary part.
    pub ray: [OrderedWeights; 2],
    /// `step/(2 pi) J_1(x) exp(-x^2)`, for the integral over a disc.
    pub disc_real: Vec<f64>,
    /// `step/(2 pi) H_1(z) (1 - exp(-z^2))`
    pub disc_ray: Vec<Complex>,
}

/// Of each order, with zeros behind the last so that whole groups of radii may be read.
#[derive(Clone, Debug)]
pub(super) struct OrderedWeights {
    length: usize,
    pub of_order: [Vec<f64>; 4],
}

impl OrderedWeights {
    fn new(weights: &[[f64; 4]]) -> Self {
        let of_order = std::array::from_fn(|order| {
            weights.iter().map(|weight| weight[order]).chain([0.0; RADII]).collect()
        });
        Self { length: weights.len(), of_order }
    }
}

impl Weights {
    /// Made once per process, by one thread: a worker that waited for others in here could be given another depth meanwhile,
    /// which would wait for these very weights.
    pub(super) fn of_the_method() -> &'static Self {
        static WEIGHTS: OnceLock<Weights> = OnceLock::new();
        WEIGHTS.get_or_init(Self::new)
    }

    fn new() -> Self {
        let angle = ANGLE.to_radians();
        let steps = f64::from(STEPS_PER_E_FOLD);
        let step = 1.0 / steps;
        let lowest = LEAST_LOG * STEPS_PER_E_FOLD as i32;
        // exp(-6.1^2) and exp(-44) are below rounding
        let last_real = (steps * libm::log(6.1)).ceil() as i32;
        let last_ray = (steps * libm::log(44.0 / libm::sin(angle))).ceil() as i32;
        let scale = step / TAU;
        let (real, disc_real): (Vec<_>, Vec<_>) = (lowest..=last_real)
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let j = bessel_j(x).map(|j| scale * j * libm::exp(-x * x));
                (j.map(|j| x * j), j[1])
            })
            .unzip();
        let (ray, disc_ray): (Vec<_>, Vec<_>) = (lowest..=last_ray)
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let z = Complex::polar(x, angle);
                let filter = -(-(z * z)).exp_m1() * scale;
                let h = hankel(x, angle).map(|h| h * filter);
                (h.map(|h| h * z), h[1])
            })
            .unzip();
        let parts: [fn(&Complex) -> f64; 2] = [|w| w.re, |w| -w.im];
        let ray = parts.map(|part| {
            let weights: Vec<[f64; 4]> =
                ray.iter().map(|orders| std::array::from_fn(|n| part(&orders[n]))).collect();
            OrderedWeights::new(&weights)
        });
        Self { step, lowest, real: OrderedWeights::new(&real), ray, disc_real, disc_ray }
    }

    fn last_real(&self) -> i32 {
        self.lowest + self.real.length as i32 - 1
    }

    fn last_ray(&self) -> i32 {
        self.lowest + self.ray[0].length as i32 - 1
    }
}

/// The response at depth on the lattice of wavenumbers `exp(m step)/radius`, on the axis and on the ray.
pub(super) struct LatticeSamples {
    /// Index m of the first wavenumber.
    pub first: i32,
    pub real: Vec<(f64, DepthTransfer<f64>)>,
    pub ray: Vec<(Complex, DepthTransfer<Complex>)>,
}

impl LatticeSamples {
    /// For responses that start with a power of the wavenumber.
    pub(super) fn new(response: &DepthResponse, radius: f64, greatest: f64, before: i32, start: i32) -> Self {
        let weights = Weights::of_the_method();
        let longest = greatest.max(response.longest_length());
        // below, D is its first power but for a fraction as small as the argument
        let least = if start > 0 { 1e-7 } else { 1e-8 };
        let first = (libm::log(least * (radius / longest)) / weights.step).floor() as i32;
        let first = first.max(weights.lowest + before);
        // beyond 100 over the depth nothing arrives: exp(-96) on the ray
        let last = if response.depth() > 0.0 {
            (libm::log(100.0 * (radius / response.depth())) / weights.step).ceil() as i32
        } else {
            i32::MAX
        };
        let wavenumber = |m: i32| libm::exp(f64::from(m) * weights.step) / radius;
        let end_real = (weights.last_real() + before + 1).min(last).max(first + 1);
        let real = (first..end_real)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let k = wavenumber(m);
                (k, response.at(k))
            })
            .collect();
        let direction = Complex::polar(1.0, ANGLE.to_radians());
        let end_ray = (weights.last_ray() + before + 1).min(last).max(first + 1);
        let ray = (first..end_ray)
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let k = direction * wavenumber(m);
                (k, response.at(k))
            })
            .collect();
        Self { first, real, ray }
    }
}
