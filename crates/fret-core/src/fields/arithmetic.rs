//! Fields on the cells of a box as flat rows, index `i * ny + j`: sums and inner products in a fixed order.

use super::each_cell::{CellRule, CellSize, each_cell, largest_of};
use super::registers::{Number, Reals};

/// Sum of a field.
pub fn sum<N: Number>(a: &[N]) -> f64 {
    let [total] = each_cell(&Sum, [a], []);
    total
}

struct Sum;

impl CellRule<1, 0, 1> for Sum {
    #[inline(always)]
    fn at<R: Reals>(&self, [a]: [R; 1], _: &mut [R; 0]) -> [R; 1] {
        [a]
    }
}

/// Inner product of two fields.
pub fn dot<N: Number>(a: &[N], b: &[N]) -> f64 {
    let [total] = each_cell(&Dot, [a, b], []);
    total
}

struct Dot;

impl CellRule<2, 0, 1> for Dot {
    #[inline(always)]
    fn at<R: Reals>(&self, [a, b]: [R; 2], _: &mut [R; 0]) -> [R; 1] {
        [a * b]
    }
}

/// The power of two nearest below a size; one where there is none.
pub fn unit_of(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { size.log2().floor().exp2() } else { 1.0 }
}

/// Euclidean norm of a field.
pub fn norm<N: Number>(a: &[N]) -> f64 {
    dot(a, a).sqrt()
}

/// `y += factor x`.
pub fn add_scaled<N: Number>(y: &mut [N], factor: f64, x: &[N]) {
    each_cell(&AddScaled(factor), [x], [y]);
}

struct AddScaled(f64);

impl CellRule<1, 1, 0> for AddScaled {
    #[inline(always)]
    fn at<R: Reals>(&self, [x]: [R; 1], [y]: &mut [R; 1]) -> [R; 0] {
        *y = *y + x * self.0;
        []
    }
}

/// `y -= number`.
pub fn lower<N: Number>(y: &mut [N], number: f64) {
    each_cell(&Lower(number), [], [y]);
}

struct Lower(f64);

impl CellRule<0, 1, 0> for Lower {
    #[inline(always)]
    fn at<R: Reals>(&self, _: [R; 0], [y]: &mut [R; 1]) -> [R; 0] {
        *y = *y - self.0;
        []
    }
}

/// Multiplies a field by a number.
pub fn scale<N: Number>(a: &mut [N], factor: f64) {
    each_cell(&Scale(factor), [], [a]);
}

struct Scale(f64);

impl CellRule<0, 1, 0> for Scale {
    #[inline(always)]
    fn at<R: Reals>(&self, _: [R; 0], [a]: &mut [R; 1]) -> [R; 0] {
        *a = *a * self.0;
        []
    }
}

/// Largest value of a field of numbers, 0 for an empty or negative one.
pub fn largest(a: &[f64]) -> f64 {
    largest_of(&Value, [a])
}

struct Value;

impl CellSize<1> for Value {
    #[inline(always)]
    fn of<R: Reals>(&self, [a]: [R; 1]) -> R {
        a
    }
}
