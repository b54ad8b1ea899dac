//! What the equations of one increment ask for, over the cells of a region; and what their solution is.

use super::laws::complementarity::NormalResidual;
use super::laws::friction::FrictionLaw;
use super::laws::rigid_motions::CellPositions;
use super::laws::slip::TangentialResidual;
use super::laws::slip_path::SlipPath;
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
    /// Sum of the pressures over the cells, when the force is prescribed [pressure].
    pub total: Option<f64>,
    /// Approach of the body or of the actuator, when it is prescribed [length].
    pub approach: f64,
    /// By how much the machine gives under a unit of the summed pressure; 0: the approach is that of the body [length/pressure].
    pub approach_give: f64,
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// What is known of the paths of slip.
    pub path: &'a SlipPath,
    /// Where the cells are.
    pub positions: &'a CellPositions,
    /// Increments of the motions that are prescribed [length].
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for motions that follow from a resultant, at no motion [pressure].
    pub resultant: [f64; 3],
}

impl ContactProblem<'_> {
    /// Approach of the body under pressures, where it does not follow from their sum [length].
    pub fn approach_under(&self, pressure: &[f64]) -> Option<f64> {
        let gives = if self.approach_give > 0.0 { self.approach_give * sum(pressure) } else { 0.0 };
        self.total.is_none().then_some(self.approach - gives)
    }

    /// By how much the machine gives under a unit of the summed traction, normally and along x and y [length/pressure].
    pub fn give(&self) -> [f64; 3] {
        let [x, y, _] = self.positions.spring.map(|spring| if spring > 0.0 { 1.0 / spring } else { 0.0 });
        [self.approach_give, x, y]
    }

    /// Resultants that a projection restores: those that are prescribed, and those of `shear` where a spring lets them be, as far as
    /// the friction `bound` carries them.
    pub fn to_restore(self, shear: &TangentialField, bound: &[f64]) -> [f64; 3] {
        let spring = self.positions.spring;
        if spring == [0.0; 3] {
            return self.resultant;
        }
        let found = [sum(&shear.x), sum(&shear.y)];
        let (size, most) = (found[0].hypot(found[1]), sum(bound));
        let fraction = if size > most { most / size } else { 1.0 };
        [0, 1, 2].map(|mode| if spring[mode] > 0.0 { found[mode] * fraction } else { self.resultant[mode] })
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
    /// That of so many cells without slip, under motions.
    pub fn without_slip(cells: usize, motion: [f64; 3]) -> Self {
        Self {
            normal: NormalResidual { approach: 0.0, residual: 0.0 },
            tangential: TangentialResidual { motion, residual: 0.0 },
            gap: Vec::new(),
            slip: TangentialField::zeros(cells),
            end_slip: TangentialField::zeros(cells),
            iterations: 0,
        }
    }
}
