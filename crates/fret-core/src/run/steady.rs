//! The steady state of a contact that rolls on and on: nothing changes any more as seen from the contact.
//!
//! Found by marching, in strides that become shorter down to one step of whole cells. What a length of the contact leaves of a transient fades away slowly and
//! alike: after each, the march goes on from that mean of the last states of which the changes cancel most (Anderson, 1965, J. ACM 12, 547).

use std::cell::Cell;

use ndarray::Axis;

use super::rolling::Rolling;
use crate::fields::{add_scaled, dot, norm};
use crate::model::{ContactState, Control, LoadStep, step_towards};
use crate::solver::{ContactSolver, Increment, IterationCallback, SolveError, SolverMemory, Work};

/// How many of the longest strides are a length of the contact.
const OF_CONTACT: usize = 8;
/// Last states of which means are taken.
const STATES: usize = 4;
/// What is left of a transient, in the shear by the shear, below which it is steady; so many times the bound on the residuals where that is more.
/// In longer strides than one step a rougher one for each: what they are off the steady state themselves is more.
const STEADY: f64 = 1e-5;
const OF_TOLERANCE: f64 = 100.0;
const ROUGHLY: f64 = 0.01;
/// Bound on the residuals of increments from which others follow: before the last lengths, and in these over the bound on what is left of a transient.
/// The one increment that is told, from there on, keeps to the tolerance. Rougher last lengths spoil the means, and take more of them.
const ON_THE_WAY: f64 = 1e-4;
const OF_STEADY: f64 = 0.1;
/// A length of the contact leaves at least and at the most so much of a transient.
const LEAVES: [f64; 2] = [0.05, 0.95];
/// Lengths of the contact, at the most: in strides, and step by step.
const MOST_IN_STRIDES: usize = 4;
const MOST: usize = 100;

/// What a length of the contact made of a state.
struct Trial {
    end: ContactState,
    memory: SolverMemory,
    /// By how much it changed the shear, and the pressure, as seen from the contact [pressure].
    change: Vec<f64>,
}

/// What drives a contact that rolls on.
#[derive(Clone, Copy)]
pub struct Onward<'a> {
    /// The forces of this load.
    pub wanted: &'a LoadStep,
    /// What is prescribed by distance rolled, along x, y and about z.
    pub rates: [Option<f64>; 3],
    /// The way that it rolls, along x and y: a direction of any length.
    pub direction: [f64; 2],
}

impl Rolling {
    /// Rolls on from a state until nothing changes any more: the end of the last increment, which goes on by one step of whole cells, what is
    /// prescribed there, and the number of increments made. All motions and energies are those of that one increment; what is stored on the way
    /// counts as work.
    ///
    /// # Errors
    /// As [`Rolling::step`] of the one increment that is told; that it does not converge, when it does not become steady.
    pub fn until_steady(
        &mut self,
        solver: &mut ContactSolver<'_>,
        start: &ContactState,
        onward: Onward<'_>,
        watch: IterationCallback<'_>,
    ) -> Result<(Increment, LoadStep, usize), SolveError> {
        let found = self.marched(solver, start, onward, watch);
        solver.set_tolerance(self.tolerance);
        found
    }

