//! The radial kernels of a point at depth: stress and displacement at horizontal distance r from a point force on the surface.
//!
//! ```text
//! r G(r) = 1/(2 pi) Int_0^inf D(x/r) J_n(x) dx        stress: D = k S(k)        displacement: D = k U(k)
//! ```
//!
//! on the logarithmic lattice of the surface's kernels (see `radial`), with Bessel orders 0 to 3. `S` and `k U` are the
//! responses of `depth_response`. No step depends on the depth: at depth 0 the same sums give the kernels of the surface, the
//! part of them that is concentrated in the loaded point being in the integral over the disc around it.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use rayon::prelude::*;

use super::bessel::{bessel_j, hankel};
use super::complex::{Complex, Wavenumber};
use super::depth_response::{DepthResponse, DepthTransfer};
use super::panels::Panels;
use super::radial::{ANGLE, LEAST_LOG, REACH, STEPS_PER_E_FOLD, interpolated};

/// Four kernels side by side.
type Lanes = [f64; 4];

/// Four kernels that are made together: what they are, and the Bessel order of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quartet {
    /// From pressure: `sigma_zz`, mean and difference of `sigma_xx` and `sigma_yy`, `sigma_rz`.
    PressureStress,
    /// From shear: `sigma_zz`, and the three parts of the stresses in the plane.
    ShearStress,
    /// From shear: mean and difference of `sigma_xz` and `sigma_yz`; two lanes are idle.
    ShearTraction,
    /// Displacement: `u_z` from pressure, mean and difference of `u_x` and `u_y` from shear, `u_r` from pressure.
    Displacement,
    /// Displacement `u_z` from shear; three lanes are idle.
    Rise,
}

impl Quartet {
    /// Bessel order of each kernel.
    pub(crate) fn orders(self) -> [usize; 4] {
        match self {
            Self::PressureStress | Self::Displacement => [0, 0, 2, 1],
            Self::ShearStress => [1, 1, 1, 3],
            Self::ShearTraction => [0, 2, 0, 0],
            Self::Rise => [1, 0, 0, 0],
        }
    }

    /// Power of k with which D starts.
    fn start(self) -> i32 {
        match self {
            Self::PressureStress | Self::ShearStress | Self::ShearTraction => 1,
            Self::Displacement | Self::Rise => 0,
        }
    }

    /// D of the four kernels at a wavenumber.
    fn lanes<T: Wavenumber>(self, k: T, transfer: &DepthTransfer<T>) -> [T; 4] {
        let t = transfer;
        let zero = T::zero();
        match self {
            Self::PressureStress => {
                let (along, across) = (t.along[1], t.across[1]);
                [k * t.normal[1], k * (along + across) * 0.5, k * (along - across) * 0.5, k * t.shear[1]]
            }
            Self::ShearStress => {
                let (along, across) = (t.along[0], t.across[0]);
                let twice = t.in_plane_shear * 2.0;
                [
                    k * t.normal[0],
                    k * (along + across) * 0.5,
                    k * (along - across - twice) * 0.25,
                    k * (along - across + twice) * 0.25,
                ]
            }
            Self::ShearTraction => {
                let (shear, twist) = (t.shear[0], t.twist_shear);
                [k * (shear + twist) * 0.5, k * (shear - twist) * 0.5, zero, zero]
            }
            Self::Displacement => {
                let (tangential, sideways) = (t.tangential[0], t.sideways);
                [
                    t.depthwise[1],
                    (tangential + sideways) * 0.5,
                    (tangential - sideways) * 0.5,
                    t.tangential[1],
                ]
            }
            Self::Rise => [t.depthwise[0], zero, zero, zero],
        }
    }
}

/// Weights of the transform for the Bessel orders 0 to 3. They depend on no case.
#[derive(Clone, Debug)]
struct Weights {
    step: f64,
    lowest: i32,
    /// `step/(2 pi) x J_n(x) exp(-x^2)`
    real: Vec<Lanes>,
    /// `step/(2 pi) z H_n(z) (1 - exp(-z^2))`, real and imaginary parts.
    ray: Vec<[Lanes; 2]>,
    /// `step/(2 pi) J_1(x) exp(-x^2)`, for the integral over a disc.
    disc_real: Vec<f64>,
    /// `step/(2 pi) H_1(z) (1 - exp(-z^2))`
    disc_ray: Vec<Complex>,
}

