//! The rigid motions that follow from resultants: those under which the projected shear has them, the minimum of a convex potential,
//! found by Newton's method with Armijo's rule.

use super::friction::OnDisc;
use super::rigid_motions::{RigidMotions, size};
use crate::fields::{CellRule, Reals, TangentialField, each_cell};

/// What the motions follow from, packed over the cells in contact; all in units of pressure.
#[derive(Debug, Clone, Copy)]
pub struct MotionByForce<'a> {
    /// Vectors `q + slip / K` before these motions.
    pub trial: &'a TangentialField,
    /// Friction bound.
    pub bound: &'a [f64],
    /// Rigid motions, with what is prescribed of them.
    pub motions: &'a RigidMotions,
    /// Influence of a cell's shear on its own displacement [length/pressure]: what a motion of a unit of pressure moves.
    pub self_influence: f64,
}

/// Sizes that the search for motions measures itself by [pressure].
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// Sum of the friction bounds.
    pub total: f64,
    /// A common size of trial vectors and bounds.
    pub spread: f64,
}

/// Value, gradient and curvature of the convex potential whose minimum is the rigid motion.
struct Potential {
    value: f64,
    defect: [f64; 3],
    curvature: [f64; 6],
}

/// Steps of the search at the most; where springs pull, whose far ends may be anywhere, so many more.
const MOST_STEPS: usize = 60;
const MOST_STEPS_TO_SPRINGS: usize = 60;
/// Longest step, in units of the common size of trial vectors and bounds; where springs pull it doubles after so many that were cut short.
const LONGEST_STEP: f64 = 4.0;
const MOST_CUT_SHORT: usize = 58;

impl MotionByForce<'_> {
    /// Root of `sum Proj(trial + motion) . mode + spring x motion = resultant`, from a guess.
    pub fn find(&self, scale: Scale, guess: [f64; 3]) -> [f64; 3] {
        let motions = self.motions;
        let mut motion = motions.loads.only_by_force(guess);
        let mut here = self.potential(motion);
        if size(&here.defect) > 0.5 * scale.total {
            // A guess far off: nothing moved may be nearer.
            let at_rest = self.potential([0.0; 3]);
            if at_rest.value < here.value {
                motion = [0.0; 3];
                here = at_rest;
            }
        }
        let mut longest = LONGEST_STEP * scale.spread;
        let mut cut_short = 0;
        let springs = if motions.loads.any_spring() { MOST_STEPS_TO_SPRINGS } else { 0 };
        for step in 0..MOST_STEPS + springs {
            if step == MOST_STEPS && cut_short <= MOST_CUT_SHORT {
                break;
            }
            let defect = size(&here.defect);
            if defect <= 4e-16 * scale.total {
                break;
            }
            let mut change = motions.solve(here.curvature, here.defect.map(|d| -d));
            let length = size(&change);
            if length > longest {
                change = change.map(|c| c * longest / length);
                cut_short += 1;
                if springs > 0 && cut_short > MOST_CUT_SHORT {
                    longest *= 2.0;
                }
            }
            let slope: f64 = change.iter().zip(&here.defect).map(|(c, d)| c * d).sum();
            if slope >= 0.0 {
                break;
            }
            let slack = 1e-15 * (here.value.abs() + scale.total * scale.spread);
            let mut fraction = 1.0;
            let mut accepted = false;
            for _ in 0..30 {
                let there_motion = [0, 1, 2].map(|mode| motion[mode] + fraction * change[mode]);
                let there = self.potential(there_motion);
                if there.value <= here.value + 1e-4 * fraction * slope
                    || (there.value <= here.value + slack && size(&there.defect) < defect)
                {
                    motion = there_motion;
                    here = there;
                    accepted = true;
                    break;
                }
                fraction *= 0.5;
            }
            if !accepted || (size(&here.defect) > 0.5 * defect && size(&here.defect) < 1e-14 * scale.total) {
                break;
            }
        }
        motion
    }

    /// By how much the resultants under a motion miss what springs pull with, over the sum of the bounds; 0 where it is rounding.
    pub fn missed_by_springs(&self, scale: Scale, motion: [f64; 3]) -> f64 {
        if !self.motions.loads.any_spring() {
            return 0.0;
        }
        let missed = size(&self.potential(motion).defect);
        let rounding = 1e-9 * scale.total + 1e-13 * size(&self.motions.loads.resultant);
        if missed > rounding { missed / scale.total } else { 0.0 }
    }

    fn potential(&self, motion: [f64; 3]) -> Potential {
        let Self { trial, bound, motions, .. } = *self;
        let (loads, [around_x, around_y]) = (motions.loads, motions.rotation.parts());
        let read = [&trial.x, &trial.y, bound, around_x, around_y];
        let [value, x, y, r, xx, yy, rr, xy, xr, yr] = each_cell(&OnDiscs(motion), read, []);
        let mut potential = Potential { value, defect: [x, y, r], curvature: [xx, yy, rr, xy, xr, yr] };
        for mode in 0..3 {
            if loads.by_force[mode] {
                let spring = loads.spring[mode] * self.self_influence;
                potential.value += motion[mode] * (0.5 * spring * motion[mode] - loads.resultant[mode]);
                potential.defect[mode] += spring * motion[mode] - loads.resultant[mode];
                potential.curvature[mode] += spring;
            } else {
                potential.defect[mode] = 0.0;
            }
        }
        potential
    }
}

/// Sums of the potential, its defect and its curvature under motions.
struct OnDiscs([f64; 3]);

impl CellRule<5, 0, 10> for OnDiscs {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, bound, around_x, around_y]: [R; 5], _: &mut [R; 0]) -> [R; 10] {
        let [shift_x, shift_y, twist] = self.0;
        let on = OnDisc::new([x + (around_x * twist + shift_x), y + (around_y * twist + shift_y)], bound);
        let [along_x, along_y] = on.along;
        let turned = along_x * around_x + along_y * around_y;
        [
            on.potential,
            on.image[0],
            on.image[1],
            on.image[0] * around_x + on.image[1] * around_y,
            on.fraction - on.fraction * along_x * along_x,
            on.fraction - on.fraction * along_y * along_y,
            on.fraction * (around_x * around_x + around_y * around_y - turned * turned),
            on.fraction * along_x * along_y * -1.0,
            on.fraction * (around_x - along_x * turned),
            on.fraction * (around_y - along_y * turned),
        ]
    }
}

#[cfg(test)]
mod tests;