    fn marched(
        &mut self,
        solver: &mut ContactSolver<'_>,
        start: &ContactState,
        onward: Onward<'_>,
        watch: IterationCallback<'_>,
    ) -> Result<(Increment, LoadStep, usize), SolveError> {
        let spacing = self.grid.spacing();
        // A plan has found that there is one.
        let step = step_towards(onward.direction, spacing).unwrap_or([1, 0]).map(|cells| cells as f64);
        if !self.is_held(&start.pressure, step) {
            return Err(SolveError::ContactAtEdge);
        }
        let tolerance = self.tolerance;
        let bound = STEADY.max(OF_TOLERANCE * tolerance);
        let (work, made) = (Cell::new(Work::default()), Cell::new(0));
        let mut advance = |solver: &mut ContactSolver<'_>, state: &ContactState, steps: usize| {
            let load = onward.ahead(state, [0, 1].map(|axis| steps as f64 * step[axis] * spacing[axis]));
            let solved = self.advance(solver, state, &load, watch)?;
            let mut all = work.get();
            all += solved.work;
            work.set(all);
            made.set(made.get() + 1);
            Ok::<_, SolveError>((solved, load))
        };
        // Where the bodies only just touch, a length of the contact is a cell or two.
        let length = length(start, step).max(4);
        let friction = solver.friction().largest();
        let mut state = start.clone();
        let mut off = 1.0;
        let mut stride = (length / OF_CONTACT).max(1);
        loop {
            let is_last = stride == 1;
            let (enough, most) =
                if is_last { (bound, MOST) } else { (ROUGHLY * stride as f64, MOST_IN_STRIDES) };
            let mut trials: Vec<Trial> = Vec::new();
            let mut off_before = f64::INFINITY;
            'lengths: for number in 0..most {
                let is_rough = !is_last || number == 0;
                let residual = if is_rough { ON_THE_WAY } else { OF_STEADY * bound };
                solver.set_tolerance(tolerance.max(residual));
                let from = numbers(&state, friction);
                for _ in 0..length.div_ceil(stride) {
                    let memory = solver.memory().clone();
                    match advance(solver, &state, stride) {
                        Ok((solved, _)) => state = solved.state,
                        Err(SolveError::NotConverged { .. }) if !is_last => {
                            solver.restore_memory(memory);
                            break 'lengths;
                        }
                        // From a mean of states the way may be too far: on from the last of them.
                        Err(SolveError::NotConverged { .. }) if !trials.is_empty() => {
                            let Some(Trial { end, memory, .. }) = trials.pop() else { break };
                            trials.clear();
                            solver.restore_memory(memory);
                            state = end;
                            continue 'lengths;
                        }
                        Err(error) => return Err(error),
                    }
                }
                let to = numbers(&state, friction);
                let mut change = to.clone();
                add_scaled(&mut change, -1.0, &from);
                let size = norm(&to);
                off = if size > 0.0 { norm(&change) / size } else { 0.0 };
                // nothing is left of nothing
                let leaves =
                    if off > 0.0 { (off / off_before).clamp(LEAVES[0], LEAVES[1]) } else { LEAVES[0] };
                let left = if is_last { off * leaves / (1.0 - leaves) } else { off };
                off_before = off;
                if left <= enough && !(is_last && is_rough) {
                    if !is_last {
                        break;
                    }
                    solver.set_tolerance(tolerance);
                    let (solved, load) = advance(solver, &state, 1)?;
                    let end = Increment { work: work.get(), ..solved };
                    let (end, load) = of_one_increment(solver, (start, &state), end, load);
                    return Ok((end, load, made.get()));
                }
                trials.push(Trial { end: state.clone(), memory: solver.memory().clone(), change });
                if trials.len() > STATES {
                    trials.remove(0);
                }
                if let Some((mean, memory)) = mean(&trials) {
                    solver.restore_memory(memory);
                    state = mean;
                }
            }
            if is_last {
                return Err(SolveError::NotSteady { change: off, increments: made.get() });
            }
            stride /= 2;
        }
    }
}

impl Onward<'_> {
    /// What is prescribed so far ahead of a state along x and y.
    fn ahead(&self, state: &ContactState, way: [f64; 2]) -> LoadStep {
        let mut load = *self.wanted;
        let distance = way[0].hypot(way[1]);
        load.roll = [0, 1].map(|axis| state.roll[axis] + way[axis]);
        let on = |rate: Option<f64>, from: f64, control: &mut Control| match (rate, *control) {
            (Some(rate), _) => *control = Control::Motion(from + rate * distance),
            (None, Control::Motion(_)) => *control = Control::Motion(from),
            (None, _) => {}
        };
        for axis in 0..2 {
            on(self.rates[axis], state.shift[axis], &mut load.tangential[axis]);
        }
        on(self.rates[2], state.twist, &mut load.twist);
        load
    }
}

/// Steps of so many cells along x and y that the contact is long: of an ellipse that reaches as far as it along both axes.
fn length(state: &ContactState, step: [f64; 2]) -> usize {
    let of = [0, 1].map(|axis| {
        let lanes = state.pressure.axis_iter(Axis(axis));
        let touching = lanes.filter(|lane| lane.iter().any(|p| *p > 0.0)).count();
        // The part in front of a mirror is not rolled along.
        if step[axis] == 0.0 { 0.0 } else { step[axis] / touching as f64 }
    });
    (1.0 / of[0].hypot(of[1])).round() as usize
}

