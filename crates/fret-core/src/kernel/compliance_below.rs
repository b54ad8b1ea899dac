//! What lies below a cut through a stack: its compliance, and how tractions descend to it.

use super::complex::Wavenumber;
use super::layer_constants::LayerConstants;
use super::matrix::{Matrix, Symmetric};
use crate::fields::Scalar;

/// Compliance of everything below a cut, times k [1/pressure]: `w = (k C) t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compliance<T> {
    /// In the plane of wavevector and depth.
    pub in_plane: Symmetric<T>,
    /// Determinant of `in_plane`, carried along because `rr zz - rz^2` would cancel.
    pub determinant: T,
    /// Across that plane.
    pub tt: T,
}

impl<T: Wavenumber> Compliance<T> {
    /// Compliance of a rigid base.
    pub(crate) fn rigid() -> Self {
        Self { in_plane: Symmetric::zero(), determinant: T::zero(), tt: T::zero() }
    }
}

impl<C: Scalar> LayerConstants<C> {
    /// `k C` of the half-space of this material.
    pub(crate) fn half_space<T: Wavenumber<Constant = C>>(&self) -> Compliance<T> {
        let c0 = T::constant(self.c0);
        Compliance {
            in_plane: Symmetric { rr: c0, zz: c0, rz: T::constant(self.c0 * self.g) },
            determinant: T::constant(self.c0 * self.c0 * self.one_minus_g2),
            tt: T::constant(C::of(1.0) / self.mu),
        }
    }
}

/// Traction at one depth per traction at a lesser one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent<T> {
    /// In the plane of wavevector and depth.
    pub in_plane: Matrix<T>,
    /// Across that plane.
    pub across: T,
}

impl<T: Wavenumber> Descent<T> {
    /// No way down.
    pub(crate) fn none() -> Self {
        let (one, zero) = (T::one(), T::zero());
        Self { in_plane: Matrix { rr: one, rz: zero, zr: zero, zz: one }, across: one }
    }

    /// Nothing arrives.
    pub(crate) fn opaque() -> Self {
        let zero = T::zero();
        Self { in_plane: Matrix { rr: zero, rz: zero, zr: zero, zz: zero }, across: zero }
    }

    /// First `first`, then this one.
    pub(crate) fn after(self, first: Self) -> Self {
        let (a, b) = (self.in_plane, first.in_plane);
        Self {
            in_plane: Matrix {
                rr: a.rr * b.rr + a.rz * b.zr,
                rz: a.rr * b.rz + a.rz * b.zz,
                zr: a.zr * b.rr + a.zz * b.zr,
                zz: a.zr * b.rz + a.zz * b.zz,
            },
            across: self.across * first.across,
        }
    }
}
