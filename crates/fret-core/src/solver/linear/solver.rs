//! Solves linearised problems: the one boundary between double and single precision. The right side is taken, and the step handed
//! back, in double precision; between the two everything may be single (iterative refinement: what is left over is found again by
//! the next evaluation of the nonlinear residual).

use super::super::contact_vector::ContactVector;
use super::gmres::Gmres;
use super::inverse::Precision;
use super::preconditioner::Preconditioner;
use super::problem::{LinearProblem, LinearSets, LinearWorkspace, Linearised, right_side};
use crate::compliance::SurfaceCompliance;
use crate::fields::{Number, lower, sum};

/// Relative residual to which a problem is solved in single precision at the most.
const SINGLE: f64 = 1e-5;
/// Krylov steps at the most.
const MOST_STEPS: usize = 30;

/// Solver of linearised problems, with its memory.
#[derive(Debug, Default)]
pub struct LinearSolver {
    double: Krylov<f64>,
    single: Krylov<f32>,
}

impl LinearSolver {
    /// Finds the `step` of the tractions.
    pub fn solve(
        &mut self,
        problem: &Linearised<'_>,
        compliance: &mut dyn SurfaceCompliance,
        preconditioner: &mut Preconditioner,
        step: &mut ContactVector<f64>,
    ) {
        let Self { double, single } = self;
        right_side(problem, step);
        let size = step.norm();
        if !(size > 0.0) {
            return step.values_mut().fill(0.0);
        }
        let coupled = !problem.gap.is_empty();
        let forcing = problem.forcing.max(problem.floor / size);
        let operator = if problem.give != [0.0; 3] {
            None // beside a machine that gives single precision would lose the contact's own displacement
        } else if coupled {
            compliance.full_single()
        } else {
            compliance.tangential_single()
        };
        if let Some(mut operator) = operator {
            let unit = operator.unit();
            let apply = |q: &[&[f32]], u: &mut [&mut [f32]]| operator.apply(q, u);
            let forcing = forcing.max(SINGLE);
            single.gmres.right().convert(step, 1.0 / size);
            single.solve(problem, (unit, forcing), apply, preconditioner);
            step.convert(&single.tractions, size / unit);
        } else {
            let apply = |q: &[&[f64]], u: &mut [&mut [f64]]| match (q, u) {
                ([p, qx, qy], [uz, ux, uy]) => compliance.full([p, qx, qy], [uz, ux, uy]),
                ([qx, qy], [ux, uy]) => compliance.tangential([qx, qy], [ux, uy]),
                _ => {}
            };
            double.gmres.right().convert(step, 1.0 / size);
            double.solve(problem, (1.0, forcing), apply, preconditioner);
            step.convert(&double.tractions, size);
        }
    }
}

/// Adds the displacement by which the machine gives under tractions: one more compliance on their resultant.
fn give_way<N: Number>(give: [f64; 3], tractions: &ContactVector<N>, to: &mut ContactVector<N>) {
    let (pressure, [x, y]) = tractions.parts();
    let (normal, [along_x, along_y]) = to.parts_mut();
    for (give, from, to) in [(give[0], pressure, normal), (give[1], x, along_x), (give[2], y, along_y)] {
        if give > 0.0 && !from.is_empty() {
            lower(to, -give * sum(from));
        }
    }
}

/// The method in one precision.
#[derive(Debug, Default)]
struct Krylov<N> {
    gmres: Gmres<N>,
    sets: LinearSets<N>,
    workspace: LinearWorkspace<N>,
    combination: ContactVector<N>,
    /// Of the newest direction; at the end the step for a right side of length one, in units of the problem.
    tractions: ContactVector<N>,
}

impl<N: Precision> Krylov<N> {
    /// Finds the tractions of the problem whose right side the method holds.
    fn solve(
        &mut self,
        problem: &Linearised<'_>,
        (unit, forcing): (f64, f64),
        mut operator: impl FnMut(&[&[N]], &mut [&mut [N]]),
        preconditioner: &mut Preconditioner,
    ) {
        let Self { gmres, sets, workspace, combination, tractions } = self;
        sets.take(problem, unit);
        let mut linear = LinearProblem::new(problem, sets, unit, preconditioner, workspace);
        let apply = |from: &ContactVector<N>, to: &mut ContactVector<N>| {
            linear.precondition(from, tractions);
            linear.displace(tractions, to, &mut operator);
            give_way(problem.give.map(|give| give / unit), tractions, to);
            linear.complete(to);
        };
        gmres.solve(apply, (forcing, MOST_STEPS), combination);
        linear.precondition(combination, tractions);
    }
}
