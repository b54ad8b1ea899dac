//! Derivatives of a history by numbers of its case: the run, and the linear equations of its increments, forward for each number or backwards for
//! each result, whichever are fewer.

use std::ops::ControlFlow;
use std::sync::Arc;

use ndarray::Array2;

use super::backward::{Found, Target, backward};
use super::below::below;
use super::cycle_loop::of_loop;
use super::error::SensitivityError;
use super::events::{NearEvents, SideOfEvents};
use super::field_weights::FieldWeights;
use super::forward::forward;
use super::objective::Objective;
use super::parameter::Parameter;
use super::past::{Past, bytes_per_cell, length_of_segments};
use super::refusals::{check, check_history, check_request};
use super::row::{Column, Composed, Row, value_of};
use super::scene::Scene;
use super::snapshot::Snapshot;
use super::work::Work;
use crate::history::{CycleRecord, KeptFields, StepRecord};
use crate::machine::memory;
use crate::model::MirroredState;
use crate::plan::Plan;
use crate::run::{Iteration, Observer, PairCompliance, Part, Simulation};

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
    /// The same with all cells that are about to change their state in the other one, up to the last increment that is asked for: on the other side.
    /// `None`: nowhere any.
    pub on_the_other_side: Option<Vec<f64>>,
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
    let sums: Vec<Sum<'_>> = request
        .of
        .iter()
        .map(|name| Sum { of: name.clone(), parts: vec![(name, 1.0)], fields: Vec::new() })
        .collect();
    derivatives(plan, &sums, (&request.by, request.direction), observer)
}

/// Weights of what a sum is made of.
#[derive(Debug, Clone, Default)]
pub struct Weights {
    /// Results, named as in a [`Request`].
    pub results: Vec<(String, f64)>,
    /// Fields of the whole grid (`pressure`, `increments[7].shear_x`: see [`FIELDS`](super::FIELDS)), each cell with its weight.
    pub fields: Vec<(String, Array2<f64>)>,
}

/// Derivatives of the sum of results and of the cells of fields, each times its weight: what a chain of derivatives (reverse mode) passes on to the
/// numbers of the case. `by`: as in a [`Request`].
///
/// # Errors
/// As [`gradient`], and when a field is not one whose sum has derivatives, or has not a finite weight for each cell.
pub fn pulled_back(
    plan: &Plan,
    weights: &Weights,
    by: &[String],
    observer: &mut dyn Observer,
) -> Result<Sensitivities, SensitivityError> {
    let parts: Vec<(&String, f64)> = weights.results.iter().map(|(name, weight)| (name, *weight)).collect();
    let of_field = |(name, weights): &'_ (String, Array2<f64>)| {
        FieldWeights::new(name, weights, plan).map(|weights| (name.clone(), weights))
    };
    let fields = weights.fields.iter().map(of_field).collect::<Result<Vec<_>, _>>()?;
    let names =
        parts.iter().map(|(name, _)| name.as_str()).chain(fields.iter().map(|(name, _)| name.as_str()));
    let of = names.collect::<Vec<_>>().join(" + ");
    derivatives(plan, &[Sum { of, parts, fields }], (by, None), observer)
}

/// Whether results have derivatives by numbers of the case, as far as that can be said before the run.
///
/// # Errors
/// As [`gradient`] without a run.
pub fn check_asked(plan: &Plan, of: &[String], by: &[String]) -> Result<(), SensitivityError> {
    asked(plan, (of.iter().map(String::as_str), false), by).map(drop)
}

/// The numbers that are asked for, all where none is named; refuses what has no derivatives.
fn asked<'a>(
    plan: &Plan,
    (of, fields): (impl Iterator<Item = &'a str>, bool),
    by: &[String],
) -> Result<Vec<Parameter>, SensitivityError> {
    check(plan)?;
    let parameters: Vec<Parameter> = if by.is_empty() {
        Parameter::all_of(&plan.case)
    } else {
        by.iter().map(|path| Parameter::new(path, &plan.case)).collect::<Result<_, _>>()?
    };
    let objectives = of.map(Objective::new).collect::<Result<Vec<_>, _>>()?;
    check_request(plan, &parameters, (&objectives, fields))?;
    Ok(parameters)
}

/// A sum of results and of fields: its name, and each of them with its weight.
struct Sum<'a> {
    of: String,
    parts: Vec<(&'a String, f64)>,
    fields: Vec<(String, FieldWeights)>,
}

