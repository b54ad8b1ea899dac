//! A response on the lattice of wavenumbers, from which tables of kernels are made.

use rayon::prelude::*;

use super::complex::{Complex, Wavenumber};
use super::depth_response::{DepthResponse, Transfer};
use super::frequency_response::ResponseTimesK;
use super::hankel_lattice::HankelLattice;
use super::pair_response::PairResponse;
use super::stack_layer::LayerChanges;
use super::with_change::WithChange;
use crate::fields::{Dual, Scalar};
use crate::model::{ContactPair, HalfSpace};

/// What answers a traction wave by its wavenumber alone, at some depth.
pub(crate) trait WaveResponse: Sync {
    /// The answer at a wavenumber.
    fn transfer<T: Wavenumber<Constant = f64>>(&self, k: T) -> Transfer<T>;
    /// The answer at any wavenumber, where it does not depend on it.
    fn constant(&self) -> Option<Transfer<f64>> {
        None
    }
    /// Longest length in the bodies: far beyond it the answer is that of a homogeneous one.
    fn longest_length(&self) -> f64;
    /// Depth of the point, 0 at the surface \[length\].
    fn depth(&self) -> f64;
}

impl WaveResponse for DepthResponse {
    fn transfer<T: Wavenumber<Constant = f64>>(&self, k: T) -> Transfer<T> {
        self.at(k)
    }

    fn longest_length(&self) -> f64 {
        Self::longest_length(self)
    }

    fn depth(&self) -> f64 {
        Self::depth(self)
    }
}

/// What stands below a point of one body under tractions on its surface: the response itself, or how it changes with a parameter.
pub(crate) trait BelowSurface: WaveResponse {
    /// Under uniform tractions whose period is held: stress along the surface by pressure, and what arrives of the tractions.
    fn under_uniform(&self) -> [f64; 2];
}

impl BelowSurface for DepthResponse {
    fn under_uniform(&self) -> [f64; 2] {
        let nu = self.poisson();
        [-nu / (1.0 - nu), 1.0]
    }
}

/// How the response at a depth changes with a parameter: one more response, to which every linear rule applies as to the first.
pub(crate) struct DepthChange(DepthResponse<Dual>);

impl DepthChange {
    /// Of a half-space seen from a layer at a depth with its derivative, by the derivatives of the constants of the layers, from the surface
    /// down, those of the base last.
    pub(crate) fn new(half_space: &HalfSpace, changes: &[LayerChanges], at: (usize, Dual)) -> Self {
        Self(DepthResponse::with_changes(half_space, changes, at))
    }
}

impl WaveResponse for DepthChange {
    fn transfer<T: Wavenumber<Constant = f64>>(&self, k: T) -> Transfer<T> {
        let of = self.0.at(WithChange { value: k, change: T::zero() });
        let pair = |pair: [WithChange<T>; 2]| pair.map(|of| of.change);
        Transfer {
            normal: pair(of.normal),
            shear: pair(of.shear),
            along: pair(of.along),
            across: pair(of.across),
            tangential: pair(of.tangential),
            depthwise: pair(of.depthwise),
            twist_shear: of.twist_shear.change,
            in_plane_shear: of.in_plane_shear.change,
            sideways: of.sideways.change,
        }
    }

    fn longest_length(&self) -> f64 {
        self.0.longest_length()
    }

    fn depth(&self) -> f64 {
        self.0.depth()
    }
}

impl BelowSurface for DepthChange {
    fn under_uniform(&self) -> [f64; 2] {
        let nu = self.0.poisson();
        [(-nu / (Dual::of(1.0) - nu)).change, 0.0]
    }
}

/// The surfaces of two bodies, lower minus upper: displacements alone.
impl WaveResponse for PairResponse {
    fn transfer<T: Wavenumber<Constant = f64>>(&self, k: T) -> Transfer<T> {
        of_surface(self.times_wavenumber(k))
    }

    fn constant(&self) -> Option<Transfer<f64>> {
        Self::constant(self).map(|_| self.transfer(1.0))
    }

    fn longest_length(&self) -> f64 {
        Self::longest_length(self)
    }

    fn depth(&self) -> f64 {
        0.0
    }
}

