//! The way back to tractions that the laws allow: no tension, no shear above mu p, resultants exact.

use super::residual::TangentialTask;
use super::zones::Zones;
use crate::model::field::{TangentialField, sum};

/// Cuts tension off and restores the total pressure by scaling, which keeps the shape of the edge.
/// Returns false when nothing is left to scale.
pub fn retract_pressure(pressure: &mut [f64], total: Option<f64>) -> bool {
    for p in pressure.iter_mut() {
        *p = p.max(0.0);
    }
    let Some(total) = total else { return true };
    let found = sum(pressure);
    if found <= 0.0 {
        return total == 0.0;
    }
    let share = total / found;
    for p in pressure.iter_mut() {
        *p *= share;
    }
    true
}

/// Brings shear back to its discs and to its resultants. A slipping cell stays on its circle; a cell that was just cut
/// moves along its tangent only, since pulling it back would undo the slip zone.
pub fn retract_shear(shear: &mut TangentialField, zones: &Zones, task: &TangentialTask<'_>) {
    let len = task.bound.len();
    let mut on_circle = vec![false; len];
    for cell in 0..len {
        let limit = task.bound[cell];
        if limit <= 0.0 {
            shear.set(cell, [0.0, 0.0]);
        }
    }
    for &cell in task.contact {
        let limit = task.bound[cell];
        if limit <= 0.0 {
            continue;
        }
        let vector = shear.at(cell);
        let size = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt();
        let slips = zones.is_on_circle(cell);
        if slips || size > limit {
            on_circle[cell] = true;
            if size > 0.0 {
                shear.set(cell, [vector[0] * limit / size, vector[1] * limit / size]);
            } else {
                let along = zones.direction.at(cell);
                shear.set(cell, [along[0] * limit, along[1] * limit]);
            }
        }
    }
    if task.modes.any_by_force() {
        restore_resultants(shear, &mut on_circle, zones, task);
    }
}

fn restore_resultants(
    shear: &mut TangentialField,
    on_circle: &mut [bool],
    zones: &Zones,
    task: &TangentialTask<'_>,
) {
    let total: f64 = task.contact.iter().map(|&cell| task.bound[cell]).sum();
    let goal = 2e-16 * total;
    let mut released = false;
    let mut defect = defect_of(shear, task);
    for _ in 0..40 {
        let size = length(&defect);
        if size <= goal {
            return;
        }
        let change = task.modes.solve(&compliance_of(shear, on_circle, task), &defect);
        let reach = length(&change);
        let mut share = if reach > 0.5 { 0.5 / reach } else { 1.0 };
        let mut accepted = false;
        for _ in 0..12 {
            let trial = moved(shear, on_circle, task, &change.map(|c| c * share));
            let left = defect_of(&trial.0, task);
            if length(&left) < size * (1.0 - 0.1 * share) {
                *shear = trial.0;
                on_circle.copy_from_slice(&trial.1);
                defect = left;
                accepted = true;
                break;
            }
            share *= 0.5;
        }
        if !accepted {
            if released {
                return;
            }
            // Turning alone does not do: cells that were only cut may come off their circles again.
            released = true;
            for &cell in task.contact {
                on_circle[cell] = zones.is_on_circle(cell) && size < 1e-6 * total;
            }
        }
    }
}

fn length(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn defect_of(shear: &TangentialField, task: &TangentialTask<'_>) -> [f64; 3] {
    let mut found = [0.0; 3];
    for &cell in task.contact {
        let products = task.modes.products(shear.at(cell), cell);
        for mode in 0..3 {
            found[mode] += products[mode];
        }
    }
    let mut defect = [0.0; 3];
    for mode in 0..3 {
        if task.modes.by_force[mode] {
            defect[mode] = task.resultant[mode] - found[mode];
        }
    }
    defect
}

/// Change of the resultants under `q + mu p (sum of modes)`.
fn compliance_of(shear: &TangentialField, on_circle: &[bool], task: &TangentialTask<'_>) -> [[f64; 3]; 3] {
    let mut matrix = [[0.0; 3]; 3];
    let modes = if task.modes.by_force[2] { 3 } else { 2 };
    for &cell in task.contact {
        let limit = task.bound[cell];
        if limit <= 0.0 {
            continue;
        }
        let shear = shear.at(cell);
        let along = if on_circle[cell] { [shear[0] / limit, shear[1] / limit] } else { [0.0, 0.0] };
        for m in 0..modes {
            let a = task.modes.mode(m, cell);
            let an = a[0] * along[0] + a[1] * along[1];
            for n in 0..modes {
                let b = task.modes.mode(n, cell);
                let bn = b[0] * along[0] + b[1] * along[1];
                matrix[m][n] += limit * (a[0] * b[0] + a[1] * b[1] - an * bn);
            }
        }
    }
    matrix
}

fn moved(
    shear: &TangentialField,
    on_circle: &[bool],
    task: &TangentialTask<'_>,
    amounts: &[f64; 3],
) -> (TangentialField, Vec<bool>) {
    let mut result = shear.clone();
    let mut on = on_circle.to_vec();
    for &cell in task.contact {
        let limit = task.bound[cell];
        if limit <= 0.0 {
            continue;
        }
        let here = shear.at(cell);
        let mut push = task.modes.displacement(amounts, cell);
        if on_circle[cell] {
            let along = [here[0] / limit, here[1] / limit];
            let out = push[0] * along[0] + push[1] * along[1];
            push = [push[0] - out * along[0], push[1] - out * along[1]];
        }
        let vector = [here[0] + limit * push[0], here[1] + limit * push[1]];
        let size = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt();
        if on_circle[cell] || size > limit {
            on[cell] = true;
            result.set(cell, [vector[0] * limit / size, vector[1] * limit / size]);
        } else {
            result.set(cell, vector);
        }
    }
    (result, on)
}