impl Weights {
    fn of_the_method() -> &'static Self {
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
        let (real, disc_real) = (lowest..last_real + 1)
            .into_par_iter()
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let j = bessel_j(x).map(|j| scale * j * libm::exp(-x * x));
                (j.map(|j| x * j), j[1])
            })
            .unzip();
        let (ray, disc_ray) = (lowest..last_ray + 1)
            .into_par_iter()
            .map(|m| {
                let x = libm::exp(f64::from(m) * step);
                let z = Complex::polar(x, angle);
                let filter = -(-(z * z)).exp_m1() * scale;
                let h = hankel(x, angle).map(|h| h * filter);
                let weights = h.map(|h| h * z);
                ([weights.map(|w| w.re), weights.map(|w| w.im)], h[1])
            })
            .unzip();
        Self { step, lowest, real, ray, disc_real, disc_ray }
    }

    fn last_real(&self) -> i32 {
        self.lowest + self.real.len() as i32 - 1
    }

    fn last_ray(&self) -> i32 {
        self.lowest + self.ray.len() as i32 - 1
    }

    /// The weights in the order of a quartet's lanes, from the index `skipped` on.
    fn ordered(&self, quartet: Quartet) -> OrderedWeights {
        let orders = quartet.orders();
        OrderedWeights {
            real: self.real.iter().map(|w| orders.map(|n| w[n])).collect(),
            ray: self.ray.iter().map(|w| [orders.map(|n| w[0][n]), orders.map(|n| w[1][n])]).collect(),
        }
    }

    fn of(quartet: Quartet) -> &'static OrderedWeights {
        static PRESSURE: OnceLock<OrderedWeights> = OnceLock::new();
        static SHEAR: OnceLock<OrderedWeights> = OnceLock::new();
        static TRACTION: OnceLock<OrderedWeights> = OnceLock::new();
        static RISE: OnceLock<OrderedWeights> = OnceLock::new();
        let place = match quartet {
            Quartet::PressureStress | Quartet::Displacement => &PRESSURE,
            Quartet::ShearStress => &SHEAR,
            Quartet::ShearTraction => &TRACTION,
            Quartet::Rise => &RISE,
        };
        place.get_or_init(|| Self::of_the_method().ordered(quartet))
    }
}

#[derive(Clone, Debug)]
struct OrderedWeights {
    real: Vec<Lanes>,
    ray: Vec<[Lanes; 2]>,
}

/// The response at depth on the lattice of wavenumbers `exp(m step)/radius`, on the axis and on the ray.
struct LatticeSamples {
    /// Index m of the first wavenumber.
    first: i32,
    real: Vec<(f64, DepthTransfer<f64>)>,
    ray: Vec<(Complex, DepthTransfer<Complex>)>,
}

