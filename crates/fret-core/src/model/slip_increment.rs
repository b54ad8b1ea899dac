//! What slips between two states that follow each other: its length, and the energy that friction dissipates.

use ndarray::{Array2, Zip};

use super::accumulated::AccumulatedSlip;
use super::friction::CoulombFriction;
use super::state::ContactState;

/// Adds what slips between two states that follow each other under a friction law.
pub fn add_slip(
    before: &ContactState,
    after: &ContactState,
    friction: &CoulombFriction,
    to: &mut AccumulatedSlip,
) {
    add_dissipation(before, after, friction, 1.0, &mut to.energy_density);
    add_path(before, after, &mut to.distance);
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
