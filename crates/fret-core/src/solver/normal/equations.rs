//! The equations of the frictionless problem in a region.

use super::super::laws::rigid_motions::CellPositions;
use super::super::laws::tilt_motions::TiltMotions;
use super::super::prescribed::NormalLoad;

/// What the normal equations of one increment ask for, over the cells of a region.
#[derive(Debug)]
pub struct NormalEquations<'a> {
    /// Gap before deformation, with whatever else moves the surfaces at given shear [length].
    pub undeformed: &'a [f64],
    /// What is prescribed. What the machine gives is in the displacements while the problem is solved.
    pub load: NormalLoad,
    /// Where the cells are.
    pub positions: &'a CellPositions,
}

impl NormalEquations<'_> {
    /// The motions along the normal, where a moment is prescribed.
    pub fn tilt(&self) -> Option<TiltMotions> {
        TiltMotions::of(&self.load, self.positions, 0..self.undeformed.len())
    }
}
