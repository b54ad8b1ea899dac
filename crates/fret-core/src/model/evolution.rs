//! Friction that evolves: the coefficient of a cell as a function of what slip has done to it.

use ndarray::Array2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::accumulated::AccumulatedSlip;
use super::friction::{CellMap, CellValues, CoulombFriction};
use crate::document::Table;

/// What the friction coefficient follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "DriverFile")]
pub enum EvolutionDriver {
    // [pressure x length]
    /// Energy dissipated in the cell, by area.
    Energy,
    // [length]
    /// Slip distance of the cell.
    SlipDistance,
    /// Number of cycles.
    Cycles,
}

/// The coefficient over its driver `x`, from what it was at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EvolutionLaw {
    /// `last + (first - last) exp(-x / scale)`.
    Exponential {
        /// Coefficient that it tends to [-].
        last: f64,
        /// Driver over which the distance to it falls by a factor e, in the unit of the driver.
        scale: f64,
    },
    /// Rows of driver and coefficient, the first at 0; linear between them, constant behind the last one.
    Table(Vec<[f64; 2]>),
}

/// How friction evolves, and how many cycles a computed one stands for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FrictionEvolution {
    /// What the coefficient follows.
    pub by: EvolutionDriver,
    /// How.
    pub law: EvolutionLaw,
    /// Cycles that a computed one stands for, at the most.
    pub every: usize,
    /// Change of the coefficient of a cell over these, at the most [-].
    pub tolerance: f64,
}

impl EvolutionLaw {
    /// Coefficient [-] of a cell that started with `first`, at a driver that is not negative.
    pub fn at(&self, first: f64, driver: f64) -> f64 {
        match self {
            Self::Exponential { last, scale } => last + (first - last) * (-driver / scale).exp(),
            Self::Table(rows) => {
                let next = rows.partition_point(|[x, _]| *x <= driver);
                match (rows.get(next.wrapping_sub(1)), rows.get(next)) {
                    (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (driver - x0) / (x1 - x0),
                    (Some([_, value]), None) | (None, Some([_, value])) => *value,
                    (None, None) => first,
                }
            }
        }
    }

    /// How many numbers it has: coefficients at the start and at the end, and scale; of a table driver and coefficient, row by row.
    pub fn numbers(&self) -> usize {
        match self {
            Self::Exponential { .. } => 3,
            Self::Table(rows) => 2 * rows.len(),
        }
    }

    /// Which of its numbers is the coefficient at the start.
    pub fn first(&self) -> usize {
        match self {
            Self::Exponential { .. } => 0,
            Self::Table(_) => 1,
        }
    }

    /// Derivatives of the coefficient by the driver, and by its numbers; at a row of a table those behind it.
    pub fn slopes_at(&self, first: f64, driver: f64) -> (f64, Vec<f64>) {
        let mut by = vec![0.0; self.numbers()];
        let by_driver = match self {
            Self::Exponential { last, scale } => {
                let stays = (-driver / scale).exp();
                let slope = (last - first) * stays / scale;
                by.copy_from_slice(&[stays, 1.0 - stays, -slope * driver / scale]);
                slope
            }
            Self::Table(rows) => {
                let next = rows.partition_point(|[x, _]| *x <= driver);
                if let (true, Some([x1, y1])) = (next > 0, rows.get(next)) {
                    let [x0, y0] = rows[next - 1];
                    let (share, slope) = ((driver - x0) / (x1 - x0), (y1 - y0) / (x1 - x0));
                    let ends = [slope * (share - 1.0), 1.0 - share, -slope * share, share];
                    by[2 * (next - 1)..2 * (next + 1)].copy_from_slice(&ends);
                    slope
                } else {
                    by[2 * next.max(1) - 1] = 1.0;
                    0.0
                }
            }
        };
        (by_driver, by)
    }

    /// How far the driver goes on from a value until the coefficient has changed by `change`; infinite where it never does.
    pub fn reach(&self, first: f64, driver: f64, change: f64) -> f64 {
        let now = self.at(first, driver);
        match self {
            Self::Exponential { last, scale } => {
                let left = (last - now).abs();
                if change < left { -scale * (-change / left).ln_1p() } else { f64::INFINITY }
            }
            Self::Table(rows) => {
                let mut from = [driver, now];
                for row in rows.iter().filter(|[x, _]| *x > driver) {
                    if (row[1] - now).abs() >= change {
                        let bound = now + change.copysign(row[1] - now);
                        let x = from[0] + (row[0] - from[0]) * (bound - from[1]) / (row[1] - from[1]);
                        return x - driver;
                    }
                    from = *row;
                }
                f64::INFINITY
            }
        }
    }

    /// Largest coefficient that it can lead to [-].
    fn largest(&self) -> f64 {
        match self {
            Self::Exponential { last, .. } => *last,
            Self::Table(rows) => rows.iter().map(|[_, value]| *value).fold(0.0, f64::max),
        }
    }
}

impl FrictionEvolution {
    /// The driver in every cell, in its unit.
    pub fn driver<'a>(&self, slip: &'a AccumulatedSlip) -> Driver<'a> {
        match self.by {
            EvolutionDriver::Energy => Driver::Cells(&slip.energy_density),
            EvolutionDriver::SlipDistance => Driver::Cells(&slip.distance),
            EvolutionDriver::Cycles => Driver::Everywhere(slip.cycles as f64),
        }
    }

    /// The friction law of surfaces that started with `first` and have slipped since.
    pub fn friction(&self, first: &CoulombFriction, slip: &AccumulatedSlip) -> CoulombFriction {
        let evolved = match (first.coefficient(), self.driver(slip)) {
            (CellValues::Uniform(first), Driver::Everywhere(driver)) => {
                CellValues::Uniform(self.law.at(*first, driver))
            }
            (_, driver) => CellValues::Map(CellMap(Array2::from_shape_fn(slip.distance.dim(), |(i, j)| {
                self.law.at(first.at(i, j), driver.at(i, j))
            }))),
        };
        first.with_coefficient(evolved)
    }

    /// A friction law that carries at least what any on the way from `first` does.
    pub fn strongest(&self, first: &CoulombFriction) -> CoulombFriction {
        first.with_coefficient(CellValues::Uniform(first.largest().max(self.law.largest())))
    }
}

