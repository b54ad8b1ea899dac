//! What slips between two states that follow each other: its length, the energy that friction dissipates, and what it wears off.

use ndarray::{Array2, Zip};

use crate::model::{AccumulatedSlip, ContactState, CoulombFriction, WearLaw, WearRule};
use crate::solver::friction_bounds;

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
fn add_dissipation(
    before: &ContactState,
    after: &ContactState,
    friction: &CoulombFriction,
    factor: f64,
    energy: &mut Array2<f64>,
) {
    let slip_y = &after.slip[1] - &before.slip[1];
    let mut bound = friction_bounds(friction, &before.pressure);
    bound.zip_mut_with(&friction_bounds(friction, &after.pressure), |bound, now| {
        *bound = 0.5 * (*bound + now);
    });
    Zip::from(energy)
        .and(&bound)
        .and(&after.slip[0])
        .and(&before.slip[0])
        .and(&slip_y)
        .for_each(|energy, bound, now, then, y| *energy += factor * bound * (now - then).hypot(*y));
}

/// Adds the depth [length] worn between two states that follow each other under a friction law; where each layer has a coefficient of
/// its own, the work by area [pressure x length] that they wear by. Only slipping cells have slip.
pub fn add_wear(
    before: &ContactState,
    after: &ContactState,
    friction: &CoulombFriction,
    rule: &WearRule,
    depth: &mut Array2<f64>,
) {
    let k = rule.coefficient.unwrap_or(1.0);
    match rule.law {
        WearLaw::Energy => add_dissipation(before, after, friction, k, depth),
        WearLaw::Archard => {
            let slip_y = &after.slip[1] - &before.slip[1];
            let pressure = &before.pressure + &after.pressure;
            Zip::from(depth)
                .and(&pressure)
                .and(&after.slip[0])
                .and(&before.slip[0])
                .and(&slip_y)
                .for_each(|depth, p, now, then, y| *depth += k * 0.5 * p * (now - then).hypot(*y));
        }
    }
}
