//! What slip has done to each cell since the start of a history, of all cycles that computed ones stand for: what friction may follow.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use crate::fields::stored;

/// Dissipated energy and slip distance of every cell, and the number of cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AccumulatedSlip {
    /// Energy dissipated by friction, by area [pressure x length].
    #[serde(with = "stored")]
    pub energy_density: Array2<f64>,
    /// Slip distance: length of the path, whatever its direction [length].
    #[serde(with = "stored")]
    pub distance: Array2<f64>,
    /// Cycles.
    pub cycles: usize,
}

impl AccumulatedSlip {
    /// Surfaces that have not slipped yet.
    pub fn none(cells: [usize; 2]) -> Self {
        Self { energy_density: Array2::zeros(cells), distance: Array2::zeros(cells), cycles: 0 }
    }

    /// Adds what was accumulated elsewhere, so many times.
    pub fn add_times(&mut self, other: &Self, times: usize) {
        let factor = times as f64;
        self.energy_density.scaled_add(factor, &other.energy_density);
        self.distance.scaled_add(factor, &other.distance);
        self.cycles += times * other.cycles;
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.energy_density.fill(0.0);
        self.distance.fill(0.0);
        self.cycles = 0;
    }

    /// The same with every field replaced.
    #[must_use]
    pub fn with_fields(&self, replaced: impl Fn(&Array2<f64>) -> Array2<f64>) -> Self {
        Self {
            energy_density: replaced(&self.energy_density),
            distance: replaced(&self.distance),
            cycles: self.cycles,
        }
    }

    /// Its fields, to be changed.
    pub fn fields_mut(&mut self) -> [&mut Array2<f64>; 2] {
        [&mut self.energy_density, &mut self.distance]
    }

    /// Its fields.
    pub fn fields(&self) -> [&Array2<f64>; 2] {
        [&self.energy_density, &self.distance]
    }
}
