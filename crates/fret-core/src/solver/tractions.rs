//! Pressure and shear over the cells of a region, and the displacements they cause.

use serde::{Deserialize, Serialize};

use crate::fields::stored;
use crate::model::TangentialField;

/// Pressure and shear.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Tractions {
    /// Pressure [pressure].
    #[serde(with = "stored")]
    pub pressure: Vec<f64>,
    /// Shear on the lower body [pressure].
    pub shear: TangentialField,
}

/// Displacements, lower body minus upper [length].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Displacements {
    /// Normal.
    #[serde(with = "stored")]
    pub normal: Vec<f64>,
    /// Tangential.
    pub tangential: TangentialField,
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

    /// Pressure and both components of shear.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 3] {
        let [x, y] = self.shear.parts_mut();
        [&mut self.pressure, x, y]
    }
}

impl Displacements {
    /// Nothing displaced.
    pub fn zeros(len: usize) -> Self {
        Self { normal: vec![0.0; len], tangential: TangentialField::zeros(len) }
    }

    /// Normal and both tangential components.
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.normal, &self.tangential.x, &self.tangential.y]
    }

    /// Normal and both tangential components.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 3] {
        let [x, y] = self.tangential.parts_mut();
        [&mut self.normal, x, y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_normal_and_along_both_axes() {
        let shear = TangentialField { x: vec![-2.0], y: vec![1.0] };
        let one = Tractions { pressure: vec![4.0], shear: shear.clone() };
        assert_eq!(one.parts(), [&[4.0][..], &[-2.0], &[1.0]]);
        let mut moved = Displacements { normal: vec![1.0], tangential: shear };
        assert_eq!(moved.parts(), [&[1.0][..], &[-2.0], &[1.0]]);
        moved.parts_mut().into_iter().for_each(|part| part.fill(0.0));
        assert_eq!(moved, Displacements::zeros(1));
    }
}