fn derivatives(
    plan: &Plan,
    sums: &[Sum<'_>],
    (by, direction): (&[String], Option<Direction>),
    observer: &mut dyn Observer,
) -> Result<Sensitivities, SensitivityError> {
    let names = sums.iter().flat_map(|sum| &sum.parts).map(|(name, _)| name.as_str());
    let parameters = asked(plan, (names, sums.iter().any(|sum| !sum.fields.is_empty())), by)?;
    let objectives = sums.iter().flat_map(|sum| &sum.parts).map(|(name, _)| Objective::new(name));
    let objectives = objectives.collect::<Result<Vec<_>, _>>()?;
    let mut fields = sums.iter().flat_map(|sum| &sum.fields);
    let with_slip =
        objectives.iter().any(Objective::needs_slip) || fields.any(|(_, weights)| weights.is_slip());
    let mut run = Snapshots::heard_by(observer, with_slip);
    let pair = Arc::new(PairCompliance::of(plan));
    Simulation::new(plan).with_compliance(Some(Arc::clone(&pair))).run(&mut run)?;
    let Snapshots { mut steps, cycles, observer, .. } = run;
    end_blocks(&mut steps, &cycles);
    check_history(plan, steps.iter().map(|step| step.record.contact_cells))?;
    let increments: Vec<&Snapshot> = steps.iter().filter(|step| step.ends_increment()).collect();
    let scene = Scene::new(plan, &steps);
    let mut numbers = Vec::new();
    for (name, _) in sums.iter().flat_map(|sum| &sum.parts) {
        if let Some(number) = Objective::new(name)?.below(name, (increments.len(), &cycles))? {
            numbers.push(((*name).clone(), number));
        }
    }
    let mut below = below(&scene, &increments, &numbers, &parameters)?.into_iter();
    let targets = sums
        .iter()
        .map(|sum| sum.target((&scene, &parameters), (&increments, &cycles), &mut below))
        .collect::<Result<Vec<_>, _>>()?;
    let tolerance = plan.case.tolerance;
    let mut tell = |step: &Snapshot| {
        let StepRecord { increment, stage, .. } = step.record;
        observer.iterated(&Iteration { increment, stage, iteration: 0, residual: 0.0, tolerance })
    };
    // What comes after the last increment that is asked for changes nothing of it, whichever way.
    let asked = targets.iter().flat_map(|target| &target.columns).map(|(increment, ..)| increment + 1).max();
    let packed = steps.iter().map(Snapshot::bytes).sum::<usize>();
    let asked = asked.unwrap_or(0);
    let steps = &steps[..steps.partition_point(|step| step.record.increment < asked)];
    let cheaper = if targets.len() < parameters.len() { Direction::Backward } else { Direction::Forward };
    let backwards = direction.unwrap_or(cheaper) == Direction::Backward;
    let length = length_of_segments(steps.len(), scene.region.len(), plan.memory_bytes);
    let bytes = bytes_per_cell(steps.len(), length).saturating_mul(scene.region.len());
    let mut past = None;
    let mut operators = scene.operators(&pair)?;
    if backwards && (direction.is_some() || memory::check(bytes).is_ok()) {
        past = Past::of(&scene, steps, &mut operators, length);
    }
    let direction = if past.is_some() { Direction::Backward } else { Direction::Forward };
    let mut pass = |side: SideOfEvents| match &mut past {
        Some(past) => backward(&scene, (past, &mut operators, steps), side, &parameters, &targets, &mut tell),
        None => forwards((&scene, &pair), (&parameters, side), &targets, steps, &mut tell),
    };
    let (found, near_events, mut work) = pass(SideOfEvents::Own)?;
    let other = near_events.map(|_| pass(SideOfEvents::Other)).transpose()?;
    let mut others = other.map(|(other, ..)| other.into_iter());
    let gradients = targets.iter().zip(found).map(|(target, by)| Gradient {
        of: target.of.clone(),
        value: target.value,
        by: target.with_aside(by),
        on_the_other_side: others.as_mut().and_then(Iterator::next).map(|by| target.with_aside(by)),
    });
    let gradients = gradients.collect();
    work.kept_bytes = packed + if direction == Direction::Backward { bytes } else { 0 };
    Ok(Sensitivities { parameters, gradients, near_events, direction, work })
}

/// Tells the increments with which a cycle, or a stage without cycles, ends, and for how many cycles it stands.
pub(super) fn end_blocks(steps: &mut [Snapshot], cycles: &[CycleRecord]) {
    for place in 0..steps.len() {
        let StepRecord { stage, increment, .. } = steps[place].record;
        if !steps[place].ends_increment() {
            continue;
        }
        let ends_stage = steps.get(place + 1).is_none_or(|next| next.record.stage != stage);
        let cycle = cycles.iter().find(|cycle| cycle.last_increment == increment);
        steps[place].block = cycle.map_or(usize::from(ends_stage), |cycle| cycle.stands_for);
    }
}

/// Derivatives of the targets by all numbers, forward.
fn forwards(
    (scene, pair): (&Scene<'_>, &Arc<PairCompliance>),
    (parameters, side): (&[Parameter], SideOfEvents),
    targets: &[Target],
    steps: &[Snapshot],
    tell: &mut impl FnMut(&Snapshot) -> ControlFlow<()>,
) -> Result<Found, SensitivityError> {
    let mut found = vec![vec![0.0; parameters.len()]; targets.len()];
    let (near_events, work) =
        forward((scene, pair), (parameters, side), steps, |(step, solved), changes| {
            for (by, target) in found.iter_mut().zip(targets) {
                for (_, column, weight) in target.of_part(step) {
                    let row = Row::new(column, solved);
                    for ((by, change), parameter) in by.iter_mut().zip(changes).zip(parameters) {
                        let [friction, _] = parameter.change_of_friction(&scene.plan.case, step.record.stage);
                        *by += weight * row.change(change, friction);
                    }
                }
            }
            tell(step)
        })?;
    Ok((found, near_events, work))
}

impl Sum<'_> {
    /// Its value, and the columns of increments that it is made of. `below`: the numbers of the stress among its parts, in their order.
    fn target(
        &self,
        (scene, parameters): (&Scene<'_>, &[Parameter]),
        (increments, cycles): (&[&Snapshot], &[CycleRecord]),
        below: &mut impl Iterator<Item = Composed>,
    ) -> Result<Target, SensitivityError> {
        let (of, aside) = (self.of.clone(), vec![0.0; parameters.len()]);
        let mut found = Target { of, value: 0.0, columns: Vec::new(), aside };
        for (name, weight) in &self.parts {
            let none = |reason: &'static str| {
                move || SensitivityError::Objective { name: (*name).clone(), reason: reason.to_owned() }
            };
            let objective = Objective::new(name)?;
            if objective.is_below()
                && let Some(below) = below.next()
            {
                found.add(*weight, below);
                continue;
            }
            if let Some((cycle, column)) = objective.of_loop(name, cycles)? {
                let none = none("this cycle has none: nothing in it moves, or no machine gives");
                let number = of_loop(scene, (increments, cycle), column, parameters).ok_or_else(none)?;
                found.add(*weight, number);
                continue;
            }
            let column = objective.column_of_increments();
            for (increment, sign) in objective.needs(name, (increments.len(), cycles))? {
                let Some(increment) = increment else { continue };
                let value = value_of(&increments[increment].record, column);
                found.value += sign * weight * value.ok_or_else(none("this increment has none"))?;
                found.columns.push((increment, Column::Named(column), sign * weight));
            }
        }
        for (name, weights) in &self.fields {
            let increment = weights.increment(name, increments.len())?;
            found.value += weights.value(increments[increment]);
            let column = Column::Field(weights.in_region(scene));
            found.columns.extend(weights.increments(increment).map(|at| (at, column.clone(), 1.0)));
        }
        Ok(found)
    }
}

/// Takes the increments of a run for later, each after the parts in which it was solved.
pub(super) struct Snapshots<'a> {
    pub steps: Vec<Snapshot>,
    pub cycles: Vec<CycleRecord>,
    pub observer: &'a mut dyn Observer,
    with_slip: bool,
    /// Parts of the increment that is being solved, and whether its last one was solved by the rule of end points.
    parts: Vec<Snapshot>,
    last_by_end_points: Option<bool>,
}

