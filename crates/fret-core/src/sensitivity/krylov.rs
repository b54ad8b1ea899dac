//! GMRES in double precision to the last digits, preconditioned from the right, for the linear problems of derivatives. That of the solver
//! (`solver/linear/gmres.rs`) serves Newton steps, which ask for few digits.

use crate::fields::{add_scaled, dot, norm, scale};

/// Krylov steps at the most.
const MOST_STEPS: usize = 400;
/// Times that what is left over is solved for again.
const MOST_ROUNDS: usize = 3;

/// A linear problem with an approximate inverse.
pub(super) trait LinearProblem {
    /// The left side of the equations.
    fn apply(&mut self, unknowns: &[f64], equations: &mut [f64]);
    /// Unknowns that nearly have this left side.
    fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]);
}

/// Solves a problem to a relative residual `target`; with it the residual that was reached, evaluated with the solution.
pub(super) fn solve(problem: &mut impl LinearProblem, right: &[f64], target: f64) -> (Vec<f64>, f64) {
    let size = norm(right);
    let mut solution = vec![0.0; right.len()];
    if right.iter().all(|value| *value == 0.0) {
        return (solution, 0.0);
    }
    if !(size > 0.0 && size.is_finite()) {
        return (solution, f64::INFINITY);
    }
    let mut left = right.to_vec();
    let mut reached = 1.0;
    for _ in 0..MOST_ROUNDS {
        let step = krylov(problem, &left, target / reached);
        add_scaled(&mut solution, 1.0, &step);
        problem.apply(&solution, &mut left);
        for (left, right) in left.iter_mut().zip(right) {
            *left = right - *left;
        }
        let now = norm(&left) / size;
        if !(now < reached) {
            add_scaled(&mut solution, -1.0, &step);
            break;
        }
        reached = now;
        if reached <= target {
            break;
        }
    }
    (solution, reached)
}

/// One search for the combination of Krylov directions with the least residual.
fn krylov(problem: &mut impl LinearProblem, right: &[f64], target: f64) -> Vec<f64> {
    let len = right.len();
    let size = norm(right);
    let mut first = right.to_vec();
    scale(&mut first, 1.0 / size);
    let mut basis = vec![first];
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<[f64; 2]> = Vec::new();
    let mut rotated = vec![1.0];
    let mut inverse = vec![0.0; len];
    while columns.len() < MOST_STEPS {
        let used = columns.len();
        problem.invert(&basis[used], &mut inverse);
        let mut next = vec![0.0; len];
        problem.apply(&inverse, &mut next);
        let before = norm(&next);
        let mut column: Vec<f64> = basis
            .iter()
            .map(|direction| {
                let part = dot(&next, direction);
                add_scaled(&mut next, -part, direction);
                part
            })
            .collect();
        let rest = norm(&next);
        for (index, [cosine, sine]) in rotations.iter().enumerate() {
            let [upper, lower] = [column[index], column[index + 1]];
            column[index] = cosine * upper + sine * lower;
            column[index + 1] = cosine * lower - sine * upper;
        }
        let length = column[used].hypot(rest);
        if !(length > 0.0 && length.is_finite()) {
            break;
        }
        let [cosine, sine] = [column[used] / length, rest / length];
        column[used] = length;
        let left = rotated[used];
        rotated[used] = cosine * left;
        rotated.push(-sine * left);
        rotations.push([cosine, sine]);
        columns.push(column);
        if (sine * left).abs() <= target || rest <= 1e-15 * before {
            break;
        }
        scale(&mut next, 1.0 / rest);
        basis.push(next);
    }
    let mut amounts = vec![0.0; columns.len()];
    for row in (0..columns.len()).rev() {
        let known: f64 = (row + 1..columns.len()).map(|column| columns[column][row] * amounts[column]).sum();
        amounts[row] = (rotated[row] - known) / columns[row][row];
    }
    let mut combination = vec![0.0; len];
    for (amount, direction) in amounts.iter().zip(&basis) {
        add_scaled(&mut combination, *amount * size, direction);
    }
    problem.invert(&combination, &mut inverse);
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let (found, reached) = solve(&mut problem, &right, 1e-14);
        assert!(reached < 1e-14, "{reached:e}");
        assert!(found.iter().zip(&known).all(|(found, known)| (found - known).abs() < 1e-12));
        assert_eq!(solve(&mut problem, &[0.0; 40], 1e-14), (vec![0.0; 40], 0.0));
    }
}
