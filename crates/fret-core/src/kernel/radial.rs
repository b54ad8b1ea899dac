//! The radial kernels of a point at any depth, the surface among them: displacement and stress at horizontal distance r from a point
//! force on the surface.
//!
//! ```text
//! r G_q(r) = 1/(2 pi) Int_0^inf D_q(x/r) J_n(x) dx        displacement: D = k U(k)        stress: D = k S(k)
//!
//! of the surface:
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
//! analytic in `log x`, so the trapezoidal rule converges geometrically, whatever the thickness, the contrast, the base and the depth.
//! At depth 0 the part of a stress that is concentrated in the loaded point is in the integral over the disc around it.
//!
//! Kernels of one order share their weights, so that a few sums over the lattice run side by side, for sixteen radii at a time.

use std::f64::consts::TAU;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::complex::{Complex, Wavenumber};
use super::far_cells::filter;
use super::hankel_lattice::{HankelLattice, OrderedWeights, RADII};
use super::interpolation::{REACH, lagrange};
use super::lattice_samples::{LatticeSamples, WaveResponse};
use super::panels::{Lanes, Panels, fused};
use super::quartets::Quartets;

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
struct LatticeKernels<'a, const N: usize> {
    lattice: &'a HankelLattice,
    first: i32,
    start: i32,
    groups: Vec<OrderGroup>,
}

impl<'a, const N: usize> LatticeKernels<'a, N> {
    /// With the response multiplied by a function of the wavenumber.
    fn new<Q: Quartets<N>>(
        samples: &LatticeSamples<'a>,
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
        Self { lattice: samples.lattice, first: samples.first, start: Q::LIST[0].start(), groups }
    }