/// Displacements of the surface alone.
fn of_surface<T: Wavenumber>(ResponseTimesK { zz, rr, rz, tt }: ResponseTimesK<T>) -> Transfer<T> {
    let zero = T::zero();
    Transfer {
        normal: [zero; 2],
        shear: [zero; 2],
        along: [zero; 2],
        across: [zero; 2],
        tangential: [rr, rz],
        depthwise: [rz, zz],
        twist_shear: zero,
        in_plane_shear: zero,
        sideways: tt,
    }
}

/// How the response of a pair changes with a parameter: one more response, to which every linear rule applies as to the pair's own.
#[derive(Debug, Clone)]
pub struct ResponseChange(PairResponse<Dual>);

impl ResponseChange {
    /// Of a pair, by the derivatives of the constants of the layers of its lower and of its upper body, from the surface down, those of the
    /// substrate last.
    pub fn new(pair: &ContactPair, changes: [&[LayerChanges]; 2]) -> Self {
        Self(PairResponse::with_changes(pair, changes))
    }

    /// Whether it does not depend on the wavenumber.
    pub(crate) fn is_homogeneous(&self) -> bool {
        self.0.is_homogeneous()
    }

    /// Derivative of `k C(k)` at a wavenumber.
    pub(crate) fn times_wavenumber<T: Wavenumber<Constant = f64>>(&self, k: T) -> ResponseTimesK<T> {
        let found = self.0.times_wavenumber(WithChange { value: k, change: T::zero() });
        let ResponseTimesK { zz, rr, rz, tt } = found;
        ResponseTimesK { zz: zz.change, rr: rr.change, rz: rz.change, tt: tt.change }
    }
}

impl WaveResponse for ResponseChange {
    fn transfer<T: Wavenumber<Constant = f64>>(&self, k: T) -> Transfer<T> {
        of_surface(self.times_wavenumber(k))
    }

    fn constant(&self) -> Option<Transfer<f64>> {
        self.0.is_homogeneous().then(|| self.transfer(1.0))
    }

    fn longest_length(&self) -> f64 {
        self.0.longest_length()
    }

    fn depth(&self) -> f64 {
        0.0
    }
}

/// A response on the lattice of wavenumbers `exp(m step)/radius`, on the axis and on the ray.
pub(super) struct LatticeSamples<'a> {
    pub lattice: &'a HankelLattice,
    /// Index m of the first wavenumber.
    pub first: i32,
    pub real: Vec<(f64, Transfer<f64>)>,
    pub ray: Vec<(Complex, Transfer<Complex>)>,
}

impl<'a> LatticeSamples<'a> {
    /// Of a response whose kernels start with a power of the wavenumber, for radii from `radius exp(-before step)` to `greatest`.
    pub(super) fn new(
        lattice: &'a HankelLattice,
        response: &impl WaveResponse,
        [radius, greatest]: [f64; 2],
        before: i32,
        start: i32,
    ) -> Self {
        let longest = greatest.max(response.longest_length());
        // below, D is its first power but for a fraction as small as the argument
        let least = if start > 0 { 1e-7 } else { 1e-8 };
        let first = (libm::log(least * (radius / longest)) / lattice.step).floor() as i32;
        let first = first.max(lattice.lowest + before);
        // beyond 100 over the depth nothing arrives: exp(-96) on the ray
        let last = if response.depth() > 0.0 {
            (libm::log(100.0 * (radius / response.depth())) / lattice.step).ceil() as i32
        } else {
            i32::MAX
        };
        let wavenumber = |m: i32| libm::exp(f64::from(m) * lattice.step) / radius;
        let direction = Complex::polar(1.0, lattice.angle);
        let end = |of_lattice: i32| (of_lattice + before + 1).min(last).max(first + 1);
        let real = (first..end(lattice.last_real()))
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let k = wavenumber(m);
                (k, response.transfer(k))
            })
            .collect();
        let ray = (first..end(lattice.last_ray()))
            .into_par_iter()
            .with_min_len(32)
            .map(|m| {
                let k = direction * wavenumber(m);
                (k, response.transfer(k))
            })
            .collect();
        Self { lattice, first, real, ray }
    }
}
