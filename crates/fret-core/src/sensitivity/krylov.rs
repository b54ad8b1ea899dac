//! The linear problems of derivatives: by the solver's GMRES, preconditioned from the right; what it leaves over is solved for again until little
//! enough is left.

use std::mem;

use crate::fields::{add_scaled, norm, reset};
use crate::solver::{ContactVector, Gmres};

/// Krylov steps at the most.
const MOST_STEPS: usize = 400;
/// Times that what is left over is solved for, again and again.
const MOST_ROUNDS: usize = 6;
/// Relative residual that a round is taken to at the most, and down to which it may be believed without a look at what it leaves: in single and in
/// double precision.
const SINGLE: f64 = 5e-7;
const DOUBLE: f64 = 1e-11;
/// So many rounds are believed after one whose count of what it leaves was right, within this factor.
const BELIEVED: usize = 8;
const RIGHT: f64 = 1.5;

/// How many more rounds of the search are believed what they count, in single and in double precision.
#[derive(Debug, Clone, Copy, Default)]
struct Trust([usize; 2]);

impl Trust {
    /// Whether a round is believed.
    fn believes(&mut self, hurries: bool) -> bool {
        let rounds = &mut self.0[usize::from(!hurries)];
        let believes = *rounds > 0;
        *rounds = rounds.saturating_sub(1);
        believes
    }

    /// Learns what a round that counted so much left.
    fn learn(&mut self, hurries: bool, [counted, left]: [f64; 2]) {
        self.0[usize::from(!hurries)] = if left <= RIGHT * counted { BELIEVED } else { 0 };
    }
}

/// What searches leave for those after them: how far they are believed, and memory.
#[derive(Debug, Default)]
pub(super) struct Searches {
    trust: Trust,
    method: Gmres<f64>,
    steps: Vec<Step>,
}

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
    /// Numbers that the unknowns applied last have besides, linear in them.
    fn aside(&self) -> [f64; 2] {
        [0.0; 2]
    }
    /// What searches left.
    fn searches(&mut self) -> &mut Searches;
}

/// Unknowns, what they have besides, and the size of the residual that they leave.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub unknowns: Vec<f64>,
    pub aside: [f64; 2],
    pub left: f64,
}

/// Solves a problem until a residual of the size `allowed` is left.
pub(super) fn solve(problem: &mut impl LinearProblem, right: &[f64], allowed: f64) -> Found {
    let mut found = Found { unknowns: vec![0.0; right.len()], aside: [0.0; 2], left: norm(right) };
    if right.iter().all(|value| *value == 0.0) || found.left <= allowed {
        return found;
    }
    if !found.left.is_finite() {
        found.left = f64::INFINITY;
        return found;
    }
    let mut left = right.to_vec();
    let mut may_hurry = true;
    for _ in 0..MOST_ROUNDS {
        let hurries = problem.hurry(may_hurry);
        let (aim, least) = (allowed / found.left, if hurries { SINGLE } else { DOUBLE });
        let (step, counted) = krylov(problem, &left, if hurries { aim.max(SINGLE) } else { aim });
        problem.hurry(false);
        found.add(1.0, &step);
        if aim >= least && counted <= aim && problem.searches().trust.believes(hurries) {
            found.left *= counted;
            break;
        }
        found.look(problem, right, &mut left);
        let now = norm(&left);
        if aim >= least {
            problem.searches().trust.learn(hurries, [counted * found.left, now]);
        }
        // Where single precision does not serve, double precision goes on.
        may_hurry = now < 0.01 * found.left;
        if now < found.left {
            found.left = now;
            if now <= allowed {
                break;
            }
        } else {
            found.add(-1.0, &step);
            if !hurries {
                break;
            }
            found.look(problem, right, &mut left);
        }
    }
    found
}

impl Found {
    /// What the equations leave of the right side with the unknowns; and what these have besides, which single precision told with its errors.
    fn look(&mut self, problem: &mut impl LinearProblem, right: &[f64], left: &mut [f64]) {
        problem.apply(&self.unknowns, left);
        self.aside = problem.aside();
        for (left, right) in left.iter_mut().zip(right) {
            *left = right - *left;
        }
    }