impl<'a> Snapshots<'a> {
    /// Nothing yet; with slip where that is asked for.
    pub fn heard_by(observer: &'a mut dyn Observer, with_slip: bool) -> Self {
        let (steps, cycles, parts) = (Vec::new(), Vec::new(), Vec::new());
        Self { steps, cycles, observer, with_slip, parts, last_by_end_points: None }
    }
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
        self.steps.append(&mut self.parts);
        let mut snapshot = Snapshot::of((record, 1.0), (state.part, self.with_slip), self.steps.last());
        if let Some(by_end_points) = self.last_by_end_points.take() {
            snapshot.by_end_points = by_end_points;
        }
        self.steps.push(snapshot);
        self.observer.solved(record, state, kept)
    }

    fn hears_parts(&self) -> bool {
        true
    }

    fn passed(&mut self, part: &Part<'_>) {
        let Part { share, record, state, .. } = *part;
        if self.last_by_end_points.take().is_some()
            || self.parts.last().is_some_and(|last| last.share >= share)
        {
            // Those of a way that was given up.
            self.parts.clear();
        }
        if share < 1.0 {
            let last = self.parts.last().or(self.steps.last());
            let snapshot = Snapshot::of((record, share), (state.part, self.with_slip), last);
            self.parts.push(snapshot);
        } else {
            self.last_by_end_points = Some(record.work.end_point_increments > 0);
        }
    }

    fn leaves_fields(&self) -> bool {
        false
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.cycles.push(record.clone());
        self.observer.cycled(record);
    }
}
