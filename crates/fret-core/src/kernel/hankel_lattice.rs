//! Weights of the transform from wavenumbers to radii, on a logarithmic lattice: the digital filter that the head of `radial`
//! describes.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::bessel::{bessel_j, hankel};
use super::complex::{Complex, Wavenumber};

/// Order of the kernels side by side: Z0, A0, B2, Z1.
pub(super) type Lanes = [f64; 4];

/// Bessel order of each kernel.
pub(super) const ORDER: [usize; 4] = [0, 0, 2, 1];

/// The path may turn as far as `k C(k)` has no pole: 60 degrees for a plate on a half-space, 45 on springs, 30 with
/// incompressible interlayers (the least angle found). Half of that leaves room on both sides.
pub(super) const ANGLE: f64 = 15.0;
/// Lattice points per e-fold: the error is `exp(-2 pi angle steps)` of the kernel's scale, e^-52.
pub(super) const STEPS_PER_E_FOLD: u32 = 32;
/// The lattice ends where the arguments of the Bessel functions are `exp(-75)`.
pub(super) const LEAST_LOG: i32 = -75;
/// Weights of the transform. They depend on no case.
#[derive(Clone, Debug)]
pub(crate) struct HankelLattice {
    pub(super) angle: f64,
    pub(super) step: f64,
    /// Index of the first weight.
    pub(super) lowest: i32,
    /// `step/(2 pi) x J_n(x) exp(-x^2)`
    pub(super) real: Vec<Lanes>,
    /// `step/(2 pi) z H_n(z) (1 - exp(-z^2))`, real and imaginary parts.
    pub(super) ray: Vec<[Lanes; 2]>,
    /// `step/(2 pi) J_1(x) exp(-x^2)`, for the integral over a disc.
    pub(super) disc_real: Vec<f64>,
    /// `step/(2 pi) H_1(z) (1 - exp(-z^2))`
    pub(super) disc_ray: Vec<Complex>,
}

impl HankelLattice {
    /// The lattice of the method, made once per process. By one thread: a worker that waited for others in here could be
    /// given another run meanwhile, which would wait for this very lattice.
    pub(crate) fn standard() -> &'static Self {
        static STANDARD: OnceLock<HankelLattice> = OnceLock::new();
        STANDARD.get_or_init(|| Self::new(ANGLE, STEPS_PER_E_FOLD))
    }

    /// A lattice with its ray at `degrees` and `steps_per_e_fold` points per e-fold.
    pub(crate) fn new(degrees: f64, steps_per_e_fold: u32) -> Self {
        let angle = degrees.to_radians();
        let steps = f64::from(steps_per_e_fold);
        let step = 1.0 / steps;
        let lowest = LEAST_LOG * steps_per_e_fold as i32;
        // exp(-6.1^2) and exp(-44) are below rounding
        let last_real = (steps * libm::log(6.1)).ceil() as i32;
        let last_ray = (steps * libm::log(44.0 / libm::sin(angle))).ceil() as i32;
        let scale = step / TAU;
        let (real, disc_real) = (lowest..=last_real)
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let j = bessel_j(x).map(|j| scale * j * libm::exp(-x * x));
                (ORDER.map(|order| x * j[order]), j[1])
            })
            .unzip();
        let (ray, disc_ray) = (lowest..=last_ray)
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let z = Complex::polar(x, angle);
                let filter = -(-(z * z)).exp_m1() * scale;
                let h = hankel(x, angle).map(|h| h * filter);
                let weights = ORDER.map(|order| h[order] * z);
                ([weights.map(|w| w.re), weights.map(|w| w.im)], h[1])
            })
            .unzip();
        Self { angle, step, lowest, real, ray, disc_real, disc_ray }
    }

    pub(super) fn last_real(&self) -> i32 {
        self.lowest + self.real.len() as i32 - 1
    }

    pub(super) fn last_ray(&self) -> i32 {
        self.lowest + self.ray.len() as i32 - 1
    }

    /// Sum of all lattice points' `x step/(2 pi)` below the index.
    pub(super) fn tail(&self, index: i32) -> f64 {
        libm::exp(f64::from(index) * self.step) * self.step / libm::expm1(self.step) / TAU
    }
}
