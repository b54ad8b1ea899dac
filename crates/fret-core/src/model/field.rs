//! Fields on the cells of a box as flat rows, index `i * ny + j`: sums and inner products in a fixed order.

use serde::{Deserialize, Serialize};

/// Partial sums of a long sum: fixed, so that the bits never depend on the machine's mood.
const LANES: usize = 8;

/// Sum of a field.
pub fn sum(a: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let chunks = a.chunks_exact(LANES);
    let rest = chunks.remainder();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane += value;
        }
    }
    fold(lanes) + rest.iter().sum::<f64>()
}

/// Inner product of two fields.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a_chunks, b_chunks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a_chunks.zip(b_chunks) {
        for lane in 0..LANES {
            lanes[lane] += x[lane] * y[lane];
        }
    }
    fold(lanes) + rest
}

fn fold(lanes: [f64; LANES]) -> f64 {
    ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]))
}

/// Euclidean norm of a field.
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `y += factor x`.
pub fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (target, value) in y.iter_mut().zip(x) {
        *target += factor * value;
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
    pub x: Vec<f64>,
    /// Component along y.
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
}
