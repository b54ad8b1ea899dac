//! Pressure and shear over the cells of a region, and the displacements they cause.

use serde::{Deserialize, Serialize};

use crate::fields::{reset, stored};
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

    /// Makes room for so many cells; what was in it is lost.
    pub fn reset(&mut self, len: usize) {
        for field in [&mut self.pressure, &mut self.shear.x, &mut self.shear.y] {
            reset(field, len);
        }
    }

    /// Pressure and both components of shear.
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.pressure, &self.shear.x, &self.shear.y]
    }

    /// Goes halfway to other tractions.
    pub fn average_with(&mut self, other: &Self) {
        let [x, y] = self.shear.parts_mut();
        for (field, other) in [&mut self.pressure[..], x, y].into_iter().zip(other.parts()) {
            field.iter_mut().zip(other).for_each(|(value, other)| *value = (*value + other) * 0.5);
        }
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
    fn tractions_go_halfway_to_others() {
        let mut one =
            Tractions { pressure: vec![4.0], shear: TangentialField { x: vec![-2.0], y: vec![1.0] } };
        let other = Tractions { pressure: vec![2.0], shear: TangentialField { x: vec![0.0], y: vec![-7.0] } };
        one.average_with(&other);
        assert_eq!(one.parts(), [&[3.0][..], &[-1.0], &[-3.0]]);
        one.average_with(&Tractions::zeros(1));
        assert_eq!(one.parts(), [&[1.5][..], &[-0.5], &[-1.5]]);
        let mut moved = Displacements { normal: vec![1.0], tangential: one.shear.clone() };
        assert_eq!(moved.parts(), [&[1.0][..], &[-0.5], &[-1.5]]);
        moved.parts_mut().into_iter().for_each(|part| part.fill(0.0));
        assert_eq!(moved, Displacements::zeros(1));
    }
}
