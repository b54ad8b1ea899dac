//! The linear problems of derivatives: by the solver's GMRES, preconditioned from the right, from a guess where there is one; what it leaves over is
//! solved for again until little enough is left.

use crate::fields::{add_scaled, dot, norm};
use crate::solver::{ContactVector, Gmres};

/// Krylov steps at the most.
const MOST_STEPS: usize = 400;
/// Times that what is left over is solved for, again and again.
const MOST_ROUNDS: usize = 6;
/// Relative residual that a round in single precision is taken to.
const SINGLE: f64 = 3e-5;

/// A linear problem with an approximate inverse.
pub(super) trait LinearProblem {
    /// The left side of the equations.
    fn apply(&mut self, unknowns: &[f64], equations: &mut [f64]);
    /// Unknowns that nearly have this left side.
    fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]);
    /// Whether single precision may do from now on in [`apply`](Self::apply); says whether it does.
    fn hurry(&mut self, _may: bool) -> bool {
        false
    }
}

/// Solves a problem until a residual of the size `allowed` is left, from a guess of the direction of its solution; with it the size of the residual,
/// evaluated with the solution.
pub(super) fn solve(
    problem: &mut impl LinearProblem,
    right: &[f64],
    guess: Option<Vec<f64>>,
    allowed: f64,
) -> (Vec<f64>, f64) {
    let size = norm(right);
    let mut solution = vec![0.0; right.len()];
    if right.iter().all(|value| *value == 0.0) {
        return (solution, 0.0);
    }
    if !(size > 0.0 && size.is_finite()) {
        return (solution, f64::INFINITY);
    }
    if size <= allowed {
        return (solution, size);
    }
    let mut left = right.to_vec();
    if let Some(guess) = guess {
        start(problem, &guess, &mut left, &mut solution);
        // In single precision: not the last word.
        if norm(&left) <= allowed {
            residual(problem, right, &solution, &mut left);
        }
    }
    let mut reached = norm(&left);
    if reached <= allowed {
        return (solution, reached);
    }
    let mut may_hurry = true;
    for _ in 0..MOST_ROUNDS {
        let hurries = problem.hurry(may_hurry);
        let aim = if hurries { SINGLE.max(allowed / reached) } else { allowed / reached };
        let step = krylov(problem, &left, aim);
        problem.hurry(false);
        add_scaled(&mut solution, 1.0, &step);
        residual(problem, right, &solution, &mut left);
        let now = norm(&left);
        // Where single precision does not serve, double precision goes on.
        may_hurry = now < 0.01 * reached;
        if !(now < reached) {
            add_scaled(&mut solution, -1.0, &step);
            residual(problem, right, &solution, &mut left);
            reached = norm(&left);
            if !hurries {
                break;
            }
            continue;
        }
        reached = now;
        if reached <= allowed {
            break;
        }
    }
    (solution, reached)
}

/// What the equations leave of the right side with a solution.
fn residual(problem: &mut impl LinearProblem, right: &[f64], solution: &[f64], left: &mut [f64]) {
    problem.apply(solution, left);
    for (left, right) in left.iter_mut().zip(right) {
        *left = right - *left;
    }
}

/// Begins with as much of a guess as leaves least of the right side.
fn start(problem: &mut impl LinearProblem, guess: &[f64], left: &mut [f64], solution: &mut [f64]) {
    let mut image = vec![0.0; guess.len()];
    problem.hurry(true);
    problem.apply(guess, &mut image);
    problem.hurry(false);
    let size = dot(&image, &image);
    if size > 0.0 && size.is_finite() {
        let amount = dot(&image, left) / size;
        add_scaled(solution, amount, guess);
        add_scaled(left, -amount, &image);
    }
}

/// One search for the combination of Krylov directions with the least residual.
fn krylov(problem: &mut impl LinearProblem, right: &[f64], target: f64) -> Vec<f64> {
    let size = norm(right);
    let mut method = Gmres::<f64>::default();
    let first = method.right();
    first.reset(1, right.len());
    first.values_mut().copy_from_slice(right);
    first.scale(1.0 / size);
    let mut inverse = vec![0.0; right.len()];
    let mut combination = ContactVector::default();
    let apply = |from: &ContactVector<f64>, to: &mut ContactVector<f64>| {
        problem.invert(from.values(), &mut inverse);
        to.clear_like(from);
        problem.apply(&inverse, to.values_mut());
    };
    method.solve(apply, (target, MOST_STEPS), &mut combination);
    combination.scale(size);
    problem.invert(combination.values(), &mut inverse);
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::dot;
    use crate::random::Random;

    /// A dense matrix with a diagonal for its approximate inverse.
    struct Dense(Vec<Vec<f64>>);

    impl LinearProblem for Dense {
        fn apply(&mut self, unknowns: &[f64], equations: &mut [f64]) {
            for (row, equation) in self.0.iter().zip(equations) {
                *equation = dot(row, unknowns);
            }
        }
        fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]) {
            for (number, unknown) in unknowns.iter_mut().enumerate() {
                *unknown = equations[number] / self.0[number][number];
            }
        }
    }

    /// Forty unknowns that are known: found to rounding, times a condition of about ten.
    #[test]
    fn known_unknowns_are_found() {
        let mut random = Random::seeded(3);
        let matrix: Vec<Vec<f64>> = (0..40)
            .map(|row| {
                let diagonal = |column: usize| if row == column { 3.0 + row as f64 } else { 0.0 };
                (0..40).map(|column| diagonal(column) + random.between(-0.5, 0.5)).collect()
            })
            .collect();
        let known: Vec<f64> = (0..40).map(|_| random.between(-1.0, 1.0)).collect();
        let mut problem = Dense(matrix);
        let mut right = vec![0.0; 40];
        problem.apply(&known, &mut right);
        let allowed = 1e-14 * norm(&right);
        let nearby: Vec<f64> = known.iter().map(|value| -3.0 * value + 1e-3).collect();
        for guess in [None, Some(nearby), Some(known.clone()), Some(vec![0.0; 40])] {
            let (found, reached) = solve(&mut problem, &right, guess, allowed);
            assert!(reached <= allowed, "{reached:e}");
            assert!(found.iter().zip(&known).all(|(found, known)| (found - known).abs() < 1e-12));
        }
        assert_eq!(solve(&mut problem, &[0.0; 40], None, 0.0), (vec![0.0; 40], 0.0));
        // What is small enough already is not solved for.
        assert_eq!(solve(&mut problem, &right, None, 1e3), (vec![0.0; 40], norm(&right)));
    }
}
