//! By how much more bulk stresses strain the lower surface than the upper one in an increment.

use crate::model::SurfaceGrid;

/// A homogeneous relative strain about the middle of the contact.
#[derive(Debug, Clone, Copy)]
pub struct Stretch {
    /// Increment of the strain along x and y [-].
    pub strain: [f64; 2],
    /// Where the middle of the grid is [length].
    pub middle: [f64; 2],
}

impl Stretch {
    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.strain == [0.0; 2]
    }

    /// Relative displacement of a cell, lower surface less upper [length].
    pub fn at(&self, grid: &SurfaceGrid, cell: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.strain[axis] * (self.middle[axis] + grid.centre(axis, cell[axis])))
    }
}
