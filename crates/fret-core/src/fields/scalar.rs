//! Single numbers that a law of a cell can be written for once: a number, or one that carries its derivative.

use super::registers::Reals;

/// A number with the functions of the laws that are not made for whole registers. Comparisons are those of its value.
pub trait Scalar: Reals {
    /// A number that depends on nothing.
    #[must_use]
    fn of(value: f64) -> Self;
    /// Its value.
    fn value(self) -> f64;
    /// The same with another value and a derivative that is `slope` times its own: a smooth function of it.
    #[must_use]
    fn mapped(self, value: f64, slope: f64) -> Self;

    /// Cube root.
    #[must_use]
    fn cube_root(self) -> Self {
        let root = self.value().cbrt();
        self.mapped(root, 1.0 / (3.0 * root * root))
    }

    /// A power.
    #[must_use]
    fn power(self, exponent: f64) -> Self {
        let value = self.value();
        let slope = if value == 0.0 && exponent > 1.0 { 0.0 } else { exponent * value.powf(exponent - 1.0) };
        self.mapped(value.powf(exponent), slope)
    }

    /// Absolute value.
    #[must_use]
    fn size(self) -> Self {
        self.mapped(self.value().abs(), if self.value() < 0.0 { -1.0 } else { 1.0 })
    }

    /// Sine.
    #[must_use]
    fn sine(self) -> Self {
        self.mapped(self.value().sin(), self.value().cos())
    }

    /// Cosine.
    #[must_use]
    fn cosine(self) -> Self {
        self.mapped(self.value().cos(), -self.value().sin())
    }

    /// Angle of the vector `(along, self)`.
    #[must_use]
    fn angle_to(self, along: Self) -> Self;
}

/// Length of a tangential vector.
#[inline(always)]
pub fn length_of<R: Scalar>([x, y]: [R; 2]) -> R {
    (x * x + y * y).sqrt()
}

impl Reals for f64 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::min(self, other)
    }
    #[inline(always)]
    fn if_at_most(self, bound: Self, yes: Self, no: Self) -> Self {
        if self <= bound { yes } else { no }
    }
    #[inline(always)]
    fn all(self, number: f64) -> Self {
        number
    }
}

impl Scalar for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn mapped(self, value: f64, _: f64) -> Self {
        value
    }
    fn angle_to(self, along: Self) -> Self {
        self.atan2(along)
    }
}
