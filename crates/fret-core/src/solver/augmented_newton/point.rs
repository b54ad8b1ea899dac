//! Tractions with everything that is linear in them.

use super::super::tractions::{Displacements, Tractions};
use crate::fields::norm;
use crate::model::TangentialField;

/// Tractions, their displacements, approach and rigid motions: what lies between two of them is known without an operator application.
#[derive(Debug, Clone)]
pub struct Point {
    pub tractions: Tractions,
    pub displacements: Displacements,
    /// [length]
    pub approach: f64,
    /// Tilts since the undeformed gap was taken, where a moment of the pressure is prescribed [length].
    pub turned: [f64; 2],
    /// Increments of shift and twist x length [length].
    pub motion: [f64; 3],
}

impl Point {
    /// `self + fraction (other - self)`.
    pub fn towards(&self, other: &Self, fraction: f64) -> Self {
        let between = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + fraction * (b - a)).collect();
        let [p, qx, qy] = [0, 1, 2].map(|k| between(self.tractions.parts()[k], other.tractions.parts()[k]));
        let [normal, x, y] =
            [0, 1, 2].map(|k| between(self.displacements.parts()[k], other.displacements.parts()[k]));
        Self {
            tractions: Tractions { pressure: p, shear: TangentialField { x: qx, y: qy } },
            displacements: Displacements { normal, tangential: TangentialField { x, y } },
            approach: self.approach + fraction * (other.approach - self.approach),
            turned: [0, 1]
                .map(|axis| self.turned[axis] + fraction * (other.turned[axis] - self.turned[axis])),
            motion: [0, 1, 2].map(|k| self.motion[k] + fraction * (other.motion[k] - self.motion[k])),
        }
    }

    /// Length of the pressure over all cells [pressure].
    pub fn size(&self) -> f64 {
        norm(&self.tractions.pressure)
    }
}