    /// `r G(r)` of all kernels at `r = radius exp(n step)` for `count` whole numbers n from `first` on.
    fn transformed(&self, first: i32, count: usize) -> Vec<[Lanes; N]> {
        let mut times_r = vec![[[0.0; 4]; N]; count];
        times_r.par_chunks_mut(RADII).with_min_len(2).enumerate().for_each(|(chunk, radii)| {
            let n = first + (chunk * RADII) as i32;
            for group in &self.groups {
                let (lattice, skipped) = (self.lattice, self.skipped(n));
                let sums = match group.places.len() {
                    1 => Arch::new().dispatch(RadiiOf::<1> { lattice, kernels: group, skipped }),
                    2 => Arch::new().dispatch(RadiiOf::<2> { lattice, kernels: group, skipped }),
                    3 => Arch::new().dispatch(RadiiOf::<3> { lattice, kernels: group, skipped }),
                    _ => Arch::new().dispatch(RadiiOf::<4> { lattice, kernels: group, skipped }),
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
        (self.first + n - self.lattice.lowest) as usize
    }

    /// Sum of the terms below the first wavenumber, which fall by powers of x: `J_n` like `x^n`, `H_n (1 - exp(-z^2))` like
    /// `x^(2 - n)`.
    fn below(&self, group: &OrderGroup, skipped: usize) -> Lanes {
        let weights = self.lattice;
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
        let weights = self.lattice;
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
    fn at_centre(&self, samples: &LatticeSamples<'_>) -> [Lanes; N] {
        let step = self.lattice.step;
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
    lattice: &'a HankelLattice,
    kernels: &'a OrderGroup,
    skipped: usize,
}

impl<'a, const COUNT: usize> WithSimd for RadiiOf<'a, COUNT> {
    type Output = [[f64; RADII]; 4];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [[f64; RADII]; 4] {
        let Self { lattice, kernels: OrderGroup { order, real, ray, .. }, skipped } = self;
        let of_radii = |weights: &'a OrderedWeights| weights.of_order[*order][skipped..].windows(RADII);
        let mut on_axis = [[0.0; RADII]; COUNT];
        for (values, weights) in real.iter().zip(of_radii(&lattice.real)) {
            let Some(weights) = weights.first_chunk::<RADII>() else { continue };
            for kernel in 0..COUNT {
                for radius in 0..RADII {
                    on_axis[kernel][radius] =
                        fused::<S>(values[kernel], weights[radius], on_axis[kernel][radius]);
                }
            }
        }
        // both parts of a term first: they cancel in part
        let mut on_ray = [[0.0; RADII]; COUNT];
        let weights = of_radii(&lattice.ray[0]).zip(of_radii(&lattice.ray[1]));
        for ((re, im), (for_re, for_im)) in ray[0].iter().zip(&ray[1]).zip(weights) {
            let (Some(for_re), Some(for_im)) = (for_re.first_chunk::<RADII>(), for_im.first_chunk::<RADII>())
            else {
                continue;
            };
            for kernel in 0..COUNT {
                for radius in 0..RADII {
                    let term = fused::<S>(re[kernel], for_re[radius], im[kernel] * for_im[radius]);
                    on_ray[kernel][radius] += term;
                }
            }
        }
        let mut result = [[0.0; RADII]; 4];
        for kernel in 0..COUNT {
            for radius in 0..RADII {
                result[kernel][radius] = on_axis[kernel][radius] + on_ray[kernel][radius];
            }
        }
        result
    }
}

/// Lagrange interpolation with the lattice points around a position.
struct Interpolated<'a, const N: usize> {
    points: &'a [[Lanes; N]],
    position: f64,
}

impl<const N: usize> WithSimd for Interpolated<'_, N> {
    type Output = [Lanes; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [Lanes; N] {
        let (start, weights) = lagrange(self.position);
        let mut sums = [[0.0; 4]; N];
        for (weight, values) in weights.iter().zip(&self.points[start..]) {
            for quartet in 0..N {
                for lane in 0..4 {
                    sums[quartet][lane] = fused::<S>(*weight, values[quartet][lane], sums[quartet][lane]);
                }
            }
        }
        sums
    }
}

/// What tables of kernels are made from.
pub(super) trait KernelSource<Q: Quartets<N>, const N: usize> {
    /// Kernels of points from the least radius to `greatest`, and their integrals over the disc of the least radius.
    fn points(&self, greatest: f64) -> RadialKernels<N>;

    /// Kernels filtered for the rule of five points on cells of a side, and their values right under the load.
    fn filtered(&self, least: f64, greatest: f64, side: f64) -> RadialKernels<N>;
}

/// A response on the lattice, from which tables of kernels are made.
pub(crate) struct KernelLattice<'a> {
    samples: LatticeSamples<'a>,
    /// Least radius of any table \[length\].
    radius: f64,
    margin: i32,
}

impl KernelLattice<'static> {
    /// Samples the response for tables from the radius `least` to `greatest`.
    pub(crate) fn new<Q: Quartets<N>, const N: usize>(
        response: &impl WaveResponse,
        least: f64,
        greatest: f64,
    ) -> Self {
        KernelLattice::on::<Q, N>(HankelLattice::standard(), response, least, greatest)
    }
}

impl<'a> KernelLattice<'a> {
    /// The same on the given lattice.
    fn on<Q: Quartets<N>, const N: usize>(
        lattice: &'a HankelLattice,
        response: &impl WaveResponse,
        least: f64,
        greatest: f64,
    ) -> Self {
        let (step, start) = (lattice.step, Q::LIST[0].start());
        // a panel reaches a quarter octave of the square beyond its ends, the interpolation REACH points further
        let margin = REACH as i32 + 1 + (0.5 * libm::log(1.25) / step).ceil() as i32;
        Self {
            samples: LatticeSamples::new(lattice, response, [least, greatest], margin, start),
            radius: least,
            margin,
        }
    }

    fn panels<Q: Quartets<N>, const N: usize>(
        &self,
        lattice: &LatticeKernels<'_, N>,
        least: f64,
        greatest: f64,
    ) -> Panels<N> {
        let step = lattice.lattice.step;
        let position = |r: f64| libm::log(r / self.radius) / step;
        let first = position(least).floor() as i32 - self.margin;
        let last = position(greatest).ceil() as i32 + self.margin;
        let times_r = lattice.transformed(first, (last + 1 - first) as usize);
        Panels::new(least * least, greatest * greatest, |square| {
            let r = square.sqrt();
            let position = position(r) - f64::from(first);
            let mut values = Arch::new().dispatch(Interpolated { points: &times_r, position });
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

impl<Q: Quartets<N>, const N: usize> KernelSource<Q, N> for KernelLattice<'_> {
    fn points(&self, greatest: f64) -> RadialKernels<N> {
        let lattice = LatticeKernels::new::<Q>(&self.samples, |_| 1.0, |_| Complex::one());
        let panels = self.panels::<Q, N>(&lattice, self.radius, greatest);
        RadialKernels { panels, innermost: lattice.over_disc(self.radius) }
    }

    fn filtered(&self, least: f64, greatest: f64, side: f64) -> RadialKernels<N> {
        let lattice = LatticeKernels::new::<Q>(&self.samples, |k| filter(k * side), |k| filter(k * side));
        let panels = self.panels::<Q, N>(&lattice, least, greatest);
        RadialKernels { panels, innermost: lattice.at_centre(&self.samples) }
    }
}

/// Radial kernels, tabulated in `r^2` so that cells need no root and no angle, each over `r^n`, n being its Bessel order.
#[derive(Clone, Debug)]
pub(crate) struct RadialKernels<const N: usize> {
    panels: Panels<N>,
    innermost: [Lanes; N],
}

impl<const N: usize> RadialKernels<N> {
    /// Of a table and what is known right under the load.
    pub(super) fn new(panels: Panels<N>, innermost: [Lanes; N]) -> Self {
        Self { panels, innermost }
    }

    /// The kernels over `r^n` at the square of the distance.
    #[inline(always)]
    pub(crate) fn at_square<S: Simd>(&self, square: f64) -> [Lanes; N] {
        self.panels.at::<S>(square)
    }

    /// What is known right under the load, zero for kernels that are not of order 0: integrals over the disc of
    /// [`KernelSource::points`], values of [`KernelSource::filtered`].
    pub(crate) fn innermost(&self) -> [Lanes; N] {
        self.innermost
    }
}

#[cfg(test)]
mod tests;
