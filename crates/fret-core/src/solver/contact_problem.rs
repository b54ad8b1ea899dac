//! What the equations of one increment ask for, over the cells of a region; and what their solution is.

use super::contact_set::ContactSet;
use super::laws::complementarity::NormalResidual;
use super::laws::friction::FrictionLaw;
use super::laws::rigid_motions::{CellPositions, RigidMotions};
use super::laws::slip::TangentialResidual;
use super::laws::slip_path::SlipPath;
use super::laws::tilt_motions::TiltMotions;
use super::prescribed::{NormalLoad, TangentialLoads};
use crate::fields::{TangentialField, sum};

/// What the equations of one increment ask for, over the cells of a region.
#[derive(Debug, Clone, Copy)]
pub struct ContactProblem<'a> {
    /// Whether the pressure is unknown, or given with the tractions to start from.
    pub pressure: Pressure,
    /// Gap before deformation [length].
    pub undeformed: &'a [f64],
    /// The friction law of every cell.
    pub friction: &'a FrictionLaw,
    /// What is prescribed along the normal.
    pub normal: NormalLoad,
    /// What is prescribed along the surface.
    pub tangential: TangentialLoads,
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// What is known of the paths of slip.
    pub path: &'a SlipPath,
    /// Where the cells are.
    pub positions: &'a CellPositions,
}

impl ContactProblem<'_> {
    /// The rigid motions of the cells in contact.
    pub fn motions_of(&self, contact: &ContactSet) -> RigidMotions {
        self.positions.motions_of(contact, self.tangential)
    }

    /// The motions along the normal of the cells in contact, where a moment of the pressure is prescribed.
    pub fn tilt_of(&self, contact: &ContactSet) -> Option<TiltMotions> {
        TiltMotions::of(&self.normal, self.positions, contact.cells())
    }

    /// By how much the machine gives under a unit of the summed traction, normally and along x and y [length/pressure].
    pub fn give(&self) -> [f64; 3] {
        let [x, y, _] = self.tangential.spring.map(|spring| if spring > 0.0 { 1.0 / spring } else { 0.0 });
        [self.normal.give, x, y]
    }

    /// Resultants that a projection restores: those that are prescribed, and those of `shear` where a spring lets them be, as far as
    /// the friction `bound` carries them.
    pub fn to_restore(self, shear: &TangentialField, bound: &[f64]) -> [f64; 3] {
        let TangentialLoads { spring, resultant, .. } = self.tangential;
        if spring == [0.0; 3] {
            return resultant;
        }
        let found = [sum(&shear.x), sum(&shear.y)];
        let (size, most) = (found[0].hypot(found[1]), sum(bound));
        let fraction = if size > most { most / size } else { 1.0 };
        [0, 1, 2].map(|mode| if spring[mode] > 0.0 { found[mode] * fraction } else { resultant[mode] })
    }
}

/// Whether the pressure is one of the unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressure {
    /// It is.
    Unknown,
    /// It is known, and so is the contact.
    Given,
}

/// What was reached besides tractions and displacements.
#[derive(Debug)]
pub struct Solution {
    /// Approach and complementarity; nothing is off where the pressure was given.
    pub normal: NormalResidual,
    /// Motions and Coulomb's law.
    pub tangential: TangentialResidual,
    /// Gap [length]; empty where the pressure was given.
    pub gap: Vec<f64>,
    /// Slip increment [length].
    pub slip: TangentialField,
    /// Slip at the end of the increment, up to a factor [length].
    pub end_slip: TangentialField,
    /// Newton iterations made.
    pub iterations: usize,
}

impl Solution {
    /// That of so many cells without slip, under motions; without friction fields of slip need none.
    pub fn without_slip(cells: usize, motion: [f64; 3]) -> Self {
        Self {
            normal: NormalResidual { approach: 0.0, turned: [0.0; 2], residual: 0.0 },
            tangential: TangentialResidual { motion, residual: 0.0 },
            gap: Vec::new(),
            slip: TangentialField::zeros(cells),
            end_slip: TangentialField::zeros(cells),
            iterations: 0,
        }
    }
}