/// What a coefficient follows, in every cell.
#[derive(Debug, Clone, Copy)]
pub enum Driver<'a> {
    /// Of each cell its own.
    Cells(&'a Array2<f64>),
    /// The same everywhere.
    Everywhere(f64),
}

impl Driver<'_> {
    /// In cell `[i, j]`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Cells(values) => values[[i, j]],
            Self::Everywhere(value) => *value,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exponential halves its distance to the end every `scale ln 2`; a table is its rows, lines between them and constant behind.
    #[test]
    fn a_coefficient_follows_its_law() {
        let law = EvolutionLaw::Exponential { last: 0.8, scale: 3.0 };
        for (times, left) in [(0.0, 0.6), (1.0, 0.3), (2.0, 0.15)] {
            let found = law.at(0.2, times * 3.0 * 2.0_f64.ln());
            assert!((found - (0.8 - left)).abs() < 1e-15, "{found}");
        }
        let law = EvolutionLaw::Table(vec![[0.0, 0.2], [10.0, 0.6], [30.0, 0.5]]);
        for (x, expected) in [(0.0, 0.2), (5.0, 0.4), (10.0, 0.6), (20.0, 0.55), (30.0, 0.5), (99.0, 0.5)] {
            assert!((law.at(0.2, x) - expected).abs() < 1e-15, "{x}");
        }
    }

    /// A coefficient that does not change is the same number at every driver.
    #[test]
    fn a_law_that_leads_nowhere_keeps_the_bits() {
        let law = EvolutionLaw::Exponential { last: 0.3, scale: 7.0 };
        assert!([0.0, 0.1, 5.0, 1e9].into_iter().all(|x| law.at(0.3, x) == 0.3));
    }

    /// Against differences by the driver and by every number, between rows. 1e-8: of smooth functions in steps of 1e-6.
    #[test]
    fn a_coefficient_changes_by_every_number_of_its_law() {
        /// The law of six numbers, and the first coefficient.
        type Law = fn([f64; 6]) -> (EvolutionLaw, f64);
        let exponential: Law = |[first, last, scale, ..]| (EvolutionLaw::Exponential { last, scale }, first);
        let table: Law =
            |[x0, y0, x1, y1, x2, y2]| (EvolutionLaw::Table(vec![[x0, y0], [x1, y1], [x2, y2]]), y0);
        let of_table = [0.0, 0.2, 10.0, 0.6, 30.0, 0.5];
        for (law, numbers) in [(exponential, [0.2, 0.8, 3.0, 0.0, 0.0, 0.0]), (table, of_table)] {
            for x in [2.0, 20.0, 99.0] {
                let at = |numbers, x: f64| {
                    let (law, first) = law(numbers);
                    law.at(first, x)
                };
                let (found, first) = law(numbers);
                let (by_driver, by) = found.slopes_at(first, x);
                let expected = (at(numbers, x + 1e-6) - at(numbers, x - 1e-6)) / 2e-6;
                assert!((by_driver - expected).abs() < 1e-8, "{found:?} {x}");
                assert_eq!(numbers[found.first()], first);
                for (number, by) in by.iter().enumerate() {
                    let moved = |step: f64| {
                        let mut moved = numbers;
                        moved[number] += step;
                        at(moved, x)
                    };
                    let expected = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                    assert!((by - expected).abs() < 1e-8, "{found:?} {x} {number}: {by} {expected}");
                }
            }
        }
    }

    /// Where the reach ends the coefficient has changed by what was asked for, and before it by less.
    #[test]
    fn the_reach_is_where_the_coefficient_has_changed_so_far() {
        let table = EvolutionLaw::Table(vec![[0.0, 0.2], [10.0, 0.6], [30.0, 0.5], [40.0, 0.1]]);
        let laws = [table, EvolutionLaw::Exponential { last: 0.8, scale: 3.0 }];
        for (law, start) in laws.iter().flat_map(|law| [0.0, 3.0, 12.0].map(|start| (law, start))) {
            let reach = law.reach(0.2, start, 0.01);
            let change = |x: f64| (law.at(0.2, x) - law.at(0.2, start)).abs();
            assert!((change(start + reach) - 0.01).abs() < 1e-14, "{law:?} {start} {reach}");
            assert!((1..10).all(|k| change(start + 0.1 * f64::from(k) * reach) < 0.01), "{law:?} {start}");
        }
        assert_eq!(laws[0].reach(0.2, 50.0, 0.01), f64::INFINITY);
        assert_eq!(laws[1].reach(0.2, 0.0, 0.7), f64::INFINITY);
    }
}