impl LatticeSamples {
    fn new(response: &DepthResponse, radius: f64, greatest: f64, before: i32) -> Self {
        let weights = Weights::of_the_method();
        let longest = greatest.max(response.longest_length());
        let first = (libm::log(1e-8 * (radius / longest)) / weights.step).floor() as i32;
        let first = first.max(weights.lowest + before);
        // beyond 750 over the depth nothing arrives
        let last = if response.depth() > 0.0 {
            (libm::log(750.0 * (radius / response.depth())) / weights.step).ceil() as i32
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

/// D of four kernels on the lattice.
struct LatticeQuartet {
    quartet: Quartet,
    first: i32,
    real: Vec<Lanes>,
    ray: Vec<[Lanes; 2]>,
}

impl LatticeQuartet {
    fn new(quartet: Quartet, samples: &LatticeSamples) -> Self {
        let real = samples.real.iter().map(|(k, transfer)| quartet.lanes(*k, transfer)).collect();
        let ray = samples
            .ray
            .iter()
            .map(|(k, transfer)| {
                let d = quartet.lanes(*k, transfer);
                [d.map(|d| d.re), d.map(|d| d.im)]
            })
            .collect();
        Self { quartet, first: samples.first, real, ray }
    }

    /// `r G(r)` of the four kernels at `r = radius exp(n step)`.
    fn transformed(&self, n: i32) -> Lanes {
        let method = Weights::of_the_method();
        let weights = Weights::of(self.quartet);
        let skipped = (self.first + n - method.lowest) as usize;
        let mut real = [0.0; 4];
        for (response, weight) in self.real.iter().zip(&weights.real[skipped..]) {
            for lane in 0..4 {
                real[lane] += response[lane] * weight[lane];
            }
        }
        let mut ray = [0.0; 4];
        for (response, weight) in self.ray.iter().zip(&weights.ray[skipped..]) {
            for lane in 0..4 {
                ray[lane] += response[0][lane] * weight[0][lane] - response[1][lane] * weight[1][lane];
            }
        }
        let orders = self.quartet.orders();
        std::array::from_fn(|lane| {
            // below the first wavenumber terms fall by powers of x: J_n like x^n, H_n (1 - exp(-z^2)) like x^(2 - n)
            let start = self.quartet.start();
            let order = orders[lane] as i32;
            let below = |power: i32| 1.0 / libm::expm1(f64::from(power) * method.step);
            let real_first = self.real[0][lane] * weights.real[skipped][lane];
            let [d, w] = [self.ray[0], weights.ray[skipped]];
            let ray_first = d[0][lane] * w[0][lane] - d[1][lane] * w[1][lane];
            let ray_power = if order == 0 { 3 } else { 3 - order };
            real[lane]
                + ray[lane]
                + real_first * below(1 + order + start)
                + ray_first * below((ray_power + start).max(1))
        })
    }

    /// `Int_0^radius G(r) r dr` of a kernel of order 0, `radius` being that of the lattice.
    fn over_disc(&self, lane: usize, radius: f64) -> f64 {
        let method = Weights::of_the_method();
        let skipped = (self.first - method.lowest) as usize;
        let real: f64 = self.real.iter().zip(&method.disc_real[skipped..]).map(|(d, w)| d[lane] * w).sum();
        let ray: f64 = self
            .ray
            .iter()
            .zip(&method.disc_ray[skipped..])
            .map(|(d, w)| d[0][lane] * w.re - d[1][lane] * w.im)
            .sum();
        let below = 1.0 / libm::expm1(f64::from(1 + self.quartet.start()) * method.step);
        let (d, w) = (self.ray[0], method.disc_ray[skipped]);
        let first = self.real[0][lane] * method.disc_real[skipped] + d[0][lane] * w.re - d[1][lane] * w.im;
        (real + ray + first * below) * radius
    }
}

/// Four kernels at one depth, tabulated in `r^2`, each over `r^n`, n being its Bessel order.
#[derive(Clone, Debug)]
pub(crate) struct DepthKernels {
    panels: Panels,
    disc: Lanes,
}

impl DepthKernels {
    /// Tabulates quartets of kernels from `least` to `greatest` distance; `least` is also the radius of the disc.
    pub(crate) fn new<const N: usize>(
        response: &DepthResponse,
        quartets: [Quartet; N],
        least: f64,
        greatest: f64,
    ) -> [Self; N] {
        let step = Weights::of_the_method().step;
        // a panel reaches a quarter octave of the square beyond its ends, the interpolation REACH points further
        let margin = REACH as i32 + 1 + (0.5 * libm::log(1.25) / step).ceil() as i32;
        let samples = LatticeSamples::new(response, least, greatest, margin);
        let last = (libm::log(greatest / least) / step).ceil() as i32 + margin;
        quartets.map(|quartet| {
            let lattice = LatticeQuartet::new(quartet, &samples);
            let orders = quartet.orders();
            let times_r: Vec<Lanes> =
                (-margin..last + 1).into_par_iter().with_min_len(8).map(|n| lattice.transformed(n)).collect();
            let panels = Panels::new(least * least, greatest * greatest, |square| {
                let r = square.sqrt();
                let position = libm::log(r / least) / step + f64::from(margin);
                let values = interpolated(&times_r, position);
                let powers = [r, square, r * square, square * square];
                std::array::from_fn(|lane| values[lane] / powers[orders[lane]])
            });
            let disc = std::array::from_fn(|lane| {
                if orders[lane] == 0 { TAU * lattice.over_disc(lane, least) } else { 0.0 }
            });
            Self { panels, disc }
        })
    }

    /// The four kernels over `r^n` at the square of the distance.
    #[inline(always)]
    pub(crate) fn at_square(&self, square: f64) -> Lanes {
        self.panels.at(square)
    }

    /// Integrals over the disc; zero for kernels that are not of order 0.
    pub(crate) fn over_disc(&self) -> Lanes {
        self.disc
    }
}
