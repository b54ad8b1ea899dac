//! Stress that is the same under all cells: that of the bulk, and residual stress.

use super::depths::DepthPoint;
use crate::model::{Dimension, HalfSpace, ResidualStress, bulk_stress_in_layer};

/// What adds evenly to the stress of the contact in a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EvenStress {
    /// Bulk stress of the substrate along x and y [pressure]; the layers share its strain.
    pub bulk: [f64; 2],
    /// Residual stress of the layers.
    pub residual: ResidualStress,
}

impl EvenStress {
    /// Stress along x and y at a point [pressure]; in a line contact the bulk is in plane strain.
    pub fn at(&self, half_space: &HalfSpace, point: DepthPoint, dimension: Dimension) -> [f64; 2] {
        let bulk = bulk_stress_in_layer(half_space, point.layer, self.bulk, dimension);
        let residual = self.residual.at(half_space, point.layer, point.depth);
        [bulk[0] + residual[0], bulk[1] + residual[1]]
    }
}
