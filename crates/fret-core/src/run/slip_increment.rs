//! What slips between two states that follow each other: its length, the energy that friction dissipates, and what it wears off.

use ndarray::{Array2, Zip};

use crate::model::{AccumulatedSlip, ContactState, CoulombFriction, Integration, WearLaw, WearRule};
use crate::solver::{dissipation, friction_bounds, length_of_way};

/// Adds what slips between two states that follow each other, each under the friction law that lay over the grid in it.
pub fn add_slip(
    states: [&ContactState; 2],
    integration: Integration,
    laws: [&CoulombFriction; 2],
    to: &mut AccumulatedSlip,
) {
    add_dissipation(states, integration, laws, 1.0, &mut to.energy_density);
    add_path(states, integration, &mut to.distance);
}

/// What [`add_slip`] adds, by what each of both states has a part in: the pressure there, and half of the way.
pub fn slip_by_ends(
    states: [&ContactState; 2],
    integration: Integration,
    laws: [&CoulombFriction; 2],
) -> [AccumulatedSlip; 2] {
    let half = ways(states, integration) * 0.5;
    [0, 1].map(|end| {
        let bounds = friction_bounds(laws[end], &states[end].pressure);
        AccumulatedSlip { energy_density: bounds * &half, distance: half.clone(), cycles: 0 }
    })
}

/// Adds the length of the slip path [length] between two states that follow each other.
pub fn add_path(states: [&ContactState; 2], integration: Integration, path: &mut Array2<f64>) {
    *path += &ways(states, integration);
}

/// Length of the slip path in every cell [length] between two states that follow each other.
fn ways([before, after]: [&ContactState; 2], integration: Integration) -> Array2<f64> {
    Array2::from_shape_fn(after.zone.dim(), |at| {
        let slip = [0, 1].map(|axis| after.slip[axis][at] - before.slip[axis][at]);
        if slip == [0.0; 2] {
            return 0.0;
        }
        let states = [before, after];
        let shear = states.map(|state| [0, 1].map(|axis| state.shear[axis][at]));
        length_of_way(integration, slip, states.map(|state| state.zone[at]), shear)
    })
}

/// Adds `factor` times the energy that friction dissipates by area [pressure x length] between two states that follow each other: the
/// mean of the bounds at both ends along the way.
fn add_dissipation(
    states: [&ContactState; 2],
    integration: Integration,
    laws: [&CoulombFriction; 2],
    factor: f64,
    energy: &mut Array2<f64>,
) {
    let [first, last] = [0, 1].map(|end| friction_bounds(laws[end], &states[end].pressure));
    let ways = ways(states, integration);
    Zip::from(energy).and(&first).and(&last).and(&ways).for_each(|energy, first, last, way| {
        *energy += factor * dissipation([*first, *last], *way);
    });
}

/// What [`add_wear`] adds between two states that follow each other, by what each of them has a part in: the pressure before, and after.
pub fn wear_by_ends(
    states: [&ContactState; 2],
    integration: Integration,
    laws: [&CoulombFriction; 2],
    rule: &WearRule,
) -> [Array2<f64>; 2] {
    let k = rule.coefficient.unwrap_or(1.0);
    let ways = ways(states, integration);
    [0, 1].map(|end| {
        let bounds = match rule.law {
            WearLaw::Energy => friction_bounds(laws[end], &states[end].pressure),
            WearLaw::Archard => states[end].pressure.clone(),
        };
        let mut worn = bounds;
        Zip::from(&mut worn).and(&ways).for_each(|worn, way| *worn *= 0.5 * k * way);
        worn
    })
}

/// Length of the slip path in every cell [length] between two states that follow each other.
pub fn path(states: [&ContactState; 2], integration: Integration) -> Array2<f64> {
    ways(states, integration)
}

/// Adds the depth [length] worn between two states that follow each other, each under its friction law; where each layer has a coefficient of
/// its own, the work by area [pressure x length] that they wear by. Cells that stick at both ends have no slip.
pub fn add_wear(
    states: [&ContactState; 2],
    integration: Integration,
    laws: [&CoulombFriction; 2],
    rule: &WearRule,
    depth: &mut Array2<f64>,
) {
    let k = rule.coefficient.unwrap_or(1.0);
    match rule.law {
        WearLaw::Energy => add_dissipation(states, integration, laws, k, depth),
        WearLaw::Archard => {
            let ways = ways(states, integration);
            Zip::from(depth).and(&states[0].pressure).and(&states[1].pressure).and(&ways).for_each(
                |depth, first, last, way| {
                    *depth += k * dissipation([*first, *last], *way);
                },
            );
        }
    }
}
