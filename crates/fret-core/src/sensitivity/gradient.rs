//! Derivatives of a history by numbers of its case: the run, and the linear equations of its increments, forward for each number or backwards for
//! each result, whichever are fewer.

use std::ops::ControlFlow;

use super::backward::{self, Past, Target};
use super::error::SensitivityError;
use super::events::NearEvents;
use super::forward::forward;
use super::objective::{Objective, Row, value_of};
use super::parameter::Parameter;
use super::refusals::{check, check_history, check_request};
use super::scene::{Scene, Snapshot};
use super::work::Work;
use crate::history::{CycleRecord, KeptFields, StepRecord};
use crate::machine::memory;
use crate::model::MirroredState;
use crate::plan::Plan;
use crate::run::{Iteration, Observer, RunError, Simulation};

/// Bytes a cell of a state that is kept: five fields and the zone.
const STATE: usize = 41;

/// Which way derivatives are carried through a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From the first increment to the last, for each number: one linear problem for each increment and number.
    Forward,
    /// From the last increment to the first, for each result: one linear problem for each increment and result, and the increments are kept.
    Backward,
}

/// What is asked.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Results: columns of the last increment (`max_pressure`), of others (`increments[7].shift_x`), `cycles[0].dissipated_energy`.
    pub of: Vec<String>,
    /// Paths of numbers of the case (`friction.coefficient`, `lower.coatings[0].young`); empty: all there are.
    pub by: Vec<String>,
    /// Which way; `None`: backwards where there are fewer results than numbers, no bodies come apart, a load changes in each increment, and memory
    /// serves; else forward.
    pub direction: Option<Direction>,
}

/// One result with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// Its name.
    pub of: String,
    /// Its value.
    pub value: f64,
    /// Its derivatives, in the order of the parameters.
    pub by: Vec<f64>,
}

/// The results with their derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivities {
    /// By what.
    pub parameters: Vec<Parameter>,
    /// Of what.
    pub gradients: Vec<Gradient>,
    /// Where most cells are about to change their state, so that derivatives on either side differ, up to the last increment that is asked for;
    /// `None`: nowhere any.
    pub near_events: Option<NearEvents>,
    /// Which way they were found.
    pub direction: Direction,
    /// What that took beside the run.
    pub work: Work,
}

/// Derivatives of the history of a plan, on the plan's grid.
///
/// # Errors
/// When a number or a result is not one of the case, the case is of a kind that is not covered, the run fails, or linear equations are not solved.
pub fn gradient(
    plan: &Plan,
    request: &Request,
    observer: &mut dyn Observer,
) -> Result<Sensitivities, SensitivityError> {
    let sums: Vec<Sum> = request.of.iter().map(|name| (name.clone(), vec![(name.clone(), 1.0)])).collect();
    derivatives(plan, &sums, (&request.by, request.direction), observer)
}

/// Derivatives of the sum of results, each times its weight: what a chain of derivatives (reverse mode) passes on to the numbers of the case. `by`,
/// `direction`: as in a [`Request`].
///
/// # Errors
/// As [`gradient`].
pub fn pulled_back(
    plan: &Plan,
    weights: &[(String, f64)],
    by: &[String],
    observer: &mut dyn Observer,
) -> Result<Sensitivities, SensitivityError> {
    let names: Vec<&str> = weights.iter().map(|(name, _)| name.as_str()).collect();
    derivatives(plan, &[(names.join(" + "), weights.to_vec())], (by, None), observer)
}

/// Whether results have derivatives by numbers of the case, as far as that can be said before the run.
///
/// # Errors
/// As [`gradient`] without a run.
pub fn check_asked(plan: &Plan, of: &[String], by: &[String]) -> Result<(), SensitivityError> {
    asked(plan, of.iter().map(String::as_str), by).map(drop)
}

/// The numbers that are asked for, all where none is named; refuses what has no derivatives.
fn asked<'a>(
    plan: &Plan,
    of: impl Iterator<Item = &'a str>,
    by: &[String],
) -> Result<Vec<Parameter>, SensitivityError> {
    check(plan)?;
    let parameters: Vec<Parameter> = if by.is_empty() {
        Parameter::all_of(&plan.case)
    } else {
        by.iter().map(|path| Parameter::new(path, &plan.case)).collect::<Result<_, _>>()?
    };
    let objectives = of.map(Objective::new).collect::<Result<Vec<_>, _>>()?;
    check_request(plan, &parameters, &objectives)?;
    Ok(parameters)
}

/// A sum of results: its name, and each of them with its weight.
type Sum = (String, Vec<(String, f64)>);

