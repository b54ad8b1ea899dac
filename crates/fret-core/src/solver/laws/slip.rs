//! The slip increment of given shear, with the rigid motions that its resultants ask for, and how far all of it is from Coulomb's
//! law: `q = Proj(q + slip / K)`, the projection onto the friction disc (Alart & Curnier 1991), K a cell's self-influence.
//!
//! Motions that follow from a resultant are those under which the projected shear has it: the minimum of a convex potential,
//! found by Newton's method with Armijo's rule.

use std::borrow::Cow;

use super::active_sets::ActiveSets;
use super::friction::{OnDisc, onto_disc};
use super::rigid_motions::RigidMotions;
use super::slip_path::{SlipPath, end_of_chord};
use crate::fields::{CellRule, Reals, TangentialField, each_cell};

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
    /// Rigid motions.
    pub motions: &'a RigidMotions,
    /// Increments of the motions that are prescribed [length]; 0 for the others.
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for the motions that follow from a resultant, at no motion [pressure].
    pub resultant: [f64; 3],
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
    at_end: TangentialField,
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
        let stiffness = 1.0 / problem.self_influence;
        let Self { slip, trial, .. } = self;
        for part in [&mut slip.x, &mut slip.y, &mut trial.x, &mut trial.y] {
            part.resize(bound.len(), 0.0);
        }
        let rotation = motions.rotation.parts();
        let read = [&u.x, &u.y, &before.x, &before.y, &q.x, &q.y, bound, rotation[0], rotation[1]];
        let write = [&mut slip.x[..], &mut slip.y, &mut trial.x, &mut trial.y];
        let rule = PrescribedSlip { motion: problem.motion, stiffness };
        let [trial_squares, bounds, bound_squares] = each_cell(&rule, read, write);
        // Without anything to carry a force a spring keeps its length.
        let mut found = [0, 1, 2].map(|mode| {
            if motions.spring[mode] > 0.0 { problem.resultant[mode] / motions.spring[mode] } else { 0.0 }
        });
        if motions.any_by_force() && bounds > 0.0 {
            let count = bound.len() as f64;
            let scale = Scale { total: bounds, spread: (trial_squares / count).sqrt() + bounds / count };
            let mut guess = motions.only_by_force(guess);
            for _ in 0..MOST_TURNS {
                self.find_trial_at_end(problem, q, guess);
                found = self.motion_by_force(problem, scale, guess.map(|motion| stiffness * motion));
                found = found.map(|motion| motion / stiffness);
                let change = [0, 1, 2].map(|mode| found[mode] - guess[mode]);
                if !problem.path.turns() || size(&change) <= SETTLED * size(&found) {
                    break;
                }
                guess = found;
            }
        }
        let [off] = if problem.path.turns() {
            let Self { slip, at_end, .. } = self;
            at_end.x.resize(bound.len(), 0.0);
            at_end.y.resize(bound.len(), 0.0);
            let turn = problem.path.turn.parts();
            let read = [&q.x, &q.y, bound, turn[0], turn[1], rotation[0], rotation[1]];
            let write = [&mut slip.x[..], &mut slip.y, &mut at_end.x, &mut at_end.y];
            each_cell(&OffLawTurned { motion: found, stiffness }, read, write)
        } else {
            let Self { slip, .. } = self;
            let read = [&q.x, &q.y, bound, rotation[0], rotation[1]];
            each_cell(&OffLaw { motion: found, stiffness }, read, [&mut slip.x, &mut slip.y])
        };
        let motion =
            [0, 1, 2].map(|mode| if motions.by_force[mode] { found[mode] } else { problem.motion[mode] });
        let residual = if bound_squares > 0.0 { (off / bound_squares).sqrt() } else { 0.0 };
        TangentialResidual { motion, residual }
    }

    /// Slip at the end of the increment, up to a factor, packed [length].
    pub fn at_end<'a>(&'a self, path: &SlipPath) -> &'a TangentialField {
        if path.turns() { &self.at_end } else { &self.slip }
    }

    /// What a step is to remove: the slip of cells that stick, the slip at the end of those that slip [length].
    pub fn left_over(&self, path: &SlipPath, sets: &ActiveSets) -> Cow<'_, TangentialField> {
        if !path.turns() {
            return Cow::Borrowed(&self.slip);
        }
        let mut left = self.slip.clone();
        for (left, end) in [(&mut left.x, &self.at_end.x), (&mut left.y, &self.at_end.y)] {
            each_cell(&WhereStuck, [end, &sets.stick], [left]);
        }
        Cow::Owned(left)
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

    /// Root of `sum Proj(trial + motion) . mode + spring x motion = resultant`. Motions are in units of pressure.
    fn motion_by_force(&self, problem: &TangentialProblem<'_>, scale: Scale, guess: [f64; 3]) -> [f64; 3] {
        let motions = problem.motions;
        let mut motion = motions.only_by_force(guess);
        let mut here = self.potential(problem, motion);
        if size(&here.defect) > 0.5 * scale.total {
            // A guess far off: nothing moved may be nearer.
            let at_rest = self.potential(problem, [0.0; 3]);
            if at_rest.value < here.value {
                motion = [0.0; 3];
                here = at_rest;
            }
        }
        for _ in 0..60 {
            let defect = size(&here.defect);
            if defect <= 4e-16 * scale.total {
                break;
            }
            let mut change = motions.solve(here.curvature, here.defect.map(|d| -d));
            let length = size(&change);
            if length > 4.0 * scale.spread {
                change = change.map(|c| c * 4.0 * scale.spread / length);
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
                let there = self.potential(problem, there_motion);
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

    fn potential(&self, problem: &TangentialProblem<'_>, motion: [f64; 3]) -> Potential {
        let TangentialProblem { motions, bound, .. } = *problem;
        let mut potential = if motions.rotates {
            let [around_x, around_y] = motions.rotation.parts();
            let read = [&self.trial.x, &self.trial.y, bound, around_x, around_y];
            let [value, x, y, r, xx, yy, rr, xy, xr, yr] = each_cell(&Turning(motion), read, []);
            Potential { value, defect: [x, y, r], curvature: [xx, yy, rr, xy, xr, yr] }
        } else {
            let read = [&self.trial.x, &self.trial.y, bound];
            let [value, x, y, xx, yy, xy] = each_cell(&Straight([motion[0], motion[1]]), read, []);
            Potential { value, defect: [x, y, 0.0], curvature: [xx, yy, 0.0, xy, 0.0, 0.0] }
        };
        for mode in 0..3 {
            if motions.by_force[mode] {
                let spring = motions.spring[mode] * problem.self_influence;
                potential.value += motion[mode] * (0.5 * spring * motion[mode] - problem.resultant[mode]);
                potential.defect[mode] += spring * motion[mode] - problem.resultant[mode];
                potential.curvature[mode] += spring;
            } else {
                potential.defect[mode] = 0.0;
            }
        }
        potential
    }
}

/// Sizes that the search for motions measures itself by [pressure].
#[derive(Debug, Clone, Copy)]
struct Scale {
    /// Sum of the friction bounds.
    total: f64,
    /// A common size of trial vectors and bounds.
    spread: f64,
}

/// Value, gradient and curvature of the convex potential whose minimum is the rigid motion.
struct Potential {
    value: f64,
    defect: [f64; 3],
    curvature: [f64; 6],
}

fn size(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
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

/// Slip with all motions, and the squared distance of `q` from the projection of `q + slip / K`.
struct OffLaw {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<5, 2, 1> for OffLaw {
    const OPTIONAL: usize = 2;

    #[inline(always)]
    fn at<R: Reals>(
        &self,
        [qx, qy, bound, around_x, around_y]: [R; 5],
        [slip_x, slip_y]: &mut [R; 2],
    ) -> [R; 1] {
        let [shift_x, shift_y, twist] = self.motion;
        *slip_x = *slip_x + around_x * twist + shift_x;
        *slip_y = *slip_y + around_y * twist + shift_y;
        let image = onto_disc([qx + *slip_x * self.stiffness, qy + *slip_y * self.stiffness], bound);
        let off = [qx - image[0], qy - image[1]];
        [off[0] * off[0] + off[1] * off[1]]
    }
}

/// Another value where a cell does not stick.
struct WhereStuck;

impl CellRule<2, 1, 0> for WhereStuck {
    #[inline(always)]
    fn at<R: Reals>(&self, [other, stick]: [R; 2], [value]: &mut [R; 1]) -> [R; 0] {
        *value = other + (*value - other) * stick;
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

/// As [`OffLaw`], by the slip at the end of the increment.
struct OffLawTurned {
    motion: [f64; 3],
    stiffness: f64,
}

impl CellRule<7, 4, 1> for OffLawTurned {
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

/// Sums of the potential without rotation.
struct Straight([f64; 2]);

impl CellRule<3, 0, 6> for Straight {
    #[inline(always)]
    fn at<R: Reals>(&self, [x, y, bound]: [R; 3], _: &mut [R; 0]) -> [R; 6] {
        let on = OnDisc::new([x + self.0[0], y + self.0[1]], bound);
        let [along_x, along_y] = on.along;
        [
            on.potential,
            on.image[0],
            on.image[1],
            on.fraction - on.fraction * along_x * along_x,
            on.fraction - on.fraction * along_y * along_y,
            on.fraction * along_x * along_y * -1.0,
        ]
    }
}

/// Sums of the potential with all three motions.
struct Turning([f64; 3]);

impl CellRule<5, 0, 10> for Turning {
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
mod tests {
    use super::super::super::contact_set::ContactSet;
    use super::super::rigid_motions::CellPositions;
    use super::*;
    use crate::random::Random;

    /// Two cells under bounds of 1 and 3, pulled by 2 along x: the first slips at 1, the second carries the other 1. Its trial is then
    /// 1 with the motion m that it needs: K (1 - 0.25) = m - u.
    #[test]
    fn motion_follows_from_the_force() {
        let contact = ContactSet::of(2, |_| true);
        let positions = CellPositions::new(vec![0.0, 1.0], vec![0.0], false, [true, true, false]);
        let motions = positions.motions_of(&contact);
        let field = |x: [f64; 2]| TangentialField { x: x.to_vec(), y: vec![0.0; 2] };
        let problem = TangentialProblem {
            bound: &[1.0, 3.0],
            before: &TangentialField::zeros(2),
            path: &SlipPath::default(),
            motions: &motions,
            motion: [0.0; 3],
            resultant: [2.0, 0.0, 0.0],
            self_influence: 0.5,
        };
        let mut increment = SlipIncrement::default();
        let (q, u) = (field([1.0, 0.25]), field([0.1, 0.2]));
        let found = increment.find(&problem, &q, &u, [0.0; 3]);
        assert!((found.motion[0] - (0.5 * 0.75 + 0.2)).abs() < 1e-15);
        assert!((increment.slip.x[0] - (found.motion[0] - 0.1)).abs() < 1e-15);
        // The first is on its circle and dragged outward: satisfied. The second is off by 0.75 of bounds of length sqrt 10.
        assert!((found.residual - 0.75 / 10.0_f64.sqrt()).abs() < 1e-15);
        // With the shear of the solution nothing is off.
        let found = increment.find(&problem, &field([1.0, 1.0]), &u, found.motion);
        assert!(found.residual < 1e-15 && (found.motion[0] - 0.2).abs() < 1e-15);
    }

    /// A contact of nine cells at random: what its tangential equations ask for, its shear and its displacement.
    struct Sample {
        bound: Vec<f64>,
        before: TangentialField,
        path: SlipPath,
        motions: RigidMotions,
        motion: [f64; 3],
        resultant: [f64; 3],
        self_influence: f64,
        q: TangentialField,
        u: TangentialField,
    }

    const CELLS: usize = 9;

    impl Sample {
        fn of(random: &mut Random, by_force: [bool; 3], springs: bool, turns: bool) -> Self {
            let mut field = |least: f64, most: f64| {
                let mut field = TangentialField::zeros(CELLS);
                (0..CELLS).for_each(|cell| {
                    field.set(cell, [random.between(least, most), random.between(least, most)]);
                });
                field
            };
            let (q, u, before, last) =
                (field(-0.6, 0.6), field(-0.2, 0.2), field(-0.2, 0.2), field(0.1, 0.4));
            let bound: Vec<f64> = (0..CELLS).map(|_| random.log_uniform(0.3, 1.5)).collect();
            let spring =
                [0, 1, 2].map(|mode| if springs && by_force[mode] { 0.5 + mode as f64 } else { 0.0 });
            let motions =
                CellPositions::new(vec![-1.0, 0.0, 1.3], vec![-0.7, 0.1, 0.9], by_force[2], by_force)
                    .with_springs(by_force, spring)
                    .motions_of(&ContactSet::of(CELLS, |_| true));
            // Resultants that shear within the bounds has.
            let mut resultant = [0.0; 3];
            for cell in 0..CELLS {
                let (size, angle) = (0.8 * bound[cell], random.between(-0.8, 1.0));
                let shear = [size * angle.cos(), size * angle.sin()];
                let around = if by_force[2] { motions.rotation.at(cell) } else { [0.0; 2] };
                for (mode, part) in
                    [shear[0], shear[1], shear[0] * around[0] + shear[1] * around[1]].into_iter().enumerate()
                {
                    resultant[mode] += part;
                }
            }
            let mut path = if turns { SlipPath::straight(CELLS) } else { SlipPath::default() };
            if turns {
                (0..CELLS).for_each(|cell| path.go_on(cell, last.at(cell), (0.4, 0.0, 0.6)));
            }
            let prescribed = [0.3, -0.2, 0.0].map(|part| part * random.uniform());
            let motion = [0, 1, 2].map(|mode| if by_force[mode] { 0.0 } else { prescribed[mode] });
            Self { bound, before, path, motions, motion, resultant, self_influence: 0.25, q, u }
        }

        fn problem(&self) -> TangentialProblem<'_> {
            TangentialProblem {
                bound: &self.bound,
                before: &self.before,
                path: &self.path,
                motions: &self.motions,
                motion: self.motion,
                resultant: self.resultant,
                self_influence: self.self_influence,
            }
        }

        /// Slip with these motions, slip at the end, and the nearest point of the disc to shear that would hold it.
        fn law(&self, motion: [f64; 3], cell: usize) -> [[f64; 2]; 3] {
            let (moved, before, u) = (self.motions.at(motion, cell), self.before.at(cell), self.u.at(cell));
            let slip = [0, 1].map(|axis| moved[axis] - (u[axis] - before[axis]));
            let end = self.path.end_of(cell, slip);
            let trial = [0, 1].map(|axis| self.q.at(cell)[axis] + end[axis] / self.self_influence);
            let length = trial[0].hypot(trial[1]);
            let share = if length > self.bound[cell] { self.bound[cell] / length } else { 1.0 };
            [slip, end, trial.map(|part| part * share)]
        }

        /// By how much the resultants of the projected shear, with what springs take, differ from those that are asked for.
        fn missing(&self, motion: [f64; 3]) -> [f64; 3] {
            let mut missing =
                [0, 1, 2].map(|mode| self.motions.spring[mode] * motion[mode] - self.resultant[mode]);
            for cell in 0..CELLS {
                let [_, _, image] = self.law(motion, cell);
                let around = if self.motions.rotates { self.motions.rotation.at(cell) } else { [0.0; 2] };
                missing[0] += image[0];
                missing[1] += image[1];
                missing[2] += image[0] * around[0] + image[1] * around[1];
            }
            self.motions.only_by_force(missing)
        }
    }

    const MODES: [[bool; 3]; 5] = [
        [true, true, true],
        [true, true, false],
        [true, false, false],
        [false, true, false],
        [false, false, false],
    ];

    /// With the motions that are found the projected shear has the resultants, slip is what the motions leave over, and the residual
    /// is the distance to the projected shear: each by its formula, cell by cell. In other units the same bits.
    #[test]
    fn motions_slip_and_residual_are_those_of_the_law() {
        let mut random = Random::seeded(5);
        for number in 0..200 {
            let sample = Sample::of(&mut random, MODES[number % 5], number % 3 == 0, false);
            let mut increment = SlipIncrement::default();
            let guess = [0, 1, 2].map(|_| random.between(-1.0, 1.0) * 10.0_f64.powi((number % 4) as i32 - 1));
            let found = increment.find(&sample.problem(), &sample.q, &sample.u, guess);
            let total: f64 = sample.bound.iter().sum();
            for missing in sample.missing(found.motion) {
                // Rounding of the sums and of motions that are as large as the guess at the most.
                assert!(missing.abs() < 3e-14 * total, "{number}: {missing:e}");
            }
            let (mut off, mut squares) = (0.0, 0.0);
            for cell in 0..CELLS {
                let [slip, _, image] = sample.law(found.motion, cell);
                let (here, q) = (increment.slip.at(cell), sample.q.at(cell));
                assert!((here[0] - slip[0]).hypot(here[1] - slip[1]) < 1e-14, "{number}, {cell}");
                off += (q[0] - image[0]).powi(2) + (q[1] - image[1]).powi(2);
                squares += sample.bound[cell].powi(2);
            }
            assert!((found.residual - (off / squares).sqrt()).abs() < 1e-13, "{number}");
            // Pressures in a unit of 2^20, lengths in one of 2^-30.
            let (stress, length) = (2.0_f64.powi(-20), 2.0_f64.powi(30));
            let of = |field: &TangentialField, unit: f64| TangentialField {
                x: field.x.iter().map(|value| value * unit).collect(),
                y: field.y.iter().map(|value| value * unit).collect(),
            };
            let mut motions = sample.motions.clone();
            motions.spring = motions.spring.map(|spring| spring * (stress / length));
            let other = Sample {
                bound: sample.bound.iter().map(|bound| bound * stress).collect(),
                before: of(&sample.before, length),
                path: SlipPath::default(),
                motions,
                motion: sample.motion.map(|part| part * length),
                resultant: sample.resultant.map(|part| part * stress),
                self_influence: sample.self_influence * (length / stress),
                q: of(&sample.q, stress),
                u: of(&sample.u, length),
            };
            let scaled =
                increment.find(&other.problem(), &other.q, &other.u, guess.map(|part| part * length));
            assert_eq!(scaled.motion, found.motion.map(|part| part * length), "{number}");
            assert_eq!(scaled.residual, found.residual, "{number}");
        }
    }

    /// The potential's defect is its gradient, its curvature the derivative of that: difference quotients, with and without rotation
    /// and springs, of trial vectors inside and outside of their discs.
    #[test]
    fn defect_and_curvature_are_derivatives_of_the_potential() {
        let mut random = Random::seeded(11);
        for number in 0..40 {
            let sample = Sample::of(&mut random, MODES[number % 4], number % 2 == 0, false);
            let mut increment = SlipIncrement::default();
            increment.find(&sample.problem(), &sample.q, &sample.u, [0.0; 3]);
            let by_force = sample.motions.by_force;
            let motion = sample.motions.only_by_force([0, 1, 2].map(|_| random.between(-1.0, 1.0)));
            let potential = |motion| increment.potential(&sample.problem(), motion);
            let [xx, yy, rr, xy, xr, yr] = potential(motion).curvature;
            let curvature = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
            let step = 1e-5;
            for direction in (0..3).filter(|&mode| by_force[mode]) {
                let [there, back] = [step, -step].map(|step| {
                    let mut moved = motion;
                    moved[direction] += step;
                    potential(moved)
                });
                let slope = (there.value - back.value) / (2.0 * step);
                // Rounding of sums of order ten over the step; a cell that crosses its circle on the way adds the step.
                assert!((slope - potential(motion).defect[direction]).abs() < 3e-8, "{number}: {slope}");
                for mode in 0..3 {
                    let slope = (there.defect[mode] - back.defect[mode]) / (2.0 * step);
                    let expected = if by_force[mode] { curvature[mode][direction] } else { 0.0 };
                    assert!(
                        (slope - expected).abs() < 1e-6,
                        "{number}, {mode} {direction}: {slope} {expected}"
                    );
                }
            }
        }
    }

    /// Where slip turns, the law is about the slip at its end: resultants hold for it, the residual is its distance, and what is left
    /// for a step to remove is slip where cells stick and its end where they slip.
    #[test]
    fn the_law_is_about_the_slip_at_the_end_of_its_path() {
        let mut random = Random::seeded(23);
        let mut turned = 0;
        for number in 0..60 {
            let sample = Sample::of(&mut random, MODES[number % 5], number % 3 == 0, true);
            let mut increment = SlipIncrement::default();
            let found = increment.find(&sample.problem(), &sample.q, &sample.u, [0.1, 0.1, 0.0]);
            let total: f64 = sample.bound.iter().sum();
            for missing in sample.missing(found.motion) {
                // Motions and turn are found in alternation, four rounds; each leaves a fraction of the turn, which is small here.
                assert!(missing.abs() < 2e-3 * total, "{number}: {:e}", missing / total);
            }
            let sets = ActiveSets {
                stick: (0..CELLS).map(|cell| (cell % 2) as f64).collect(),
                ..ActiveSets::default()
            };
            let left = increment.left_over(&sample.path, &sets);
            let (mut off, mut squares) = (0.0, 0.0);
            for cell in 0..CELLS {
                let [slip, end, image] = sample.law(found.motion, cell);
                let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-14;
                assert!(close(increment.slip.at(cell), slip), "{number}, {cell}");
                assert!(close(increment.at_end(&sample.path).at(cell), end), "{number}, {cell}");
                assert!(close(left.at(cell), if cell % 2 == 1 { slip } else { end }), "{number}, {cell}");
                turned += usize::from(end != slip);
                let q = sample.q.at(cell);
                off += (q[0] - image[0]).powi(2) + (q[1] - image[1]).powi(2);
                squares += sample.bound[cell].powi(2);
            }
            assert!((found.residual - (off / squares).sqrt()).abs() < 1e-13, "{number}");
            // On a path that does not turn the end is the slip.
            let straight = SlipPath::default();
            assert_eq!(increment.at_end(&straight), &increment.slip);
            assert_eq!(*increment.left_over(&straight, &sets), increment.slip);
        }
        assert!(turned > 100, "{turned}");
    }

    /// A contact without friction carries nothing: springs keep their lengths, what is driven by a force stays, and nothing is off.
    #[test]
    fn without_bounds_a_spring_keeps_its_length() {
        let mut sample = Sample::of(&mut Random::seeded(3), [true, true, false], false, false);
        sample.bound.fill(0.0);
        sample.motions.spring = [0.5, 0.0, 0.0];
        sample.resultant = [3.0, 0.0, 0.0];
        let found = SlipIncrement::default().find(&sample.problem(), &sample.q, &sample.u, [0.2; 3]);
        assert_eq!(found, TangentialResidual { motion: [6.0, 0.0, 0.0], residual: 0.0 });
    }
}
