mod solutions;

use std::ops::ControlFlow;

use super::super::tests::few_cells::{Asked, Cells, KINDS, by_cell, kinds, size, tractions_of};
use super::*;
use crate::model::TangentialField;
use crate::random::Random;

#[test]
fn a_newton_step_solves_the_equations_linearised_by_difference_quotients() {
    let cells = Cells::new([3, 2], 0.2);
    let mut random = Random::seeded(171);
    let mut seen = [0; 3];
    let mut tried = [0; KINDS];
    while tried.iter().any(|tried| *tried < 12) {
        let kind = random.whole(0, KINDS - 1);
        let asked = kinds(&mut random, &cells, kind);
        let tractions: Vec<[f64; 3]> = (0..cells.count())
            .map(|_| [random.between(-0.1, 1.0), random.between(-0.3, 0.3), random.between(-0.3, 0.3)])
            .collect();
        // Approach and motions under springs follow from the tractions; what follows from forces is free.
        let sum = |k: usize| tractions.iter().map(|traction| traction[k]).sum::<f64>();
        let approach = if asked.total.is_some() {
            random.between(0.3, 1.5)
        } else {
            asked.approach - asked.give * sum(0)
        };
        let motion = [0, 1, 2].map(|mode| match (asked.by_force[mode], asked.spring[mode] > 0.0) {
            (false, _) => asked.motion[mode],
            (true, true) => (asked.resultant[mode] - sum(1 + mode)) / asked.spring[mode],
            (true, false) => random.between(-0.3, 0.3),
        });
        // Away from the kinks: difference quotients do not step across.
        let trials = asked.trials(&cells, (&tractions, approach, motion));
        let near = |(augmented, trial, bound): &(f64, [f64; 2], f64)| {
            let mu_p = 0.5 * augmented;
            augmented.abs() < 1e-3
                || (trial[0].hypot(trial[1]) - bound).abs() < 1e-3
                || (mu_p - asked.strength).abs() < 1e-3
        };
        // What may change of the shear: two components in stick, one in slip. It has to hold the forces with something to spare: of few
        // slipping cells the motions are nearly dependent.
        let touching = trials.iter().filter(|trial| trial.0 > 0.0);
        let free: usize =
            touching.map(|(_, trial, bound)| if trial[0].hypot(trial[1]) > *bound { 1 } else { 2 }).sum();
        let held = (0..3).filter(|&mode| asked.by_force[mode] && asked.spring[mode] == 0.0).count();
        let is_pressed = (0..cells.count()).any(|cell| trials[cell].0 > 0.0 && tractions[cell][0] > 0.0);
        if trials.iter().any(near) || free == 0 || !is_pressed || (held > 0 && free < held + 2) {
            continue;
        }
        for (augmented, trial, bound) in &trials {
            seen[if *augmented < 0.0 { 0 } else { 1 + usize::from(trial[0].hypot(trial[1]) > *bound) }] += 1;
        }
        tried[kind] += 1;
        asked.problem(&cells, |problem| {
            let mut operators = cells.operators();
            let mut newton = AugmentedNewton::new(problem, &tractions_of(&tractions), &mut operators);
            (newton.here.approach, newton.here.motion) = (approach, motion);
            // The tests know no units of shear, but those of pressure.
            newton.equations.weight = 1.0;
            let here = asked.left(&cells, (&tractions, approach, motion));
            let merit = newton.equations.merit(&newton.here);
            assert!((merit - size(&here)).abs() < 1e-12 * merit, "kind {kind}: {merit} {here:?}");
            let settings = SolverSettings::new(1e-16);
            let next = newton.equations.newton_point(&newton.here, &mut operators, &settings, 1e-14).unwrap();
            let there = by_cell(next.tractions.parts());
            for mode in 0..3 {
                assert!(asked.by_force[mode] || next.motion[mode] == asked.motion[mode]);
            }
            // Along the way there, from a step of 2e-6 to both sides: as far as every set stays.
            let ways = there.as_flattened().iter().zip(tractions.as_flattened()).map(|(a, b)| a - b);
            let turns = (0..3).map(|mode| next.motion[mode] - motion[mode]);
            let way = 1.0 + size(&ways.chain(turns).chain([next.approach - approach]).collect::<Vec<_>>());
            let step = 2e-6 / way;
            let at = |fraction: f64| {
                let between = |a: f64, b: f64| a + fraction * (b - a);
                let part: Vec<[f64; 3]> = (0..cells.count())
                    .map(|cell| [0, 1, 2].map(|k| between(tractions[cell][k], there[cell][k])))
                    .collect();
                let turned = [0, 1, 2].map(|mode| between(motion[mode], next.motion[mode]));
                asked.left(&cells, (&part, between(approach, next.approach), turned))
            };
            let [ahead, back] = [at(step), at(-step)];
            for (equation, here) in here.iter().enumerate() {
                let change = (ahead[equation] - back[equation]) / (2.0 * step);
                // Curvature of the discs, whose radius may be 1e-3, and rounding over the step.
                assert!(
                    (here + change).abs() < 1e-6 * way,
                    "kind {kind}, equation {equation}: {here} {change} on a way of {way}, {trials:?}"
                );
            }
        });
    }
    assert!(seen.iter().all(|seen| *seen > 50), "open, sticking, slipping: {seen:?}");
}