fn derivatives(
    plan: &Plan,
    sums: &[Sum],
    (by, direction): (&[String], Option<Direction>),
    observer: &mut dyn Observer,
) -> Result<Sensitivities, SensitivityError> {
    let names = sums.iter().flat_map(|(_, parts)| parts).map(|(name, _)| name.as_str());
    let parameters = asked(plan, names, by)?;
    let bytes = (plan.grid.len() / plan.symmetry.copies())
        .saturating_mul(STATE)
        .saturating_mul(plan.case.increments());
    memory::check(bytes).map_err(|error| RunError::OutOfMemory { increment: 0, error })?;
    let mut run = Snapshots { steps: Vec::new(), cycles: Vec::new(), observer };
    Simulation::new(plan).run(&mut run)?;
    let Snapshots { steps, cycles, observer } = run;
    if let Some(step) = steps.iter().find(|step| step.record.parts > 1) {
        return Err(SensitivityError::Parts { increment: step.record.increment, parts: step.record.parts });
    }
    check_history(plan, steps.iter().map(|step| step.record.contact_cells))?;
    let targets = sums.iter().map(|sum| target(sum, &steps, &cycles)).collect::<Result<Vec<_>, _>>()?;
    let tolerance = plan.case.tolerance;
    let mut tell = |step: &Snapshot| {
        let StepRecord { increment, stage, .. } = step.record;
        observer.iterated(&Iteration { increment, stage, iteration: 0, residual: 0.0, tolerance })
    };
    let scene = Scene::new(plan, &steps);
    // What comes after the last increment that is asked for changes nothing of it, whichever way.
    let asked = targets.iter().flat_map(|target| &target.columns).map(|(increment, ..)| increment + 1).max();
    let steps = &steps[..asked.unwrap_or(0)];
    let mut gradients: Vec<Gradient> =
        targets.iter().map(|target| target.empty(steps, parameters.len())).collect();
    let cheaper = if targets.len() < parameters.len() { Direction::Backward } else { Direction::Forward };
    let bytes = scene.region.len().saturating_mul(backward::BYTES).saturating_mul(steps.len());
    if direction.unwrap_or(cheaper) == Direction::Backward
        && (direction.is_some() || memory::check(bytes).is_ok())
        && let Some(past) = Past::of(&scene, steps)?
    {
        let (found, near_events, work) =
            backward::backward(&scene, (past, steps), &parameters, &targets, &mut tell)?;
        for (gradient, by) in gradients.iter_mut().zip(found) {
            gradient.by = by;
        }
        let direction = Direction::Backward;
        return Ok(Sensitivities { parameters, gradients, near_events, direction, work });
    }
    let (near_events, work) = forward(&scene, &parameters, steps, |(step, solved), changes| {
        for (gradient, target) in gradients.iter_mut().zip(&targets) {
            let here = target.columns.iter().filter(|(increment, ..)| *increment == step.record.increment);
            for (_, column, weight) in here {
                let row = Row::new(column, solved);
                for ((by, change), parameter) in gradient.by.iter_mut().zip(changes).zip(&parameters) {
                    let [friction, _] = parameter.change_of_friction(&plan.case, step.record.stage);
                    *by += weight * row.change(change, friction);
                }
            }
        }
        tell(step)
    })?;
    Ok(Sensitivities { parameters, gradients, near_events, direction: Direction::Forward, work })
}

/// The columns that a sum is made of.
fn target((of, parts): &Sum, steps: &[Snapshot], cycles: &[CycleRecord]) -> Result<Target, SensitivityError> {
    let mut columns = Vec::new();
    for (name, weight) in parts {
        let objective = Objective::new(name)?;
        for (increment, sign) in objective.needs(name, (steps.len(), cycles))? {
            columns.extend(increment.map(|increment| (increment, objective.column(), sign * weight)));
        }
    }
    Ok(Target { of: of.clone(), columns })
}

impl Target {
    /// Its value, and no derivatives yet.
    fn empty(&self, steps: &[Snapshot], numbers: usize) -> Gradient {
        let of = |(increment, column, weight): &(usize, &'static str, f64)| {
            weight * value_of(&steps[*increment].record, column)
        };
        Gradient { of: self.of.clone(), value: self.columns.iter().map(of).sum(), by: vec![0.0; numbers] }
    }
}

/// Takes the increments of a run for later.
pub(super) struct Snapshots<'a> {
    pub steps: Vec<Snapshot>,
    pub cycles: Vec<CycleRecord>,
    pub observer: &'a mut dyn Observer,
}

impl Observer for Snapshots<'_> {
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        self.observer.iterated(iteration)
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        self.steps.push(Snapshot { record: record.clone(), state: state.part.clone() });
        self.observer.solved(record, state, kept)
    }

    fn leaves_fields(&self) -> bool {
        false
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.cycles.push(record.clone());
        self.observer.cycled(record);
    }
}
