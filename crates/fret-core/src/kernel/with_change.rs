//! A wavenumber's function with its derivative by a constant of a layer: the formulas of layers carry both (dual numbers).

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::complex::Wavenumber;
use crate::fields::Dual;

/// A number of a wavenumber with its derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WithChange<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub change: T,
}

impl<T: Wavenumber> Add for WithChange<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, change: self.change + other.change }
    }
}

impl<T: Wavenumber> Sub for WithChange<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, change: self.change - other.change }
    }
}

impl<T: Wavenumber> Mul for WithChange<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            change: self.value * other.change + self.change * other.value,
        }
    }
}

impl<T: Wavenumber> Mul<f64> for WithChange<T> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, change: self.change * factor }
    }
}

impl<T: Wavenumber> Mul<Dual> for WithChange<T> {
    type Output = Self;
    fn mul(self, factor: Dual) -> Self {
        let change = self.value * factor.change + self.change * factor.value;
        Self { value: self.value * factor.value, change }
    }
}

impl<T: Wavenumber> Div for WithChange<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, change: (self.change - value * other.change) / other.value }
    }
}

impl<T: Wavenumber> Neg for WithChange<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, change: -self.change }
    }
}

impl<T: Wavenumber<Constant = f64>> Wavenumber for WithChange<T> {
    type Constant = Dual;

    fn real(value: f64) -> Self {
        Self { value: T::real(value), change: T::zero() }
    }
    fn constant(value: Dual) -> Self {
        Self { value: T::real(value.value), change: T::real(value.change) }
    }
    fn real_part(self) -> f64 {
        self.value.real_part()
    }
    fn modulus(self) -> f64 {
        self.value.modulus()
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        Self { value, change: value * self.change }
    }
    fn exp_m1(self) -> Self {
        Self { value: self.value.exp_m1(), change: self.value.exp() * self.change }
    }
}