#[test]
fn a_part_of_a_step_is_that_part_of_every_unknown() {
    let point = |start: f64| {
        let mut next = start;
        let mut values = |count: usize| -> Vec<f64> {
            (0..count)
                .map(|_| {
                    next += 1.0;
                    next * next
                })
                .collect()
        };
        let shear = TangentialField { x: values(2), y: values(2) };
        let tangential = TangentialField { x: values(2), y: values(2) };
        Point {
            tractions: Tractions { pressure: values(2), shear },
            displacements: Displacements { normal: values(2), tangential },
            approach: values(1)[0],
            turned: [values(1)[0], values(1)[0]],
            motion: [0, 1, 2].map(|_| values(1)[0]),
        }
    };
    let numbers = |point: &Point| {
        let parts = point.tractions.parts().into_iter().chain(point.displacements.parts());
        let fields: Vec<f64> = parts.flatten().copied().collect();
        fields.into_iter().chain([point.approach]).chain(point.turned).chain(point.motion).collect::<Vec<_>>()
    };
    let (here, there) = (point(0.0), point(40.0));
    // whole numbers and a quarter: nothing is rounded
    let found = numbers(&here.towards(&there, 0.25));
    let exact: Vec<f64> =
        numbers(&here).iter().zip(numbers(&there)).map(|(a, b)| 0.75 * a + 0.25 * b).collect();
    assert_eq!(found, exact);
    assert_eq!(found.len(), 18);
}

#[test]
fn from_a_solution_nothing_is_solved_again() {
    let mut random = Random::seeded(174);
    let settings = SolverSettings::new(1e-8);
    let cells = Cells::new([3, 3], 0.3);
    for kind in [0, 1, 3] {
        let asked = kinds(&mut random, &cells, kind);
        asked.problem(&cells, |problem| {
            let mut operators = cells.operators();
            let mut tractions = Tractions { pressure: vec![0.5; 9], ..Tractions::zeros(9) };
            let mut solve = |tractions: &mut Tractions| {
                let mut newton = AugmentedNewton::new(problem, tractions, &mut operators);
                let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
                assert!(newton.advance(1e-10, &mut operators, &settings, go_on).unwrap());
                newton.projected(tractions, &mut Displacements::zeros(9), &mut operators);
                (newton.here.approach, newton.here.motion, newton.steps)
            };
            let (approach, motion, solves) = solve(&mut tractions);
            assert!(solves > 1, "{solves}");
            let again = solve(&mut tractions);
            assert_eq!(again.2, 0, "kind {kind}");
            assert!((again.0 - approach).abs() < 1e-9, "kind {kind}: {} {approach}", again.0);
            for mode in 0..2 {
                assert!((again.1[mode] - motion[mode]).abs() < 1e-8, "kind {kind}: {:?} {motion:?}", again.1);
            }
        });
    }
}

