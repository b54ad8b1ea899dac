//! Fields on the cells of a box as flat rows, index `i * ny + j`: sums and inner products in a fixed order.

use pulp::Arch;
use serde::{Deserialize, Serialize};

use super::each_cell::{CellRule, Number, Reals, each_cell};
use super::stored;

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

/// Euclidean norm of a field.
pub fn norm<N: Number>(a: &[N]) -> f64 {
    dot(a, a).sqrt()
}

/// `y += factor x`.
pub fn add_scaled<N: Number>(y: &mut [N], factor: f64, x: &[N]) {
    each_cell(&AddScaled(factor), [x], [y]);
}

/// `y += factor x`, with `x` of any precision.
pub fn add_converted<N: Number>(y: &mut [f64], factor: f64, x: &[N]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for (y, x) in y.iter_mut().zip(x) {
                *y += x.to_double(factor);
            }
        },
    );
}

/// `to = x + factor y`, with `y` of any precision.
pub fn added_converted<N: Number>(x: &[f64], factor: f64, y: &[N], to: &mut [f64]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for ((to, x), y) in to.iter_mut().zip(x).zip(y) {
                *to = x + y.to_double(factor);
            }
        },
    );
}

/// `to = factor (a - b)`, in any precision.
pub fn difference<N: Number>(a: &[f64], b: &[f64], factor: f64, to: &mut [N]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
                *to = N::of(a - b, factor);
            }
        },
    );
}

struct AddScaled(f64);

impl CellRule<1, 1, 0> for AddScaled {
    #[inline(always)]
    fn at<R: Reals>(&self, [x]: [R; 1], [y]: &mut [R; 1]) -> [R; 0] {
        *y = *y + x * self.0;
        []
    }
}

/// `y = x + factor y`.
pub fn scale_and_add<N: Number>(y: &mut [N], factor: f64, x: &[N]) {
    each_cell(&ScaleAndAdd(factor), [x], [y]);
}

struct ScaleAndAdd(f64);

impl CellRule<1, 1, 0> for ScaleAndAdd {
    #[inline(always)]
    fn at<R: Reals>(&self, [x]: [R; 1], [y]: &mut [R; 1]) -> [R; 0] {
        *y = x + *y * self.0;
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

/// Largest value of a field, 0 for an empty or negative one.
pub fn largest(a: &[f64]) -> f64 {
    a.iter().copied().fold(0.0, f64::max)
}

/// A tangential field: x and y components.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TangentialField {
    /// Component along x.
    #[serde(with = "stored")]
    pub x: Vec<f64>,
    /// Component along y.
    #[serde(with = "stored")]
    pub y: Vec<f64>,
}

impl TangentialField {
    /// A field of zeros.
    pub fn zeros(len: usize) -> Self {
        Self { x: vec![0.0; len], y: vec![0.0; len] }
    }

    /// Inner product.
    pub fn dot(&self, other: &Self) -> f64 {
        dot(&self.x, &other.x) + dot(&self.y, &other.y)
    }

    /// Euclidean norm.
    pub fn norm(&self) -> f64 {
        self.dot(self).sqrt()
    }

    /// `self += factor other`.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        add_scaled(&mut self.x, factor, &other.x);
        add_scaled(&mut self.y, factor, &other.y);
    }

    /// Sets all to zero.
    pub fn clear(&mut self) {
        self.x.fill(0.0);
        self.y.fill(0.0);
    }

    /// Vector at a cell.
    pub fn at(&self, cell: usize) -> [f64; 2] {
        [self.x[cell], self.y[cell]]
    }

    /// Puts a vector at a cell.
    pub fn set(&mut self, cell: usize, vector: [f64; 2]) {
        self.x[cell] = vector[0];
        self.y[cell] = vector[1];
    }

    /// Both components.
    pub fn parts(&self) -> [&[f64]; 2] {
        [&self.x, &self.y]
    }

    /// Both components.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 2] {
        [&mut self.x, &mut self.y]
    }

    /// Both components, to be resized.
    pub fn each_mut(&mut self) -> [&mut Vec<f64>; 2] {
        [&mut self.x, &mut self.y]
    }

    /// Takes over another field, keeping the memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.x.clone_from(&other.x);
        self.y.clone_from(&other.y);
    }
}
