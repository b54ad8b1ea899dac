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

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::complex::{Complex, Wavenumber};
use super::depth_lattice::{LatticeSamples, RADII, Weights};
use super::depth_panels::{DepthPanels, Lanes, fused};
use super::depth_quartets::Quartets;
use super::depth_response::DepthResponse;
use super::far_cells::filter;
use super::radial::{BARYCENTRIC, REACH};

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
