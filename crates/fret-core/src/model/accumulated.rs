//! What slip has done to each cell since the start of a history, of all cycles that computed ones stand for: what friction may follow.

use ndarray::{Array2, Zip};
use serde::{Deserialize, Serialize};

use super::friction::CoulombFriction;
use super::state::ContactState;
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

    /// Adds what slips between two states that follow each other under a friction law.
    pub fn add(&mut self, before: &ContactState, after: &ContactState, friction: &CoulombFriction) {
        add_dissipation(before, after, friction, 1.0, &mut self.energy_density);
        add_path(before, after, &mut self.distance);
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

    /// Its fields.
    pub fn fields(&self) -> [&Array2<f64>; 2] {
        [&self.energy_density, &self.distance]
    }
}

/// Adds the length of slip [length] between two states that follow each other.
pub fn add_path(before: &ContactState, after: &ContactState, path: &mut Array2<f64>) {
    let slip_y = &after.slip[1] - &before.slip[1];
    Zip::from(path)
        .and(&after.slip[0])
        .and(&before.slip[0])
        .and(&slip_y)
        .for_each(|path, now, then, y| *path += (now - then).hypot(*y));
}

/// Adds `factor` times the energy that friction dissipates by area [pressure x length] between two states that follow each other: the
/// mean of the bounds at both ends along the slip.
pub fn add_dissipation(
    before: &ContactState,
    after: &ContactState,
    friction: &CoulombFriction,
    factor: f64,
    energy: &mut Array2<f64>,
) {
    let slip_y = &after.slip[1] - &before.slip[1];
    let mut bound = before.pressure.clone();
    Zip::indexed(&mut bound).and(&after.pressure).for_each(|(i, j), bound, now| {
        *bound = 0.5 * (friction.bound(i, j, *bound) + friction.bound(i, j, *now));
    });
    Zip::from(energy)
        .and(&bound)
        .and(&after.slip[0])
        .and(&before.slip[0])
        .and(&slip_y)
        .for_each(|energy, bound, now, then, y| *energy += factor * bound * (now - then).hypot(*y));
}
