//! Projection of tractions onto what the laws allow: no tension, no shear beyond the friction bound, resultants exact.

use super::active_sets::ActiveSets;
use super::rigid_motions::{RigidMotions, size};
use super::tilt_motions::TiltMotions;
use crate::fields::{CellRule, Reals, TangentialField, each_cell, reset, sum};

/// Cuts tension off and restores the total pressure by scaling, which keeps the shape of the edge; where moments are prescribed, these too.
/// False when nothing is left to scale, or nothing that carries the moments.
pub fn project_pressure(pressure: &mut [f64], total: Option<f64>, tilt: Option<&TiltMotions>) -> bool {
    if let Some(tilt) = tilt {
        return tilt.restore(pressure);
    }
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

/// Projection of shear, with its memory: a trial with its cells on the circle, and the marks of the last.
#[derive(Debug, Default)]
pub struct ShearProjection {
    on_circle: Vec<f64>,
    trial: TangentialField,
    trial_on: Vec<f64>,
}

/// Resultants that are missing, and how they answer to `q + mu p (sum of modes)`.
struct Balance {
    defect: [f64; 3],
    compliance: [f64; 6],
}

impl ShearProjection {
    /// Brings shear back to its discs of radius `bound` and to a `resultant` of the motions by force [pressure]. A slipping cell stays on its circle; a cell that was just cut
    /// moves along its tangent only, since pulling it back would undo the slip zone.
    pub fn project(
        &mut self,
        shear: &mut TangentialField,
        sets: &ActiveSets,
        bound: &[f64],
        motions: &RigidMotions,
        resultant: [f64; 3],
    ) {
        reset(&mut self.on_circle, sets.len());
        let ([along_x, along_y], [around_x, around_y]) = (sets.direction.parts(), motions.rotation.parts());
        let read = [bound, &sets.stick, along_x, along_y, around_x, around_y];
        let write = [&mut shear.x[..], &mut shear.y, &mut self.on_circle];
        let found = each_cell(&ToDiscs, read, write);
        if motions.loads.any_by_force() {
            let asked = Asked { bound, motions, resultant };
            self.restore_resultants(shear, asked.balance(found), sets, &asked);
        }
    }

    fn restore_resultants(
        &mut self,
        shear: &mut TangentialField,
        mut balance: Balance,
        sets: &ActiveSets,
        asked: &Asked<'_>,
    ) {
        let total = sum(asked.bound);
        let goal = 2e-16 * total;
        let mut released = false;
        for _ in 0..40 {
            let defect = size(&balance.defect);
            if defect <= goal {
                return;
            }
            let change = asked.motions.solve(balance.compliance, balance.defect);
            let reach = size(&change);
            let mut share = if reach > 0.5 { 0.5 / reach } else { 1.0 };
            let mut accepted = false;
            for _ in 0..12 {
                let left = self.moved(shear, asked, change.map(|c| c * share));
                if size(&left.defect) < defect * (1.0 - 0.1 * share) {
                    std::mem::swap(shear, &mut self.trial);
                    std::mem::swap(&mut self.on_circle, &mut self.trial_on);
                    balance = left;
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
                for (on, stick) in self.on_circle.iter_mut().zip(&sets.stick) {
                    *on = if defect < 1e-6 * total { 1.0 - stick } else { 0.0 };
                }
                balance = self.moved(shear, asked, [0.0; 3]);
            }
        }
    }

    /// The trial: `shear` after a push by rigid motions, back on its discs.
    fn moved(&mut self, shear: &TangentialField, asked: &Asked<'_>, amounts: [f64; 3]) -> Balance {
        let Self { on_circle, trial, trial_on } = self;
        for field in [&mut trial.x, &mut trial.y, &mut *trial_on] {
            reset(field, asked.bound.len());
        }
        let RigidMotions { rotation, .. } = asked.motions;
        let read = [asked.bound, &shear.x, &shear.y, on_circle, &rotation.x, &rotation.y];
        let write = [&mut trial.x[..], &mut trial.y, trial_on];
        asked.balance(each_cell(&Push(amounts), read, write))
    }
}

/// Resultants that shear is to have under its bounds.
struct Asked<'a> {
    bound: &'a [f64],
    motions: &'a RigidMotions,
    resultant: [f64; 3],
}

impl Asked<'_> {
    fn balance(&self, [x, y, r, xx, yy, rr, xy, xr, yr]: [f64; 9]) -> Balance {
        let found = [x, y, r];
        let defect = [0, 1, 2].map(|mode| self.resultant[mode] - found[mode]);
        Balance { defect: self.motions.loads.only_by_force(defect), compliance: [xx, yy, rr, xy, xr, yr] }
    }
}

