use super::super::super::contact_set::ContactSet;
use super::super::super::prescribed::TangentialLoads;
use super::super::rigid_motions::CellPositions;
use super::*;
use crate::random::Random;

/// Two cells under bounds of 1 and 3, pulled by 2 along x: the first slips at 1, the second carries the other 1. Its trial is then
/// 1 with the motion m that it needs: K (1 - 0.25) = m - u.
#[test]
fn motion_follows_from_the_force() {
    let contact = ContactSet::of(2, |_| true);
    let loads = TangentialLoads {
        by_force: [true, true, false],
        resultant: [2.0, 0.0, 0.0],
        ..TangentialLoads::default()
    };
    let motions = CellPositions::new(vec![0.0, 1.0], vec![0.0], false).motions_of(&contact, loads);
    let field = |x: [f64; 2]| TangentialField { x: x.to_vec(), y: vec![0.0; 2] };
    let problem = TangentialProblem {
        bound: &[1.0, 3.0],
        before: &TangentialField::zeros(2),
        path: &SlipPath::default(),
        motions: &motions,
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
        let (q, u, before, last) = (field(-0.6, 0.6), field(-0.2, 0.2), field(-0.2, 0.2), field(0.1, 0.4));
        let bound: Vec<f64> = (0..CELLS).map(|_| random.log_uniform(0.3, 1.5)).collect();
        let spring = [0, 1, 2].map(|mode| if springs && by_force[mode] { 0.5 + mode as f64 } else { 0.0 });
        let loads = TangentialLoads { by_force, spring, ..TangentialLoads::default() };
        let mut motions = CellPositions::new(vec![-1.0, 0.0, 1.3], vec![-0.7, 0.1, 0.9], by_force[2])
            .motions_of(&ContactSet::of(CELLS, |_| true), loads);
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
        motions.loads.motion = [0, 1, 2].map(|mode| if by_force[mode] { 0.0 } else { prescribed[mode] });
        motions.loads.resultant = resultant;
        Self { bound, before, path, motions, self_influence: 0.25, q, u }
    }

    fn problem(&self) -> TangentialProblem<'_> {
        TangentialProblem {
            bound: &self.bound,
            before: &self.before,
            path: &self.path,
            motions: &self.motions,
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
        let loads = self.motions.loads;
        let mut missing = [0, 1, 2].map(|mode| loads.spring[mode] * motion[mode] - loads.resultant[mode]);
        for cell in 0..CELLS {
            let [_, _, image] = self.law(motion, cell);
            let around = if self.motions.rotates { self.motions.rotation.at(cell) } else { [0.0; 2] };
            missing[0] += image[0];
            missing[1] += image[1];
            missing[2] += image[0] * around[0] + image[1] * around[1];
        }
        loads.only_by_force(missing)
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
        motions.loads = TangentialLoads {
            motion: motions.loads.motion.map(|part| part * length),
            resultant: motions.loads.resultant.map(|part| part * stress),
            spring: motions.loads.spring.map(|spring| spring * (stress / length)),
            ..motions.loads
        };
        let other = Sample {
            bound: sample.bound.iter().map(|bound| bound * stress).collect(),
            before: of(&sample.before, length),
            path: SlipPath::default(),
            motions,
            self_influence: sample.self_influence * (length / stress),
            q: of(&sample.q, stress),
            u: of(&sample.u, length),
        };
        let scaled = increment.find(&other.problem(), &other.q, &other.u, guess.map(|part| part * length));
        assert_eq!(scaled.motion, found.motion.map(|part| part * length), "{number}");
        assert_eq!(scaled.residual, found.residual, "{number}");
    }
}

/// Where slip turns, the law is about the slip at its end: resultants hold for it, the residual is its distance, and what is left
/// for a step to remove is slip where cells stick and, where they slip, the part of its end across the shear.
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
        let mut sets = ActiveSets::default();
        sets.stick = (0..CELLS).map(|cell| (cell % 2) as f64).collect();
        sets.slip = sets.stick.iter().map(|stick| 1.0 - stick).collect();
        sets.direction = sample.q.clone();
        sets.turn(&sample.path, &increment.slip);
        let mut left = TangentialField::default();
        increment.find_left_over(&sets, &mut left);
        let [row_x, row_y] = sets.rows();
        // What stands across a direction.
        let across = |along: [f64; 2], of: [f64; 2]| along[0] * of[1] - along[1] * of[0];
        let (mut off, mut squares) = (0.0, 0.0);
        for cell in 0..CELLS {
            let [slip, end, image] = sample.law(found.motion, cell);
            let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-14;
            assert!(close(increment.slip.at(cell), slip), "{number}, {cell}");
            assert!(close(increment.at_end.at(cell), end), "{number}, {cell}");
            if cell % 2 == 1 {
                assert!(close(left.at(cell), slip), "{number}, {cell}");
            } else {
                let row = [row_x[cell], row_y[cell]];
                let off = across(row, left.at(cell)) - across(sample.q.at(cell), end);
                assert!(off.abs() < 1e-14, "{number}, {cell}: {off:e}");
            }
            turned += usize::from(end != slip);
            let q = sample.q.at(cell);
            off += (q[0] - image[0]).powi(2) + (q[1] - image[1]).powi(2);
            squares += sample.bound[cell].powi(2);
        }
        assert!((found.residual - (off / squares).sqrt()).abs() < 1e-13, "{number}");
        // On a path that does not turn the end is the slip.
        let straight = SlipPath::default();
        increment.find(
            &TangentialProblem { path: &straight, ..sample.problem() },
            &sample.q,
            &sample.u,
            [0.0; 3],
        );
        assert_eq!(increment.at_end, increment.slip);
        sets.turn(&straight, &increment.slip);
        let mut left = TangentialField::default();
        increment.find_left_over(&sets, &mut left);
        assert_eq!(left, increment.slip);
    }
    assert!(turned > 100, "{turned}");
}

/// A contact without friction carries nothing: springs keep their lengths, what is driven by a force stays, and nothing is off.
#[test]
fn without_bounds_a_spring_keeps_its_length() {
    let mut sample = Sample::of(&mut Random::seeded(3), [true, true, false], false, false);
    sample.bound.fill(0.0);
    sample.motions.loads.spring = [0.5, 0.0, 0.0];
    sample.motions.loads.resultant = [3.0, 0.0, 0.0];
    let found = SlipIncrement::default().find(&sample.problem(), &sample.q, &sample.u, [0.2; 3]);
    assert_eq!(found, TangentialResidual { motion: [6.0, 0.0, 0.0], residual: 0.0 });
}
