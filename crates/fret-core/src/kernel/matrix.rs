//! The 2 x 2 matrices of a layer: r along the wavevector, z into the body. Algebra only.

use super::complex::Wavenumber;

/// A symmetric matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Symmetric<T> {
    pub rr: T,
    pub zz: T,
    pub rz: T,
}

impl<T: Wavenumber> Symmetric<T> {
    pub(crate) fn zero() -> Self {
        Self { rr: T::zero(), zz: T::zero(), rz: T::zero() }
    }

    fn combine(self, other: Self, operation: impl Fn(T, T) -> T) -> Self {
        Self {
            rr: operation(self.rr, other.rr),
            zz: operation(self.zz, other.zz),
            rz: operation(self.rz, other.rz),
        }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        self.combine(other, |a, b| a + b)
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.combine(other, |a, b| a - b)
    }

    pub(crate) fn times(self, factor: T) -> Self {
        Self { rr: self.rr * factor, zz: self.zz * factor, rz: self.rz * factor }
    }

    /// Trace of the product with another symmetric matrix.
    pub(crate) fn contracted(self, other: Self) -> T {
        self.rr * other.rr + self.zz * other.zz + self.rz * other.rz * 2.0
    }

    /// `self middle self`.
    pub(crate) fn around(self, middle: Self) -> Self {
        let left = Matrix {
            rr: self.rr * middle.rr + self.rz * middle.rz,
            rz: self.rr * middle.rz + self.rz * middle.zz,
            zr: self.rz * middle.rr + self.zz * middle.rz,
            zz: self.rz * middle.rz + self.zz * middle.zz,
        };
        Self {
            rr: left.rr * self.rr + left.rz * self.rz,
            rz: left.rr * self.rz + left.rz * self.zz,
            zz: left.zr * self.rz + left.zz * self.zz,
        }
    }
}

/// A general matrix: rows are outputs, columns inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Matrix<T> {
    pub rr: T,
    pub rz: T,
    pub zr: T,
    pub zz: T,
}

impl<T: Wavenumber> Matrix<T> {
    /// `self middle`.
    fn of(self, middle: Symmetric<T>) -> Self {
        Self {
            rr: self.rr * middle.rr + self.rz * middle.rz,
            rz: self.rr * middle.rz + self.rz * middle.zz,
            zr: self.zr * middle.rr + self.zz * middle.rz,
            zz: self.zr * middle.rz + self.zz * middle.zz,
        }
    }

    /// `self middle self^T`.
    pub(crate) fn congruent(self, middle: Symmetric<T>) -> Symmetric<T> {
        let left = self.of(middle);
        Symmetric {
            rr: left.rr * self.rr + left.rz * self.rz,
            rz: left.rr * self.zr + left.rz * self.zz,
            zz: left.zr * self.zr + left.zz * self.zz,
        }
    }

    /// `(1 + self) middle (1 + self)^T - middle`, without forming a difference of large numbers.
    pub(crate) fn congruent_m1(self, middle: Symmetric<T>) -> Symmetric<T> {
        let left = self.of(middle);
        Symmetric {
            rr: left.rr * 2.0 + (left.rr * self.rr + left.rz * self.rz),
            rz: left.rz + left.zr + (left.rr * self.zr + left.rz * self.zz),
            zz: left.zz * 2.0 + (left.zr * self.zr + left.zz * self.zz),
        }
    }
}