    fn add(&mut self, factor: f64, step: &Step) {
        add_scaled(&mut self.unknowns, factor, &step.unknowns);
        for (aside, step) in self.aside.iter_mut().zip(step.aside) {
            *aside += factor * step;
        }
    }
}

/// What a search adds to the unknowns.
#[derive(Debug, Default)]
struct Step {
    unknowns: Vec<f64>,
    aside: [f64; 2],
}

/// One search for the combination of Krylov directions with the least residual, and its relative size as the search counts it.
fn krylov(problem: &mut impl LinearProblem, right: &[f64], target: f64) -> (Step, f64) {
    let size = norm(right);
    let searches = problem.searches();
    let (mut method, mut steps) = (mem::take(&mut searches.method), mem::take(&mut searches.steps));
    let first = method.right();
    first.reset(1, right.len());
    first.values_mut().copy_from_slice(right);
    first.scale(1.0 / size);
    let mut used = 0;
    let apply = |from: &ContactVector<f64>, to: &mut ContactVector<f64>| {
        steps.resize_with(steps.len().max(used + 1), Step::default);
        let step = &mut steps[used];
        used += 1;
        reset(&mut step.unknowns, right.len());
        problem.invert(from.values(), &mut step.unknowns);
        to.reset_like(from);
        problem.apply(&step.unknowns, to.values_mut());
        step.aside = problem.aside();
    };
    let (amounts, left) = method.solve(apply, (target, MOST_STEPS), &mut ContactVector::default());
    let mut found = Step { unknowns: vec![0.0; right.len()], aside: [0.0; 2] };
    for (step, amount) in steps.iter().zip(amounts) {
        add_scaled(&mut found.unknowns, size * amount, &step.unknowns);
        for (aside, by) in found.aside.iter_mut().zip(step.aside) {
            *aside += size * amount * by;
        }
    }
    let searches = problem.searches();
    (searches.method, searches.steps) = (method, steps);
    (found, left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::dot;
    use crate::random::Random;

    /// A dense matrix with a diagonal for its approximate inverse; besides, the sum of the unknowns.
    struct Dense {
        matrix: Vec<Vec<f64>>,
        aside: f64,
        searches: Searches,
    }

    impl LinearProblem for Dense {
        fn apply(&mut self, unknowns: &[f64], equations: &mut [f64]) {
            self.aside = unknowns.iter().sum();
            for (row, equation) in self.matrix.iter().zip(equations) {
                *equation = dot(row, unknowns);
            }
        }
        fn invert(&mut self, equations: &[f64], unknowns: &mut [f64]) {
            for (number, unknown) in unknowns.iter_mut().enumerate() {
                *unknown = equations[number] / self.matrix[number][number];
            }
        }
        fn aside(&self) -> [f64; 2] {
            [self.aside, 0.0]
        }
        fn searches(&mut self) -> &mut Searches {
            &mut self.searches
        }
    }

    /// Forty unknowns that are known: found to rounding, times a condition of about ten; with a number besides that is linear in them.
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
        let mut problem = Dense { matrix, aside: 0.0, searches: Searches::default() };
        let mut right = vec![0.0; 40];
        problem.apply(&known, &mut right);
        let [size, aside] = [norm(&right), problem.aside];
        // What is left, and what the search counts: believed from the second time on.
        for (relative, off) in [(1e-14, 1e-12), (1e-6, 1e-5), (1e-6, 1e-5)] {
            let found = solve(&mut problem, &right, relative * size);
            assert!(found.left <= relative * size, "{found:?}");
            assert!(found.unknowns.iter().zip(&known).all(|(found, known)| (found - known).abs() < off));
            assert!((found.aside[0] - aside).abs() < 10.0 * off && found.aside[1] == 0.0, "{found:?}");
            let mut left = vec![0.0; 40];
            found.clone().look(&mut problem, &right, &mut left);
            assert!((norm(&left) - found.left).abs() < 1e-13 * size, "{:e} {found:?}", norm(&left));
        }
        let nothing = |left: f64| Found { unknowns: vec![0.0; 40], aside: [0.0; 2], left };
        assert_eq!(solve(&mut problem, &[0.0; 40], 0.0), nothing(0.0));
        // What is small enough already is not solved for.
        assert_eq!(solve(&mut problem, &right, 1e3), nothing(size));
    }
}
