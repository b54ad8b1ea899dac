//! Weights of the transform from wavenumbers to radii, on a logarithmic lattice: the digital filter that the head of `radial`
//! describes, for the Bessel orders 0 to 3.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::bessel::{bessel_j, hankel};
use super::complex::{Complex, Wavenumber};

/// Radii that are transformed side by side.
pub(super) const RADII: usize = 16;

/// The path may turn as far as `k C(k)` has no pole: 60 degrees for a plate on a half-space, 45 on springs, 30 with
/// incompressible interlayers (the least angle found). Half of that leaves room on both sides.
pub(super) const ANGLE: f64 = 15.0;
/// Lattice points per e-fold: the error is `exp(-2 pi angle steps)` of the kernel's scale, e^-52.
pub(super) const STEPS_PER_E_FOLD: u32 = 32;
/// The lattice ends where the arguments of the Bessel functions are `exp(-75)`.
pub(super) const LEAST_LOG: i32 = -75;

/// Weights of the transform. They depend on no case.
#[derive(Clone, Debug)]
pub(super) struct HankelLattice {
    pub angle: f64,
    pub step: f64,
    /// Index of the first weight.
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

impl HankelLattice {
    /// The lattice of the method, made once per process. By one thread: a worker that waited for others in here could be
    /// given another run meanwhile, which would wait for this very lattice.
    pub(super) fn standard() -> &'static Self {
        static STANDARD: OnceLock<HankelLattice> = OnceLock::new();
        STANDARD.get_or_init(|| Self::new(ANGLE, STEPS_PER_E_FOLD))
    }

    /// A lattice with its ray at `degrees` and `steps_per_e_fold` points per e-fold.
    pub(super) fn new(degrees: f64, steps_per_e_fold: u32) -> Self {
        let angle = degrees.to_radians();
        let steps = f64::from(steps_per_e_fold);
        let step = 1.0 / steps;
        let lowest = LEAST_LOG * steps_per_e_fold as i32;
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
        Self { angle, step, lowest, real: OrderedWeights::new(&real), ray, disc_real, disc_ray }
    }

    pub(super) fn last_real(&self) -> i32 {
        self.lowest + self.real.length as i32 - 1
    }

    pub(super) fn last_ray(&self) -> i32 {
        self.lowest + self.ray[0].length as i32 - 1
    }
}
