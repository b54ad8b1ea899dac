//! Solutions of few cells, against all contact sets tried in turn and against a plain iteration.

use std::ops::ControlFlow;

use super::super::super::settings::{IterationCallback, SolverSettings};
use super::super::super::tests::few_cells::{Asked, Cells, by_cell, size, tractions_of};
use super::super::super::tractions::{Displacements, Tractions};
use super::super::AugmentedNewton;
use crate::random::Random;

/// Solves `matrix x = right` by elimination with row exchange; `None` where there is no pivot.
fn eliminated(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let count = right.len();
    for column in 0..count {
        let pivot =
            (column..count).max_by(|a, b| matrix[*a][column].abs().total_cmp(&matrix[*b][column].abs()))?;
        if matrix[pivot][column].abs() < 1e-12 {
            return None;
        }
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        for row in column + 1..count {
            let factor = matrix[row][column] / matrix[column][column];
            let above = matrix[column].clone();
            for (value, above) in matrix[row].iter_mut().zip(&above).skip(column) {
                *value -= factor * above;
            }
            right[row] -= factor * right[column];
        }
    }
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    Some(right)
}

/// All solutions of a row of cells along x, sheared along x: every cell open, sticking, or slipping to either side, all of it tried.
/// Pressures and shears, the approach last.
fn enumerated(cells: &Cells, asked: &Asked) -> Vec<Vec<f64>> {
    let count = cells.count();
    let normal = |to: usize, part: usize, from: usize| cells.matrix[3 * to][3 * from + part];
    let along = |to: usize, part: usize, from: usize| cells.matrix[3 * to + 1][3 * from + part];
    let mut found = Vec::new();
    for choice in 0..4_usize.pow(count as u32) {
        let does = |cell: usize| choice / 4_usize.pow(cell as u32) % 4;
        // Unknowns: p, then q of every cell, then the approach.
        let size = 2 * count + 1;
        let (mut matrix, mut right) = (vec![vec![0.0; size]; size], vec![0.0; size]);
        for cell in 0..count {
            let (first, second) = (cell, count + cell);
            if does(cell) == 0 {
                (matrix[first][cell], matrix[second][count + cell]) = (1.0, 1.0);
                continue;
            }
            for from in 0..count {
                matrix[first][from] = normal(cell, 0, from);
                matrix[first][count + from] = normal(cell, 1, from);
            }
            (matrix[first][2 * count], right[first]) = (-1.0, -asked.gap[cell]);
            if does(cell) == 1 {
                for from in 0..count {
                    matrix[second][from] = along(cell, 0, from);
                    matrix[second][count + from] = along(cell, 1, from);
                }
                right[second] = asked.motion[0] + asked.before.x[cell];
            } else {
                let sign = if does(cell) == 2 { 1.0 } else { -1.0 };
                matrix[second][count + cell] = 1.0;
                matrix[second][cell] = -sign * asked.friction[cell];
            }
        }
        if let Some(total) = asked.total {
            matrix[2 * count][..count].fill(1.0);
            right[2 * count] = total;
        } else {
            (matrix[2 * count][2 * count], right[2 * count]) = (1.0, asked.approach);
        }
        let Some(solution) = eliminated(matrix, right) else { continue };
        let tractions: Vec<[f64; 3]> = (0..count).map(|i| [solution[i], solution[count + i], 0.0]).collect();
        let moved = cells.displacements(&tractions);
        let holds = (0..count).all(|cell| {
            let [p, q, _] = tractions[cell];
            let gap = asked.gap[cell] + moved[cell][0] - solution[2 * count];
            let slip = asked.motion[0] + asked.before.x[cell] - moved[cell][1];
            match does(cell) {
                0 => gap >= 0.0,
                1 => p >= 0.0 && q.abs() <= asked.friction[cell] * p,
                2 => p >= 0.0 && slip >= 0.0,
                _ => p >= 0.0 && slip <= 0.0,
            }
        });
        if holds {
            found.push(solution);
        }
    }
    found
}