/// Elasticity is linear and friction has no scale: heights, motions and forces a power of two larger or smaller bring tractions
/// that are so many times larger or smaller, to the bit and in as many steps.
#[test]
fn the_same_steps_in_every_unit() {
    let cells = Cells::new([3, 3], 0.3);
    for kind in [0, 1, 2, 3, 5, 6, 9] {
        let solved = |unit: f64| {
            let asked = kinds(&mut Random::seeded(176 + kind as u64), &cells, kind).in_units(unit);
            asked.problem(&cells, |problem| {
                let mut operators = cells.operators();
                let tractions = Tractions { pressure: vec![0.5 * unit; 9], ..Tractions::zeros(9) };
                let settings = SolverSettings::new(1e-8);
                let mut residuals = Vec::new();
                let mut newton = AugmentedNewton::new(problem, &tractions, &mut operators);
                let note: IterationCallback<'_> = &mut |_, residual| {
                    residuals.push(residual);
                    ControlFlow::Continue(())
                };
                let found = newton.advance(1e-10, &mut operators, &settings, note).unwrap();
                let parts = newton
                    .here
                    .tractions
                    .parts()
                    .map(|part| part.iter().map(|value| value / unit).collect::<Vec<_>>());
                (found, residuals, parts)
            })
        };
        let plain = solved(1.0);
        for unit in [2.0_f64.powi(-40), 2.0_f64.powi(30)] {
            assert_eq!(solved(unit), plain, "kind {kind}, unit {unit:e}");
        }
    }
}

#[test]
fn what_is_stopped_is_not_solved() {
    let cells = Cells::new([3, 2], 0.3);
    let asked = Asked::drawn(&mut Random::seeded(175), &cells);
    asked.problem(&cells, |problem| {
        let start = Tractions { pressure: vec![0.5; 6], ..Tractions::zeros(6) };
        let solve = |most: usize, go_on: IterationCallback<'_>| {
            let settings = SolverSettings { max_newton_iterations: most, ..SolverSettings::new(1e-8) };
            let (mut tractions, mut displacements) = (Tractions::zeros(6), Displacements::zeros(6));
            let (ends, mut operators) = ((&mut tractions, &mut displacements), cells.operators());
            let solved = AugmentedNewton::new(problem, &start, &mut operators).solve(
                ends,
                &mut operators,
                &settings,
                go_on,
            );
            solved.map(|solution| solution.is_some())
        };
        let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
        assert_eq!([solve(1, go_on), solve(60, go_on)], [Ok(false), Ok(true)]);
        assert_eq!(solve(60, &mut |_, _| ControlFlow::Break(())), Err(SolveError::Stopped));
    });
}

/// Tension and shear beyond the discs, and shear of cells whose trial slips, go where the laws allow them: resultants, cells and directions.
#[test]
fn what_rounding_leaves_of_tension_and_of_too_much_shear_is_taken_away() {
    let cells = Cells::new([3, 1], 0.3);
    let asked = Asked { friction: vec![0.5; 3], ..Asked::drawn(&mut Random::seeded(176), &cells) };
    asked.problem(&cells, |problem| {
        let mut operators = cells.operators();
        let mut tractions = tractions_of(&[[-1e-13, 1e-13, 0.0], [1.0, 0.3, 0.4 + 1e-12], [1.0, 0.3, 0.0]]);
        let newton = AugmentedNewton::new(problem, &tractions.clone(), &mut operators);
        newton.projected(&mut tractions, &mut Displacements::zeros(3), &mut operators);
        let [open, slipping, sticking] = by_cell(tractions.parts())[..] else { unreachable!() };
        assert_eq!(open, [0.0; 3]);
        assert!((slipping[1].hypot(slipping[2]) - 0.5).abs() < 1e-15, "{slipping:?}");
        assert!((slipping[1] / slipping[2] - 0.75).abs() < 1e-11, "{slipping:?}");
        assert_eq!(sticking, [1.0, 0.3, 0.0]);
    });
}
