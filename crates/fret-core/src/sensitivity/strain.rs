//! By how much more bulk stresses strain the lower surface than the upper one, linearised.

use super::case_number::{BodyNumber, LayerNumber};
use crate::model::BulkCompliance;
use crate::model::controls::{BULK_STRESS, FREEDOMS};
use crate::plan::Plan;

/// Bulk stresses of both bodies along x and y, in the order of the degrees of freedom.
pub(super) const STRESSES: usize = 4;

/// Derivatives of the strain along x and y, times the length of the scene, by each of the bulk stresses [length/pressure]; or, of these, those by
/// a constant of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strain {
    by_stress: [[f64; STRESSES]; 2],
}

impl Strain {
    /// That of the pair of a plan.
    pub fn of(plan: &Plan, length: f64) -> Self {
        Self::made(&BulkCompliance::of(&plan.case.bodies, plan.case.dimension()), length)
    }

    /// Its derivative by a constant of a body; none but those of substrates change it.
    pub fn by(plan: &Plan, number: BodyNumber, length: f64) -> Option<Self> {
        let constant = match (number.coating, number.number) {
            (None, LayerNumber::Young) => 0,
            (None, LayerNumber::Poisson) => 1,
            _ => return None,
        };
        let body = usize::from(number.of_upper);
        let slope = BulkCompliance::slope(&plan.case.bodies, plan.case.dimension(), body, constant);
        Some(Self::made(&slope, length))
    }

    fn made(compliance: &BulkCompliance, length: f64) -> Self {
        let mut by_stress = [[0.0; STRESSES]; 2];
        for stress in 0..STRESSES {
            let mut unit = [[0.0; 2]; 2];
            unit[stress / 2][stress % 2] = length;
            let [x, y] = compliance.relative_strain(unit);
            (by_stress[0][stress], by_stress[1][stress]) = (x, y);
        }
        Self { by_stress }
    }

    /// The strain times the length under bulk stresses of the lower and the upper body, or its change with them.
    pub fn under(&self, stress: [[f64; 2]; 2]) -> [f64; 2] {
        let stresses = stress.as_flattened();
        self.by_stress.map(|by| by.iter().zip(stresses).map(|(by, stress)| by * stress).sum())
    }

    /// Its change with a load.
    pub fn forward(&self, load: &[f64; FREEDOMS]) -> [f64; 2] {
        let of = |stress: usize| load[BULK_STRESS + stress];
        self.under([[of(0), of(1)], [of(2), of(3)]])
    }

    /// Backwards: adds to the load.
    pub fn transposed(&self, strain: [f64; 2], load: &mut [f64; FREEDOMS]) {
        for (by, strain) in self.by_stress.iter().zip(strain) {
            for (load, by) in load[BULK_STRESS..].iter_mut().zip(by) {
                *load += by * strain;
            }
        }
    }

    /// The sum of its numbers, each times that of another.
    pub fn times(&self, sums: &[[f64; STRESSES]; 2]) -> f64 {
        self.by_stress.as_flattened().iter().zip(sums.as_flattened()).map(|(by, sum)| by * sum).sum()
    }
}
