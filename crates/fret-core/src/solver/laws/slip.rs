//! The slip increment of given shear, with the rigid motions that its resultants ask for, and how far all of it is from Coulomb's
//! law: `q = Proj(q + slip / K)`, the projection onto the friction disc (Alart & Curnier 1991), K a cell's self-influence.

use super::active_sets::ActiveSets;
use super::friction::onto_disc;
use super::motion_by_force::{MotionByForce, Scale};
use super::rigid_motions::{RigidMotions, size};
use super::slip_path::{SlipPath, end_of_chord};
use crate::fields::{CellRule, Reals, TangentialField, convert, each_cell, reset};

/// Rounds in which motions and the turn of slip are found in alternation. What is left over after them is part of the residual.
const MOST_TURNS: usize = 4;
/// Change of motions that is rounding.
const SETTLED: f64 = 1e-15;

/// What the tangential equations of one increment ask for; fields are packed over the cells in contact.
#[derive(Debug, Clone, Copy)]
pub struct TangentialProblem<'a> {
    /// Friction bound [pressure].
    pub bound: &'a [f64],
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// What is known of the paths of slip.
    pub path: &'a SlipPath,
    /// Rigid motions, with what is prescribed of them.
    pub motions: &'a RigidMotions,
    /// Influence of a cell's shear on its own displacement [length/pressure].
    pub self_influence: f64,
}

/// How well shear satisfies Coulomb's law, and the motions found on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialResidual {
    /// Increments of shift (x, y) and of twist x length [length].
    pub motion: [f64; 3],
    /// `|q - Proj(q + slip / K)| / |b|`, Euclidean norms over the cells.
    pub residual: f64,
}

/// The slip increment of the cells in contact.
#[derive(Debug, Default)]
pub struct SlipIncrement {
    /// Slip of the upper body over the lower in the increment, packed [length].
    pub slip: TangentialField,
    /// Slip at the end of the increment, up to a factor: what the friction law is about, packed [length].
    pub at_end: TangentialField,
    /// Vectors `q + slip / K` before the motions that follow from resultants [pressure].
    trial: TangentialField,
}

impl SlipIncrement {
    /// Finds slip, motions and residual of shear `q` with displacement `u`; `guess` starts the search for the motions.
    pub fn find(
        &mut self,
        problem: &TangentialProblem<'_>,
        q: &TangentialField,
        u: &TangentialField,
        guess: [f64; 3],
    ) -> TangentialResidual {
        let TangentialProblem { bound, before, motions, .. } = *problem;
        let loads = motions.loads;
        let stiffness = 1.0 / problem.self_influence;
        let Self { slip, trial, .. } = self;
        for part in [&mut slip.x, &mut slip.y, &mut trial.x, &mut trial.y] {
            reset(part, bound.len());
        }
        let rotation = motions.rotation.parts();
        let read = [&u.x, &u.y, &before.x, &before.y, &q.x, &q.y, bound, rotation[0], rotation[1]];
        let write = [&mut slip.x[..], &mut slip.y, &mut trial.x, &mut trial.y];
        let rule = PrescribedSlip { motion: loads.motion, stiffness };
        let [trial_squares, bounds, bound_squares] = each_cell(&rule, read, write);
        // Without anything to carry a force a spring keeps its length.
        let mut missed = 0.0;
        let mut found = [0, 1, 2].map(|mode| {
            if loads.spring[mode] > 0.0 { loads.resultant[mode] / loads.spring[mode] } else { 0.0 }
        });
        if loads.any_by_force() && bounds > 0.0 {
            let count = bound.len() as f64;
            let scale = Scale { total: bounds, spread: (trial_squares / count).sqrt() + bounds / count };
            let mut guess = loads.only_by_force(guess);
            for _ in 0..MOST_TURNS {
                self.find_trial_at_end(problem, q, guess);
                found = self.by_force(problem).find(scale, guess.map(|motion| stiffness * motion));
                found = found.map(|motion| motion / stiffness);
                let change = [0, 1, 2].map(|mode| found[mode] - guess[mode]);
                if !problem.path.turns() || size(&change) <= SETTLED * size(&found) {
                    break;
                }
                guess = found;
            }
            missed = self.by_force(problem).missed_by_springs(scale, found.map(|motion| stiffness * motion));
        }
        let Self { slip, at_end, .. } = self;
        reset(&mut at_end.x, bound.len());
        reset(&mut at_end.y, bound.len());
        let straight = vec![0.0; if problem.path.turns() { 0 } else { bound.len() }];
        let turn = if problem.path.turns() { problem.path.turn.parts() } else { [&straight[..]; 2] };
        let read = [&q.x, &q.y, bound, turn[0], turn[1], rotation[0], rotation[1]];
        let write = [&mut slip.x[..], &mut slip.y, &mut at_end.x, &mut at_end.y];
        let [off] = each_cell(&OffLaw { motion: found, stiffness }, read, write);
        let motion =
            [0, 1, 2].map(|mode| if loads.by_force[mode] { found[mode] } else { loads.motion[mode] });
        let residual = if bound_squares > 0.0 { (off / bound_squares).sqrt() } else { 0.0 };
        TangentialResidual { motion, residual: residual.max(missed) }
    }