/// Shear, and pressure times the friction coefficient [pressure].
fn numbers(state: &ContactState, friction: f64) -> Vec<f64> {
    let shear = state.shear.iter().flatten().copied();
    let mut numbers: Vec<f64> = shear.collect();
    numbers.extend(state.pressure.iter().map(|pressure| friction * pressure));
    numbers
}

/// The mean of the ends of trials of which, taken of their changes, least is left.
fn mean(trials: &[Trial]) -> Option<(ContactState, SolverMemory)> {
    let (last, others) = trials.split_last()?;
    if others.is_empty() {
        return None;
    }
    let differences: Vec<Vec<f64>> = others
        .iter()
        .map(|trial| {
            let mut difference = trial.change.clone();
            add_scaled(&mut difference, -1.0, &last.change);
            difference
        })
        .collect();
    let products: Vec<Vec<f64>> =
        differences.iter().map(|one| differences.iter().map(|other| dot(one, other)).collect()).collect();
    let right = differences.iter().map(|one| -dot(one, &last.change)).collect();
    let mut weights = solved(products, right)?;
    weights.push(1.0 - weights.iter().sum::<f64>());
    let memories: Vec<_> =
        trials.iter().zip(&weights).map(|(trial, weight)| (&trial.memory, *weight)).collect();
    let memory = SolverMemory::mean(&memories)?;
    let mut state = last.end.clone();
    let [x, y] = &mut state.shear;
    for field in [&mut state.pressure, x, y] {
        field.fill(0.0);
    }
    for (trial, weight) in trials.iter().zip(&weights) {
        state.pressure.scaled_add(*weight, &trial.end.pressure);
        for (shear, other) in state.shear.iter_mut().zip(&trial.end.shear) {
            shear.scaled_add(*weight, other);
        }
    }
    state.pressure.mapv_inplace(|pressure| pressure.max(0.0));
    Some((state, memory))
}

/// The solution of symmetric positive equations of few unknowns, lifted by rounding; `None` where they have none.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let count = right.len();
    let lift = 1e-13 * (0..count).map(|k| matrix[k][k]).sum::<f64>();
    for k in 0..count {
        matrix[k][k] += lift;
    }
    for k in 0..count {
        let pivot = matrix[k][k];
        if pivot <= 0.0 {
            return None;
        }
        let row = matrix[k].clone();
        for below in k + 1..count {
            let factor = matrix[below][k] / pivot;
            matrix[below].iter_mut().zip(&row).for_each(|(to, from)| *to -= factor * from);
            right[below] -= factor * right[k];
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|other| matrix[k][other] * right[other]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right.iter().all(|weight| weight.is_finite()).then_some(right)
}

/// The end of an increment from a state, told as the only one after a start.
fn of_one_increment(
    solver: &mut ContactSolver<'_>,
    (start, before): (&ContactState, &ContactState),
    mut end: Increment,
    mut load: LoadStep,
) -> (Increment, LoadStep) {
    let after = &mut end.state;
    let roll = [0, 1].map(|axis| start.roll[axis] - before.roll[axis]);
    let shift = [0, 1].map(|axis| start.shift[axis] - before.shift[axis]);
    let twist = start.twist - before.twist;
    let on = |control: &mut Control, by: f64| {
        if let Control::Motion(motion) = control {
            *motion += by;
        }
    };
    for axis in 0..2 {
        after.roll[axis] += roll[axis];
        load.roll[axis] += roll[axis];
        after.shift[axis] += shift[axis];
        on(&mut load.tangential[axis], shift[axis]);
    }
    after.twist += twist;
    on(&mut load.twist, twist);
    after.dissipated_energy += start.dissipated_energy - before.dissipated_energy;
    after.bulk_work += start.bulk_work - before.bulk_work;
    after.wear_work += start.wear_work - before.wear_work;
    after.unresolved_energy += start.unresolved_energy - before.unresolved_energy;
    let stored = before.elastic_energy - start.elastic_energy;
    after.external_work += start.external_work - before.external_work + stored;
    let mut memory = solver.memory().clone();
    memory.count_motions_from((roll, shift, twist));
    solver.restore_memory(memory);
    (end, load)
}
