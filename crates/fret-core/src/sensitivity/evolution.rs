//! Friction that evolves, linearised: how the coefficient of each cell changes with what slip has done to it and with the numbers of the law. The
//! formulas are those of the law (`model/evolution.rs`).

use super::scene::Scene;
use crate::fields::{add_scaled, dot};
use crate::model::AccumulatedSlip;

/// The coefficient in the cells of the region, linearised.
pub(super) struct Evolution {
    /// By what the coefficient follows, cell by cell.
    by_driver: Vec<f64>,
    /// By each number of the law, cell by cell.
    by_numbers: Vec<Vec<f64>>,
}

impl Evolution {
    /// Of surfaces that have slipped before; `None` where friction does not evolve.
    pub fn of(scene: &Scene<'_>, slipped: Option<&AccumulatedSlip>) -> Option<Self> {
        let rule = scene.plan.case.friction_evolution.as_ref()?;
        let first = scene.plan.symmetry.part_of_friction(&scene.plan.case.friction);
        let driver = slipped.map(|slipped| rule.driver(slipped));
        let cells = scene.region.len();
        let mut found = Self {
            by_driver: Vec::with_capacity(cells),
            by_numbers: vec![vec![0.0; cells]; rule.law.numbers()],
        };
        for cell in 0..cells {
            let [i, j] = scene.region.at(cell);
            let driver = driver.map_or(0.0, |driver| driver.at(i, j));
            let (by_driver, by_numbers) = rule.law.slopes_at(first.coefficient().at(i, j), driver);
            found.by_driver.push(by_driver);
            for (field, by) in found.by_numbers.iter_mut().zip(by_numbers) {
                field[cell] = by;
            }
        }
        Some(found)
    }

    /// Change of the coefficient in all cells, with that of what it follows and those of the numbers of the law.
    pub fn forward(&self, slipped: &[f64], numbers: &[f64]) -> Vec<f64> {
        let mut change: Vec<f64> =
            self.by_driver.iter().zip(slipped).map(|(by, slipped)| by * slipped).collect();
        for (number, by) in numbers.iter().zip(&self.by_numbers) {
            add_scaled(&mut change, *number, by);
        }
        change
    }

    /// Backwards, from that of the coefficient: adds to both.
    pub fn transposed(&self, of: &[f64], slipped: &mut [f64], numbers: &mut [f64]) {
        for ((slipped, by), of) in slipped.iter_mut().zip(&self.by_driver).zip(of) {
            *slipped += by * of;
        }
        for (number, by) in numbers.iter_mut().zip(&self.by_numbers) {
            *number += dot(by, of);
        }
    }
}
