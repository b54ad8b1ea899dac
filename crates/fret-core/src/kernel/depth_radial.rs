//! The radial kernels of a point at depth: stress and displacement at horizontal distance r from a point force on the surface.
//!
//! ```text
//! r G(r) = 1/(2 pi) Int_0^inf D(x/r) J_n(x) dx        stress: D = k S(k)        displacement: D = k U(k)
//! ```
//!
//! on the logarithmic lattice of the surface's kernels (see `radial`), with Bessel orders 0 to 3. `S` and `k U` are the
//! responses of `depth_response`. No step depends on the depth: at depth 0 the same sums give the kernels of the surface, the
//! part of them that is concentrated in the loaded point being in the integral over the disc around it.
//!
//! Kernels of one order share their weights, so that a few sums over the lattice run side by side, for sixteen radii at a time.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::bessel::{bessel_j, hankel};
use super::complex::{Complex, Wavenumber};
use super::depth_panels::{DepthPanels, Lanes, fused};
use super::depth_response::{DepthResponse, DepthTransfer};
use super::far_cells::filter;
use super::radial::{ANGLE, BARYCENTRIC, LEAST_LOG, REACH, STEPS_PER_E_FOLD};

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
    pub(crate) const fn orders(self) -> [usize; 4] {
        match self {
            Self::PressureStress | Self::Displacement => [0, 0, 2, 1],
            Self::ShearStress => [1, 1, 1, 3],
            Self::ShearTraction => [0, 2, 0, 0],
            Self::Rise => [1, 0, 0, 0],
        }
    }

    /// What belongs to the order of each lane, `of_order` being given from 0 to 3; zero in idle lanes.
    #[inline(always)]
    pub(crate) const fn spread(self, of_order: [f64; 4]) -> Lanes {
        let [zero, one, two, three] = of_order;
        match self {
            Self::PressureStress | Self::Displacement => [zero, zero, two, one],
            Self::ShearStress => [one, one, one, three],
            Self::ShearTraction => [zero, two, 0.0, 0.0],
            Self::Rise => [one, 0.0, 0.0, 0.0],
        }
    }

    /// How many lanes are in use.
    const fn lanes_in_use(self) -> usize {
        match self {
            Self::PressureStress | Self::ShearStress | Self::Displacement => 4,
            Self::ShearTraction => 2,
            Self::Rise => 1,
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
    #[inline(always)]
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

/// The quartets made together for one purpose.
pub(crate) trait Quartets<const N: usize>: Copy + Send + Sync {
    const LIST: [Quartet; N];
}

/// Stresses from pressure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StressFromPressure;

impl Quartets<1> for StressFromPressure {
    const LIST: [Quartet; 1] = [Quartet::PressureStress];
}

/// Stresses from pressure and shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StressFromAll;

impl Quartets<3> for StressFromAll {
    const LIST: [Quartet; 3] = [Quartet::PressureStress, Quartet::ShearStress, Quartet::ShearTraction];
}

/// Displacements from pressure and shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplacementFromAll;

impl Quartets<2> for DisplacementFromAll {
    const LIST: [Quartet; 2] = [Quartet::Displacement, Quartet::Rise];
}

/// Radii that are transformed side by side.
const RADII: usize = 16;

/// Weights of the transform, for the Bessel orders 0 to 3. They depend on no case.
#[derive(Clone, Debug)]
struct Weights {
    step: f64,
    lowest: i32,
    /// `step/(2 pi) x J_n(x) exp(-x^2)`
    real: OrderedWeights,
    /// `step/(2 pi) z H_n(z) (1 - exp(-z^2))`, real part and minus the imaginary part.
    ray: [OrderedWeights; 2],
    /// `step/(2 pi) J_1(x) exp(-x^2)`, for the integral over a disc.
    disc_real: Vec<f64>,
    /// `step/(2 pi) H_1(z) (1 - exp(-z^2))`
    disc_ray: Vec<Complex>,
}

/// Of each order, with zeros behind the last so that whole groups of radii may be read.
#[derive(Clone, Debug)]
struct OrderedWeights {
    length: usize,
    of_order: [Vec<f64>; 4],
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
struct LatticeSamples {
    /// Index m of the first wavenumber.
    first: i32,
    real: Vec<(f64, DepthTransfer<f64>)>,
    ray: Vec<(Complex, DepthTransfer<Complex>)>,
}

impl LatticeSamples {
    /// For responses that start with a power of the wavenumber.
    fn new(response: &DepthResponse, radius: f64, greatest: f64, before: i32, start: i32) -> Self {
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

/// D of some kernels of one order on the lattice; with fewer than four the last places are idle.
struct OrderGroup {
    order: usize,
    /// Quartet and lane of each.
    places: Vec<(usize, usize)>,
    real: Vec<Lanes>,
    /// Real and imaginary part.
    ray: [Vec<Lanes>; 2],
}

/// D of `N` quartets on the lattice.
struct LatticeKernels<const N: usize> {
    first: i32,
    start: i32,
    groups: Vec<OrderGroup>,
}

impl<const N: usize> LatticeKernels<N> {
    /// With the response multiplied by a function of the wavenumber.
    fn new<Q: Quartets<N>>(
        samples: &LatticeSamples,
        real_factor: impl Fn(f64) -> f64,
        ray_factor: impl Fn(Complex) -> Complex,
    ) -> Self {
        let mut groups: Vec<OrderGroup> = (0..4)
            .map(|order| {
                let places = (0..N)
                    .flat_map(|quartet| (0..Q::LIST[quartet].lanes_in_use()).map(move |lane| (quartet, lane)))
                    .filter(|&(quartet, lane)| Q::LIST[quartet].orders()[lane] == order)
                    .collect();
                let ray = [Vec::with_capacity(samples.ray.len()), Vec::with_capacity(samples.ray.len())];
                OrderGroup { order, places, real: Vec::with_capacity(samples.real.len()), ray }
            })
            .filter(|group: &OrderGroup| !group.places.is_empty())
            .collect();
        for (k, transfer) in &samples.real {
            let factor = real_factor(*k);
            let d = Q::LIST.map(|quartet| quartet.lanes(*k, transfer));
            for group in &mut groups {
                let mut lanes = [0.0; 4];
                for (lane, &(quartet, place)) in lanes.iter_mut().zip(&group.places) {
                    *lane = d[quartet][place] * factor;
                }
                group.real.push(lanes);
            }
        }
        for (k, transfer) in &samples.ray {
            let factor = ray_factor(*k);
            let d = Q::LIST.map(|quartet| quartet.lanes(*k, transfer));
            for group in &mut groups {
                let (mut re, mut im) = ([0.0; 4], [0.0; 4]);
                for (lane, &(quartet, place)) in group.places.iter().enumerate() {
                    let value = d[quartet][place] * factor;
                    (re[lane], im[lane]) = (value.re, value.im);
                }
                group.ray[0].push(re);
                group.ray[1].push(im);
            }
        }
        Self { first: samples.first, start: Q::LIST[0].start(), groups }
    }

    /// `r G(r)` of all kernels at `r = radius exp(n step)` for `count` whole numbers n from `first` on.
    fn transformed(&self, first: i32, count: usize) -> Vec<[Lanes; N]> {
        let mut times_r = vec![[[0.0; 4]; N]; count];
        times_r.par_chunks_mut(RADII).with_min_len(2).enumerate().for_each(|(chunk, radii)| {
            let n = first + (chunk * RADII) as i32;
            for group in &self.groups {
                let sums = match group.places.len() {
                    1 => Arch::new().dispatch(RadiiOf::<1> { kernels: group, skipped: self.skipped(n) }),
                    2 => Arch::new().dispatch(RadiiOf::<2> { kernels: group, skipped: self.skipped(n) }),
                    3 => Arch::new().dispatch(RadiiOf::<3> { kernels: group, skipped: self.skipped(n) }),
                    _ => Arch::new().dispatch(RadiiOf::<4> { kernels: group, skipped: self.skipped(n) }),
                };
                for (radius, values) in radii.iter_mut().enumerate() {
                    let below = self.below(group, self.skipped(n) + radius);
                    for (lane, &(quartet, place)) in group.places.iter().enumerate() {
                        values[quartet][place] = sums[lane][radius] + below[lane];
                    }
                }
            }
        });
        times_r
    }

    /// Weights of smaller arguments than that of the first wavenumber.
    fn skipped(&self, n: i32) -> usize {
        (self.first + n - Weights::of_the_method().lowest) as usize
    }

    /// Sum of the terms below the first wavenumber, which fall by powers of x: `J_n` like `x^n`, `H_n (1 - exp(-z^2))` like
    /// `x^(2 - n)`.
    fn below(&self, group: &OrderGroup, skipped: usize) -> Lanes {
        let weights = Weights::of_the_method();
        let order = group.order as i32;
        let falling = |power: i32| 1.0 / libm::expm1(f64::from(power) * weights.step);
        let ray_power = if order == 0 { 3 } else { 3 - order };
        let real = falling(1 + order + self.start) * weights.real.of_order[group.order][skipped];
        let ray = [0, 1].map(|part| {
            falling((ray_power + self.start).max(1)) * weights.ray[part].of_order[group.order][skipped]
        });
        std::array::from_fn(|lane| {
            group.real[0][lane] * real + group.ray[0][0][lane] * ray[0] + group.ray[1][0][lane] * ray[1]
        })
    }

    /// Of the kernels of order 0, `of_lane(group, lane)`; zero for the others.
    fn of_order_0(&self, of_lane: impl Fn(&OrderGroup, usize) -> f64) -> [Lanes; N] {
        let mut values = [[0.0; 4]; N];
        for group in self.groups.iter().filter(|group| group.order == 0) {
            for (lane, &(quartet, place)) in group.places.iter().enumerate() {
                values[quartet][place] = of_lane(group, lane);
            }
        }
        values
    }

    /// Integral over the disc of the lattice's radius, `Int_0^radius G(r) 2 pi r dr`, of the kernels of order 0.
    fn over_disc(&self, radius: f64) -> [Lanes; N] {
        let weights = Weights::of_the_method();
        let skipped = self.skipped(0);
        self.of_order_0(|group, lane| {
            let real: f64 =
                group.real.iter().zip(&weights.disc_real[skipped..]).map(|(d, w)| d[lane] * w).sum();
            let [re, im] = &group.ray;
            let ray: f64 = re
                .iter()
                .zip(im)
                .zip(&weights.disc_ray[skipped..])
                .map(|((re, im), w)| re[lane] * w.re - im[lane] * w.im)
                .sum();
            let below = 1.0 / libm::expm1(f64::from(1 + self.start) * weights.step);
            let w = weights.disc_ray[skipped];
            let first =
                group.real[0][lane] * weights.disc_real[skipped] + re[0][lane] * w.re - im[0][lane] * w.im;
            TAU * (real + ray + first * below) * radius
        })
    }

    /// Values at the centre, `1/(2 pi) Int_0^inf D(k) dk`, of the kernels of order 0; at depth only.
    fn at_centre(&self, samples: &LatticeSamples) -> [Lanes; N] {
        let step = Weights::of_the_method().step;
        let below = 1.0 / libm::expm1(f64::from(1 + self.start) * step);
        self.of_order_0(|group, lane| {
            let terms = || group.real.iter().zip(&samples.real).map(|(d, (k, _))| d[lane] * k);
            let first = terms().next().unwrap_or(0.0);
            (terms().sum::<f64>() + first * below) * step / TAU
        })
    }
}

/// The sums over the lattice of some kernels of one order, for neighbouring radii.
struct RadiiOf<'a, const COUNT: usize> {
    kernels: &'a OrderGroup,
    skipped: usize,
}

impl<const COUNT: usize> WithSimd for RadiiOf<'_, COUNT> {
    type Output = [[f64; RADII]; 4];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [[f64; RADII]; 4] {
        let weights = Weights::of_the_method();
        let OrderGroup { order, real, ray, .. } = self.kernels;
        let mut sums = [[0.0; RADII]; COUNT];
        let parts = [(&weights.real, real), (&weights.ray[0], &ray[0]), (&weights.ray[1], &ray[1])];
        for (weights, values) in parts {
            let weights = &weights.of_order[*order][self.skipped..];
            for (values, weights) in values.iter().zip(weights.windows(RADII)) {
                let Some(weights) = weights.first_chunk::<RADII>() else { continue };
                for kernel in 0..COUNT {
                    for radius in 0..RADII {
                        sums[kernel][radius] =
                            fused::<S>(values[kernel], weights[radius], sums[kernel][radius]);
                    }
                }
            }
        }
        let mut result = [[0.0; RADII]; 4];
        result[..COUNT].copy_from_slice(&sums);
        result
    }
}

/// Lagrange interpolation with the lattice points around a position.
struct Interpolated<'a, const N: usize> {
    lattice: &'a [[Lanes; N]],
    position: f64,
}

impl<const N: usize> WithSimd for Interpolated<'_, N> {
    type Output = [Lanes; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [Lanes; N] {
        let below = self.position.floor();
        let start = below as usize + 1 - REACH;
        let within = self.position - below + (REACH - 1) as f64;
        if within == (REACH - 1) as f64 {
            return self.lattice[start + REACH - 1];
        }
        let mut weights = [0.0; 2 * REACH];
        for j in 0..2 * REACH {
            weights[j] = BARYCENTRIC[j] / (within - j as f64);
        }
        let total: f64 = weights.iter().sum();
        let mut sums = [[0.0; 4]; N];
        for (weight, values) in weights.iter().zip(&self.lattice[start..]) {
            for quartet in 0..N {
                for lane in 0..4 {
                    sums[quartet][lane] = fused::<S>(*weight, values[quartet][lane], sums[quartet][lane]);
                }
            }
        }
        for quartet in 0..N {
            for lane in 0..4 {
                sums[quartet][lane] /= total;
            }
        }
        sums
    }
}

/// The response of one depth on the lattice, from which tables of kernels are made.
pub(crate) struct KernelLattice {
    samples: LatticeSamples,
    /// Least radius of any table \[length\].
    radius: f64,
    margin: i32,
}

impl KernelLattice {
    /// Samples the response for tables from the radius `least` to `greatest`.
    pub(crate) fn new<Q: Quartets<N>, const N: usize>(
        response: &DepthResponse,
        least: f64,
        greatest: f64,
    ) -> Self {
        let step = Weights::of_the_method().step;
        // a panel reaches a quarter octave of the square beyond its ends, the interpolation REACH points further
        let margin = REACH as i32 + 1 + (0.5 * libm::log(1.25) / step).ceil() as i32;
        Self {
            samples: LatticeSamples::new(response, least, greatest, margin, Q::LIST[0].start()),
            radius: least,
            margin,
        }
    }

    /// Kernels of points from the least radius to `greatest`, and their integrals over the disc of the least radius.
    pub(crate) fn points<Q: Quartets<N>, const N: usize>(&self, greatest: f64) -> DepthKernels<N> {
        let lattice = LatticeKernels::new::<Q>(&self.samples, |_| 1.0, |_| Complex::one());
        let panels = self.panels::<Q, N>(&lattice, self.radius, greatest);
        DepthKernels { panels, innermost: lattice.over_disc(self.radius) }
    }

    /// Kernels filtered for the rule of five points on cells of a side, and their values right under the load.
    pub(crate) fn filtered<Q: Quartets<N>, const N: usize>(
        &self,
        least: f64,
        greatest: f64,
        side: f64,
    ) -> DepthKernels<N> {
        let lattice = LatticeKernels::new::<Q>(&self.samples, |k| filter(k * side), |k| filter(k * side));
        let panels = self.panels::<Q, N>(&lattice, least, greatest);
        DepthKernels { panels, innermost: lattice.at_centre(&self.samples) }
    }

    fn panels<Q: Quartets<N>, const N: usize>(
        &self,
        lattice: &LatticeKernels<N>,
        least: f64,
        greatest: f64,
    ) -> DepthPanels<N> {
        let step = Weights::of_the_method().step;
        let position = |r: f64| libm::log(r / self.radius) / step;
        let first = position(least).floor() as i32 - self.margin;
        let last = position(greatest).ceil() as i32 + self.margin;
        let times_r = lattice.transformed(first, (last + 1 - first) as usize);
        DepthPanels::new(least * least, greatest * greatest, |square| {
            let r = square.sqrt();
            let position = position(r) - f64::from(first);
            let mut values = Arch::new().dispatch(Interpolated { lattice: &times_r, position });
            let powers = [r, square, r * square, square * square].map(|power| 1.0 / power);
            for (values, quartet) in values.iter_mut().zip(Q::LIST) {
                for (value, order) in values.iter_mut().zip(quartet.orders()) {
                    *value *= powers[order];
                }
            }
            values
        })
    }
}

/// Kernels at one depth, tabulated in `r^2`, each over `r^n`, n being its Bessel order.
#[derive(Clone, Debug)]
pub(crate) struct DepthKernels<const N: usize> {
    panels: DepthPanels<N>,
    innermost: [Lanes; N],
}

impl<const N: usize> DepthKernels<N> {
    /// The kernels over `r^n` at the square of the distance.
    #[inline(always)]
    pub(crate) fn at_square<S: Simd>(&self, square: f64) -> [Lanes; N] {
        self.panels.at::<S>(square)
    }

    /// What is known right under the load, zero for kernels that are not of order 0: integrals over the disc of
    /// [`KernelLattice::points`], values of [`KernelLattice::filtered`].
    pub(crate) fn innermost(&self) -> [Lanes; N] {
        self.innermost
    }
}
