//! Numbers with their derivatives by several others at once: what a law of a cell is linearised with, all its slopes in one evaluation.

use std::ops::{Add, Div, Mul, Sub};

use super::registers::Reals;
use super::scalar::Scalar;

/// A number with its derivatives by `N` others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes<const N: usize> {
    /// The number.
    pub value: f64,
    /// Its derivatives.
    pub by: [f64; N],
}

impl<const N: usize> Slopes<N> {
    /// The numbers that derivatives are taken by.
    pub fn of_each(values: [f64; N]) -> [Self; N] {
        std::array::from_fn(|number| {
            let mut by = [0.0; N];
            by[number] = 1.0;
            Self { value: values[number], by }
        })
    }

    /// A function of two numbers with its value and slopes.
    #[inline(always)]
    fn of_two(self, other: Self, value: f64, [own, others]: [f64; 2]) -> Self {
        Self { value, by: std::array::from_fn(|k| own * self.by[k] + others * other.by[k]) }
    }

    /// A function of one number with its value and slope.
    #[inline(always)]
    fn of_one(self, value: f64, slope: f64) -> Self {
        Self { value, by: self.by.map(|by| slope * by) }
    }
}

impl<const N: usize> Add for Slopes<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.of_two(other, self.value + other.value, [1.0, 1.0])
    }
}

impl<const N: usize> Sub for Slopes<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.of_two(other, self.value - other.value, [1.0, -1.0])
    }
}

impl<const N: usize> Mul for Slopes<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.of_two(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Slopes<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.of_two(other, value, [1.0 / other.value, -value / other.value])
    }
}

impl<const N: usize> Add<f64> for Slopes<N> {
    type Output = Self;
    fn add(self, number: f64) -> Self {
        self.of_one(self.value + number, 1.0)
    }
}

impl<const N: usize> Sub<f64> for Slopes<N> {
    type Output = Self;
    fn sub(self, number: f64) -> Self {
        self.of_one(self.value - number, 1.0)
    }
}

impl<const N: usize> Mul<f64> for Slopes<N> {
    type Output = Self;
    fn mul(self, number: f64) -> Self {
        self.of_one(self.value * number, number)
    }
}

impl<const N: usize> Div<f64> for Slopes<N> {
    type Output = Self;
    fn div(self, number: f64) -> Self {
        self.of_one(self.value / number, 1.0 / number)
    }
}

impl<const N: usize> Reals for Slopes<N> {
    /// Of nothing the derivatives are taken for none: the laws meet it at the length of a vector that vanishes, where there are no others.
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.of_one(root, if root > 0.0 { 0.5 / root } else { 0.0 })
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

impl<const N: usize> Scalar for Slopes<N> {
    fn of(value: f64) -> Self {
        Self { value, by: [0.0; N] }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn mapped(self, value: f64, slope: f64) -> Self {
        // Of what does not change nothing changes, however steep the function.
        Self { value, by: self.by.map(|by| if by == 0.0 { 0.0 } else { slope * by }) }
    }
    fn angle_to(self, along: Self) -> Self {
        let square = self.value * self.value + along.value * along.value;
        let slopes = if square > 0.0 { [along.value / square, -self.value / square] } else { [0.0; 2] };
        self.of_two(along, self.value.atan2(along.value), slopes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function of two numbers against the differences of its own values, at places where it is smooth. 1e-9: rounding of differences of 1e-6.
    #[test]
    fn slopes_are_those_of_the_values() {
        let functions: [fn(Slopes<2>, Slopes<2>) -> Slopes<2>; 9] = [
            |x, y| x * y + x * 3.0 - y / 7.0 + 1.0,
            |x, y| (x + 2.0) / (y * x + 1.0),
            |x, y| Reals::sqrt(x * x + y + 0.5),
            |x, y| Scalar::cube_root(x * y),
            |x, y| (x + y).power(1.5),
            |x, y| (x - y * 5.0).size(),
            |x, y| x.sine() * y.cosine(),
            |x, y| x.angle_to(y * x + 0.3),
            |x, y| x.max(y - 9.0) * y.min(Slopes::of(9.0)) - x.if_at_most(y, x, y),
        ];
        for (number, function) in functions.iter().enumerate() {
            for [x, y] in [[0.3, 1.0], [1.1, 0.4], [2.7, 2.9]] {
                let at = |x: f64, y: f64| {
                    let [x, y] = Slopes::of_each([x, y]);
                    function(x, y)
                };
                let found = at(x, y).by;
                let expected = [
                    (at(x + 1e-6, y).value - at(x - 1e-6, y).value) / 2e-6,
                    (at(x, y + 1e-6).value - at(x, y - 1e-6).value) / 2e-6,
                ];
                for (found, expected) in found.into_iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{number} {x} {y}");
                }
            }
        }
    }
}
