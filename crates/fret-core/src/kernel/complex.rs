//! Numbers a wavenumber may be: real on the axis, complex on the ray along which Hankel transforms are taken.
//! Nothing here knows mechanics.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::fields::Scalar;

/// A complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// `re + i im`.
    pub(crate) const fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    /// `modulus exp(i angle)`.
    pub(crate) fn polar(modulus: f64, angle: f64) -> Self {
        Self::new(modulus * libm::cos(angle), modulus * libm::sin(angle))
    }

    /// The conjugate.
    pub(crate) const fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// `(sinh z, cosh z)`.
    pub(crate) fn sinh_cosh(self) -> (Self, Self) {
        let (sinh, cosh) = (libm::sinh(self.re), libm::cosh(self.re));
        let (sin, cos) = (libm::sin(self.im), libm::cos(self.im));
        (Self::new(sinh * cos, cosh * sin), Self::new(cosh * cos, sinh * sin))
    }
}

impl Add for Complex {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }
}

impl Div for Complex {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let square = other.re * other.re + other.im * other.im;
        Self::new(
            (self.re * other.re + self.im * other.im) / square,
            (self.im * other.re - self.re * other.im) / square,
        )
    }
}

impl Neg for Complex {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

/// What the layer formulas ask of a wavenumber and of everything computed from it.
pub(crate) trait Wavenumber:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Mul<Self::Constant, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// What constants of layers are beside it: numbers, or numbers with their derivatives.
    type Constant: Scalar;

    /// A real number as one of these.
    fn real(value: f64) -> Self;
    /// A constant as one of these.
    fn constant(value: Self::Constant) -> Self;
    /// Real part.
    fn real_part(self) -> f64;
    /// Absolute value.
    fn modulus(self) -> f64;
    /// Exponential.
    fn exp(self) -> Self;
    /// `exp(z) - 1` without cancellation at small `z`.
    fn exp_m1(self) -> Self;

    /// Zero.
    #[inline]
    fn zero() -> Self {
        Self::real(0.0)
    }

    /// One.
    #[inline]
    fn one() -> Self {
        Self::real(1.0)
    }
}

impl Wavenumber for f64 {
    type Constant = f64;

    #[inline]
    fn real(value: f64) -> Self {
        value
    }
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn real_part(self) -> f64 {
        self
    }
    #[inline]
    fn modulus(self) -> f64 {
        self.abs()
    }
    #[inline]
    fn exp(self) -> Self {
        libm::exp(self)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        libm::expm1(self)
    }
}

impl Wavenumber for Complex {
    type Constant = f64;

    #[inline]
    fn real(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    #[inline]
    fn constant(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    #[inline]
    fn real_part(self) -> f64 {
        self.re
    }
    #[inline]
    fn modulus(self) -> f64 {
        (self.re * self.re + self.im * self.im).sqrt()
    }
    #[inline]
    fn exp(self) -> Self {
        Self::polar(libm::exp(self.re), self.im)
    }
    #[inline]
    fn exp_m1(self) -> Self {
        // exp(a) cos b - 1 = (exp(a) - 1) cos b - 2 sin^2(b/2)
        let half_sine = libm::sin(0.5 * self.im);
        let (growth, sin, cos) = (libm::expm1(self.re), libm::sin(self.im), libm::cos(self.im));
        Self::new(growth * cos - 2.0 * half_sine * half_sine, (growth + 1.0) * sin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_exponentials_keep_their_digits() {
        let z = Complex::new(1e-9, -2e-9);
        let series = z + z * z * 0.5;
        let error = (z.exp_m1() - series).modulus();
        assert!(error < 1e-24); // the next term of the series is 2e-27, a unit in the last place 4e-25
    }

    #[test]
    fn division_undoes_multiplication() {
        let (a, b) = (Complex::new(3.0, -4.0), Complex::new(-0.5, 2.0));
        assert!((a * b / b - a).modulus() < 1e-15); // two roundings
    }
}
