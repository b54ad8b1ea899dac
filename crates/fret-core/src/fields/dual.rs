//! Dual numbers: a number and its derivative by a parameter, carried through every operation (forward differentiation).

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::registers::Reals;
use super::scalar::Scalar;

/// A number with its derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub change: f64,
}

impl Dual {
    /// A number with a derivative.
    pub const fn new(value: f64, change: f64) -> Self {
        Self { value, change }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.change + other.change)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.change - other.change)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.value * other.value, self.value * other.change + self.change * other.value)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(value, (self.change - value * other.change) / other.value)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.change)
    }
}

impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, number: f64) -> Self {
        Self::new(self.value + number, self.change)
    }
}

impl Sub<f64> for Dual {
    type Output = Self;
    fn sub(self, number: f64) -> Self {
        Self::new(self.value - number, self.change)
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, number: f64) -> Self {
        Self::new(self.value * number, self.change * number)
    }
}

impl Div<f64> for Dual {
    type Output = Self;
    fn div(self, number: f64) -> Self {
        Self::new(self.value / number, self.change / number)
    }
}

impl Reals for Dual {
    /// Of nothing the derivative is taken for none: the laws meet it at the length of a vector that vanishes, where there is no other.
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::new(root, if root > 0.0 { self.change / (2.0 * root) } else { 0.0 })
    }
    fn max(self, other: Self) -> Self {
        if self.value >= other.value { self } else { other }
    }
    fn min(self, other: Self) -> Self {
        if self.value <= other.value { self } else { other }
    }
    fn if_at_most(self, bound: Self, yes: Self, no: Self) -> Self {
        if self.value <= bound.value { yes } else { no }
    }
    fn all(self, number: f64) -> Self {
        Self::of(number)
    }
}

impl Scalar for Dual {
    fn of(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    fn value(self) -> f64 {
        self.value
    }
    fn mapped(self, value: f64, slope: f64) -> Self {
        Self::new(value, if self.change == 0.0 { 0.0 } else { slope * self.change })
    }
    fn angle_to(self, along: Self) -> Self {
        let square = self.value * self.value + along.value * along.value;
        let across = self.change * along.value - self.value * along.change;
        Self::new(self.value.atan2(along.value), if square > 0.0 { across / square } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function against the differences of its own values, at places where it is smooth. 1e-9: rounding of differences of 1e-6.
    #[test]
    fn derivatives_are_those_of_the_values() {
        let functions: [fn(Dual) -> Dual; 9] = [
            |x| x * x + x * 3.0 - x / 7.0 + 1.0,
            |x| (x + 2.0) / (x * x + 1.0),
            |x| Reals::sqrt(x * x + 0.5),
            Scalar::cube_root,
            |x| x.power(1.5),
            |x| (x - 5.0).size(),
            |x| x.sine() * x.cosine(),
            |x| x.angle_to(x * x + 0.3),
            |x| x.max(Dual::of(0.2)) * x.min(Dual::of(9.0)) - (-x),
        ];
        for (number, function) in functions.iter().enumerate() {
            for x in [0.3, 1.1, 2.7] {
                let found = function(Dual::new(x, 1.0)).change;
                let at = |x: f64| function(Dual::of(x)).value;
                let expected = (at(x + 1e-6) - at(x - 1e-6)) / 2e-6;
                assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{number} {x}");
            }
        }
    }
}