#[test]
fn a_row_of_cells_is_solved_as_one_of_all_its_contact_sets() {
    let mut random = Random::seeded(172);
    let settings = SolverSettings::new(1e-10);
    let (mut solved, mut kinds) = (0, [0; 3]);
    let rounds = 200;
    for round in 0..rounds {
        let cells = Cells::new([random.whole(3, 5), 1], random.between(-0.5, 0.45));
        let count = cells.count();
        let mut asked = Asked::drawn(&mut random, &cells);
        asked.before.y.fill(0.0);
        asked.motion[1] = 0.0;
        let hard = random.between(0.1, 1.5);
        asked.friction.iter_mut().for_each(|coefficient| *coefficient *= hard);
        if random.chance(0.5) {
            asked.total = Some(random.between(0.2, 2.0));
        }
        let all = enumerated(&cells, &asked);
        asked.problem(&cells, |problem| {
            let mut operators = cells.operators();
            let mut start = Tractions::zeros(count);
            start.pressure.iter_mut().for_each(|p| *p = random.between(0.0, 1.0));
            let other = Tractions { pressure: vec![1.0; count], ..Tractions::zeros(count) };
            let (mut tractions, mut displacements) = (Tractions::zeros(count), Displacements::zeros(count));
            let ends = (&mut tractions, &mut displacements);
            let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
            let mut solution = AugmentedNewton::new(problem, &start, &mut operators)
                .solve(ends, &mut operators, &settings, go_on)
                .unwrap();
            if solution.is_none() {
                let ends = (&mut tractions, &mut displacements);
                solution = AugmentedNewton::new(problem, &other, &mut operators)
                    .solve(ends, &mut operators, &settings, go_on)
                    .unwrap();
            }
            let Some(solution) = solution else {
                println!("round {round}: not solved; {} solutions, mu {:.2?}", all.len(), asked.friction);
                return;
            };
            solved += 1;
            let approach = solution.normal.approach;
            let found: Vec<f64> =
                tractions.pressure.iter().chain(&tractions.shear.x).copied().chain([approach]).collect();
            let off = |one: &Vec<f64>| {
                size(&one.iter().zip(&found).map(|(a, b)| a - b).collect::<Vec<_>>()) / size(&found)
            };
            let nearest = all.iter().map(off).fold(f64::INFINITY, f64::min);
            // The tolerance of 1e-10 times the condition of five cells.
            assert!(nearest < 1e-8, "round {round}: {nearest:.1e} off the nearest of {}", all.len());
            assert!(tractions.shear.y.iter().all(|q| q.abs() < 1e-9));
            for cell in 0..count {
                let [p, q] = [tractions.pressure[cell], tractions.shear.x[cell]];
                let slips = q.abs() > asked.friction[cell] * p * (1.0 - 1e-9);
                kinds[if p > 0.0 { 1 + usize::from(slips) } else { 0 }] += 1;
            }
        });
    }
    println!("{solved} of {rounds} solved; cells open, sticking, slipping: {kinds:?}");
    assert!(kinds.iter().all(|count| *count > 50), "{kinds:?}");
    assert_eq!(solved, rounds);
}

/// `p <- max(p - r g, 0)`, `q <- Proj(q + r s)`, with a part of the friction, until nothing changes any more.
fn by_fixed_point(cells: &Cells, asked: &Asked, friction: f64) -> Vec<[f64; 3]> {
    let mut tractions = vec![[0.0; 3]; cells.count()];
    let rate = 0.5 / cells.own()[0];
    for _ in 0..200_000 {
        let moved = cells.displacements(&tractions);
        let mut change = 0.0_f64;
        for (cell, traction) in tractions.iter_mut().enumerate() {
            let [normal, x, y] = moved[cell];
            let p = (traction[0] - rate * (asked.gap[cell] + normal - asked.approach)).max(0.0);
            let before = asked.before.at(cell);
            let trial = [0, 1]
                .map(|axis| traction[1 + axis] + rate * (asked.motion[axis] + before[axis] - [x, y][axis]));
            let (bound, length) = (friction * asked.friction[cell] * p, trial[0].hypot(trial[1]));
            let part = if length > bound { bound / length } else { 1.0 };
            let next = [p, part * trial[0], part * trial[1]];
            change = (0..3).fold(change, |most, k| most.max((next[k] - traction[k]).abs()));
            *traction = next;
        }
        if change < 1e-14 {
            break;
        }
    }
    tractions
}

#[test]
fn oblique_shear_is_where_a_projected_iteration_ends() {
    let mut random = Random::seeded(173);
    let settings = SolverSettings::new(1e-10);
    let cells = Cells::new([3, 3], 0.3);
    let mut slipping = 0;
    for round in 0..40 {
        let asked = Asked::drawn(&mut random, &cells);
        let expected = by_fixed_point(&cells, &asked, 1.0);
        let frictionless = tractions_of(&by_fixed_point(&cells, &asked, 0.0));
        asked.problem(&cells, |problem| {
            let mut operators = cells.operators();
            let start = Tractions { pressure: vec![0.5; 9], ..Tractions::zeros(9) };
            let (mut tractions, mut displacements) = (Tractions::zeros(9), Displacements::zeros(9));
            let ends = (&mut tractions, &mut displacements);
            let go_on: IterationCallback<'_> = &mut |_, _| ControlFlow::Continue(());
            if AugmentedNewton::new(problem, &start, &mut operators)
                .solve(ends, &mut operators, &settings, go_on)
                .unwrap()
                .is_none()
            {
                let ends = (&mut tractions, &mut displacements);
                AugmentedNewton::new(problem, &frictionless, &mut operators)
                    .solve(ends, &mut operators, &settings, go_on)
                    .unwrap()
                    .unwrap();
            }
            let found = by_cell(tractions.parts());
            let most = found.iter().fold(0.0_f64, |most, [p, ..]| most.max(*p));
            for cell in 0..9 {
                let [p, x, y] = found[cell];
                slipping += usize::from(p > 0.0 && x.hypot(y) > asked.friction[cell] * p * (1.0 - 1e-9));
                for k in 0..3 {
                    let off = (found[cell][k] - expected[cell][k]).abs() / most;
                    assert!(off < 1e-8, "round {round}, cell {cell}: {:?} {:?}", found[cell], expected[cell]);
                }
            }
        });
    }
    assert!(slipping > 40, "{slipping} cells slip");
}