    /// What a step is to remove [length]: the slip of cells that stick; of those that slip the part across the shear of the slip at the end, as
    /// a vector whose part across the row of the cell it is. It lies where the trial vectors were, which are found anew with the next slip.
    pub fn left_over(&mut self, sets: &ActiveSets) -> &mut TangentialField {
        let left = &mut self.trial;
        for (left, slip) in left.each_mut().into_iter().zip(self.slip.parts()) {
            reset(left, slip.len());
            convert(slip, 1.0, left);
        }
        if let Some([row_x, row_y]) = sets.turned() {
            let ([end_x, end_y], [along_x, along_y]) = (self.at_end.parts(), sets.direction.parts());
            let read = [&sets.slip, end_x, end_y, along_x, along_y, row_x, row_y];
            each_cell(&AcrossRows, read, left.parts_mut());
        }
        left
    }

    fn by_force<'a>(&'a self, problem: &TangentialProblem<'a>) -> MotionByForce<'a> {
        let TangentialProblem { bound, motions, self_influence, .. } = *problem;
        MotionByForce { trial: &self.trial, bound, motions, self_influence }
    }

    /// The trial vectors whose slip is turned on as far as it is with motions `guess`: of a path that does not turn as they are.
    fn find_trial_at_end(&mut self, problem: &TangentialProblem<'_>, q: &TangentialField, guess: [f64; 3]) {
        if !problem.path.turns() {
            return;
        }
        let Self { slip, trial, .. } = self;
        let ([turn_x, turn_y], [around_x, around_y]) =
            (problem.path.turn.parts(), problem.motions.rotation.parts());
        let read = [&slip.x, &slip.y, &q.x, &q.y, turn_x, turn_y, around_x, around_y];
        let rule = TrialAtEnd { guess, stiffness: 1.0 / problem.self_influence };
        each_cell(&rule, read, [&mut trial.x, &mut trial.y]);
    }
}

/// Slip without the motions that follow from resultants, and the vectors `q + slip / K`.
struct PrescribedSlip {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<9, 4, 3> for PrescribedSlip {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [ux, uy, before_x, before_y, qx, qy, bound, around_x, around_y]: [R; 9],
        [slip_x, slip_y, trial_x, trial_y]: &mut [R; 4],
    ) -> [R; 3] {
        let [shift_x, shift_y, twist] = self.motion;
        *slip_x = around_x * twist + shift_x + before_x - ux;
        *slip_y = around_y * twist + shift_y + before_y - uy;
        *trial_x = qx + *slip_x * self.stiffness;
        *trial_y = qy + *slip_y * self.stiffness;
        [*trial_x * *trial_x + *trial_y * *trial_y, bound, bound * bound]
    }
}

/// Where a cell slips, the vector whose part across its row is that of the slip at the end across the shear.
struct AcrossRows;

impl CellRule<7, 2, 0> for AcrossRows {
    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [slips, end_x, end_y, along_x, along_y, row_x, row_y]: [R; 7],
        [x, y]: &mut [R; 2],
    ) -> [R; 0] {
        let zero = slips.all(0.0);
        let across = (along_x * end_y - along_y * end_x) / (row_x * row_x + row_y * row_y);
        *x = slips.if_at_most(zero, *x, row_y * across * -1.0);
        *y = slips.if_at_most(zero, *y, row_x * across);
        []
    }
}

/// Vectors `q + slip at the end / K` before the motions that follow from resultants, turned on by as much as with motions `guess`.
struct TrialAtEnd {
    guess: [f64; 3],
    stiffness: f64,
}

impl CellRule<8, 2, 0> for TrialAtEnd {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [slip_x, slip_y, qx, qy, turn_x, turn_y, around_x, around_y]: [R; 8],
        [trial_x, trial_y]: &mut [R; 2],
    ) -> [R; 0] {
        let [shift_x, shift_y, twist] = self.guess;
        let moved = [slip_x + around_x * twist + shift_x, slip_y + around_y * twist + shift_y];
        let end = end_of_chord(moved, [turn_x, turn_y]);
        *trial_x = qx + (slip_x + end[0] - moved[0]) * self.stiffness;
        *trial_y = qy + (slip_y + end[1] - moved[1]) * self.stiffness;
        []
    }
}

/// Slip with all motions, slip at the end, and the squared distance of `q` from the projection of `q + slip at the end / K`.
struct OffLaw {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<7, 4, 1> for OffLaw {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [qx, qy, bound, turn_x, turn_y, around_x, around_y]: [R; 7],
        [slip_x, slip_y, end_x, end_y]: &mut [R; 4],
    ) -> [R; 1] {
        let [shift_x, shift_y, twist] = self.motion;
        *slip_x = *slip_x + around_x * twist + shift_x;
        *slip_y = *slip_y + around_y * twist + shift_y;
        [*end_x, *end_y] = end_of_chord([*slip_x, *slip_y], [turn_x, turn_y]);
        let image = onto_disc([qx + *end_x * self.stiffness, qy + *end_y * self.stiffness], bound);
        let off = [qx - image[0], qy - image[1]];
        [off[0] * off[0] + off[1] * off[1]]
    }
}

#[cfg(test)]
mod tests;
