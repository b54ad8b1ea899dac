//! A field of tangential vectors.

use serde::{Deserialize, Serialize};

use super::arithmetic::{add_scaled, dot};
use super::stored;

/// Length of a tangential vector.
#[inline(always)]
pub fn length([x, y]: [f64; 2]) -> f64 {
    // Not `hypot`, which costs more to serve vectors whose squares no number holds: sizes of a case keep far from these.
    (x * x + y * y).sqrt()
}

/// A tangential field: x and y components. Without friction a solver's fields have no cells: they are zero.
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

    /// The same of a field that may have no cells: then it is zero everywhere.
    pub fn at_or_zero(&self, cell: usize) -> [f64; 2] {
        if self.x.is_empty() { [0.0; 2] } else { self.at(cell) }
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
}