/// Shear back to its discs: slipping cells to their circles, others where they stick out.
struct ToDiscs;

impl CellRule<6, 3, 9> for ToDiscs {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [bound, stick, along_x, along_y, around_x, around_y]: [R; 6],
        [x, y, on]: &mut [R; 3],
    ) -> [R; 9] {
        let (zero, one) = (x.all(0.0), x.all(1.0));
        let size = (*x * *x + *y * *y).sqrt();
        let outside = size.if_at_most(bound, zero, one);
        *on = outside.max(one - stick);
        let scale = bound / size;
        let directed = [
            size.if_at_most(zero, along_x * bound, *x * scale),
            size.if_at_most(zero, along_y * bound, *y * scale),
        ];
        *x = on.if_at_most(zero, *x, directed[0]);
        *y = on.if_at_most(zero, *y, directed[1]);
        balance_terms([*x, *y], *on, bound, [around_x, around_y])
    }
}

/// Shear after a push `mu p (sum of modes)`, along the tangent for cells on their circles, and back to the discs.
struct Push([f64; 3]);

impl CellRule<6, 3, 9> for Push {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [bound, x, y, on, around_x, around_y]: [R; 6],
        [to_x, to_y, to_on]: &mut [R; 3],
    ) -> [R; 9] {
        let (zero, one) = (x.all(0.0), x.all(1.0));
        let [shift_x, shift_y, twist] = self.0;
        let push = [(around_x * twist + shift_x) * bound, (around_y * twist + shift_y) * bound];
        let inverse = bound.if_at_most(zero, zero, on / bound);
        let along = [x * inverse, y * inverse];
        let out = push[0] * along[0] + push[1] * along[1];
        let moved = [x + (push[0] - along[0] * out), y + (push[1] - along[1] * out)];
        let size = (moved[0] * moved[0] + moved[1] * moved[1]).sqrt();
        *to_on = on.max(size.if_at_most(bound, zero, one));
        let scale = size.if_at_most(zero, one, to_on.if_at_most(zero, one, bound / size));
        *to_x = moved[0] * scale;
        *to_y = moved[1] * scale;
        balance_terms([*to_x, *to_y], *to_on, bound, [around_x, around_y])
    }
}

/// Contributions of a cell to the resultants, and to their answer to a push.
#[inline(always)]
fn balance_terms<R: Reals>([x, y]: [R; 2], on: R, bound: R, [around_x, around_y]: [R; 2]) -> [R; 9] {
    let zero = x.all(0.0);
    let inverse = bound.if_at_most(zero, zero, on / bound);
    let along = [x * inverse, y * inverse];
    let turned = along[0] * around_x + along[1] * around_y;
    [
        x,
        y,
        x * around_x + y * around_y,
        bound - bound * along[0] * along[0],
        bound - bound * along[1] * along[1],
        bound * (around_x * around_x + around_y * around_y - turned * turned),
        bound * along[0] * along[1] * -1.0,
        bound * (around_x - along[0] * turned),
        bound * (around_y - along[1] * turned),
    ]
}

#[cfg(test)]
mod tests;
