use super::super::super::contact_set::ContactSet;
use super::super::super::prescribed::TangentialLoads;
use super::super::rigid_motions::CellPositions;
use super::*;
use crate::random::Random;

const CELLS: usize = 9;

const MODES: [[bool; 3]; 4] =
    [[true, true, true], [true, true, false], [true, false, false], [false, true, false]];

/// The potential's defect is its gradient, its curvature the derivative of that: difference quotients, with and without rotation
/// and springs, of trial vectors inside and outside of their discs.
#[test]
fn defect_and_curvature_are_derivatives_of_the_potential() {
    let mut random = Random::seeded(11);
    for number in 0..40 {
        let (by_force, springs) = (MODES[number % 4], number % 2 == 0);
        let mut trial = TangentialField::zeros(CELLS);
        (0..CELLS).for_each(|cell| trial.set(cell, [random.between(-2.0, 3.0), random.between(-2.0, 2.0)]));
        let bound: Vec<f64> = (0..CELLS).map(|_| random.log_uniform(0.3, 1.5)).collect();
        let spring = [0, 1, 2].map(|mode| if springs && by_force[mode] { 0.5 + mode as f64 } else { 0.0 });
        let resultant = [0, 1, 2].map(|_| random.between(-3.0, 3.0));
        let loads = TangentialLoads { resultant, by_force, spring, ..TangentialLoads::default() };
        let motions = CellPositions::new(vec![-1.0, 0.0, 1.3], vec![-0.7, 0.1, 0.9], by_force[2])
            .motions_of(&ContactSet::of(CELLS, |_| true), loads);
        let sought = MotionByForce { trial: &trial, bound: &bound, motions: &motions, self_influence: 0.25 };
        let motion = loads.only_by_force([0, 1, 2].map(|_| random.between(-1.0, 1.0)));
        let [xx, yy, rr, xy, xr, yr] = sought.potential(motion).curvature;
        let curvature = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
        let step = 1e-5;
        for direction in (0..3).filter(|&mode| by_force[mode]) {
            let [there, back] = [step, -step].map(|step| {
                let mut moved = motion;
                moved[direction] += step;
                sought.potential(moved)
            });
            let slope = (there.value - back.value) / (2.0 * step);
            // Rounding of sums of order ten over the step; a cell that crosses its circle on the way adds the step.
            assert!((slope - sought.potential(motion).defect[direction]).abs() < 3e-8, "{number}: {slope}");
            for mode in 0..3 {
                let slope = (there.defect[mode] - back.defect[mode]) / (2.0 * step);
                let expected = if by_force[mode] { curvature[mode][direction] } else { 0.0 };
                assert!((slope - expected).abs() < 1e-6, "{number}, {mode} {direction}: {slope} {expected}");
            }
        }
    }
}
