//! Pressure and shear of a box, and the displacements they cause.

use serde::{Deserialize, Serialize};

use crate::model::each_cell::{CellRule, Reals, each_cell};
use crate::model::{TangentialField, stored};

/// Tractions of a box: pressure and shear.
#[derive(Debug, Clone, Default)]
pub struct Tractions {
    /// Pressure [pressure].
    pub pressure: Vec<f64>,
    /// Shear on the lower body [pressure].
    pub shear: TangentialField,
}

impl Tractions {
    /// No traction anywhere.
    pub fn zeros(len: usize) -> Self {
        Self { pressure: vec![0.0; len], shear: TangentialField::zeros(len) }
    }

    /// Pressure and both components of shear.
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.pressure, &self.shear.x, &self.shear.y]
    }

    /// Halfway to other tractions.
    pub fn average_with(&mut self, other: &Self) {
        average(&mut self.pressure, &other.pressure);
        average(&mut self.shear.x, &other.shear.x);
        average(&mut self.shear.y, &other.shear.y);
    }

    /// Takes over other tractions, keeping the memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.pressure.clone_from(&other.pressure);
        self.shear.copy_from(&other.shear);
    }
}

/// Displacements of a box [length].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Displacements {
    /// Normal.
    #[serde(with = "stored")]
    pub normal: Vec<f64>,
    /// Tangential.
    pub tangential: TangentialField,
}

impl Displacements {
    /// Nothing displaced.
    pub fn zeros(len: usize) -> Self {
        Self { normal: vec![0.0; len], tangential: TangentialField::zeros(len) }
    }

    /// Normal part and both tangential parts.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 3] {
        let [x, y] = self.tangential.parts_mut();
        [&mut self.normal, x, y]
    }

    /// Normal part and both tangential parts.
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.normal, &self.tangential.x, &self.tangential.y]
    }

    /// Halfway to other displacements.
    pub fn average_with(&mut self, other: &Self) {
        average(&mut self.normal, &other.normal);
        average(&mut self.tangential.x, &other.tangential.x);
        average(&mut self.tangential.y, &other.tangential.y);
    }
}

fn average(field: &mut [f64], other: &[f64]) {
    each_cell(&Average, [other], [field]);
}

struct Average;

impl CellRule<1, 1, 0> for Average {
    #[inline(always)]
    fn at<R: Reals>(&self, [other]: [R; 1], [value]: &mut [R; 1]) -> [R; 0] {
        *value = (*value + other) * 0.5;
        []
    }
}
