//! Derivatives of a history by numbers of its case: the run, and for every increment the linear equations of each parameter (forward
//! differentiation).

use std::ops::ControlFlow;

use super::after::Changes;
use super::bodies::change_of_response;
use super::cell::{MOTIONS, Prescribed};
use super::error::SensitivityError;
use super::events::{NearEvents, near_events};
use super::krylov;
use super::linearised::{Linearised, displacements, zeros};
use super::loads::Load;
use super::objective::{Objective, change_of, value_of};
use super::parameter::Parameter;
use super::refusals::{check, check_history, check_request};
use super::scene::{Scene, Snapshot, Solved, field};
use super::track::{Drive, Known, Track};
use crate::compliance::{SpectralCompliance, SurfaceCompliance};
use crate::fields::add_scaled;
use crate::history::{CycleRecord, KeptFields, StepRecord};
use crate::machine::memory;
use crate::model::{CoulombFriction, MirroredState};
use crate::plan::Plan;
use crate::run::{Iteration, Observer, PairCompliance, RunError, Simulation};
use fret_fft::ConvolutionError;

/// Relative residual of the linear equations that is aimed at, and one that is good enough.
const TARGET: f64 = 1e-12;
const ENOUGH: f64 = 1e-9;
/// Bytes a cell of a state that is kept: five fields and the zone.
const STATE: usize = 41;

/// What is asked.
#[derive(Debug, Clone, Default)]
pub struct Request {
    /// Results: columns of the last increment (`max_pressure`), of others (`increments[7].shift_x`), `cycles[0].dissipated_energy`.
    pub of: Vec<String>,
    /// Paths of numbers of the case (`friction.coefficient`, `lower.coatings[0].young`); empty: all there are.
    pub by: Vec<String>,
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
    /// Where most cells are about to change their state, so that derivatives on either side differ; `None`: nowhere any.
    pub near_events: Option<NearEvents>,
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
    check(plan)?;
    let parameters = if request.by.is_empty() {
        Parameter::all_of(&plan.case)
    } else {
        request.by.iter().map(|path| Parameter::new(path, &plan.case)).collect::<Result<_, _>>()?
    };
    let objectives = request.of.iter().map(|name| Objective::new(name)).collect::<Result<Vec<_>, _>>()?;
    check_request(plan, &parameters, &objectives)?;
    let bytes = plan.grid.len().saturating_mul(STATE).saturating_mul(plan.case.increments());
    memory::check(bytes).map_err(|error| RunError::OutOfMemory { increment: 0, error })?;
    let mut run = Snapshots { steps: Vec::new(), cycles: Vec::new(), observer };
    Simulation::new(plan).run(&mut run)?;
    let Snapshots { steps, cycles, observer } = run;
    if let Some(step) = steps.iter().find(|step| step.record.parts > 1) {
        return Err(SensitivityError::Parts { increment: step.record.increment, parts: step.record.parts });
    }
    check_history(plan, steps.iter().map(|step| step.record.contact_cells))?;
    let mut gradients: Vec<Gradient> = request
        .of
        .iter()
        .map(|name| Gradient { of: name.clone(), value: 0.0, by: vec![0.0; parameters.len()] })
        .collect();
    let needs = objectives
        .iter()
        .zip(&request.of)
        .map(|(objective, name)| objective.needs(name, (steps.len(), &cycles)))
        .collect::<Result<Vec<_>, _>>()?;
    let near_events = tangents(plan, &parameters, &steps, |step, tracks| {
        for ((gradient, objective), needs) in gradients.iter_mut().zip(&objectives).zip(&needs) {
            for (_, sign) in needs.iter().filter(|(needed, _)| *needed == Some(step.record.increment)) {
                let column = objective.column();
                gradient.value += sign * value_of(&step.record, column);
                for ((by, track), parameter) in gradient.by.iter_mut().zip(tracks).zip(&parameters) {
                    let [friction, _] = parameter.change_of_friction(&plan.case, step.record.stage);
                    *by += sign * change_of(track, (column, friction));
                }
            }
        }
        let StepRecord { increment, stage, .. } = step.record;
        let tolerance = plan.case.tolerance;
        observer.iterated(&Iteration { increment, stage, iteration: 0, residual: 0.0, tolerance })
    })?;
    Ok(Sensitivities { parameters, gradients, near_events })
}

/// Takes the increments of a run for later.
struct Snapshots<'a> {
    steps: Vec<Snapshot>,
    cycles: Vec<CycleRecord>,
    observer: &'a mut dyn Observer,
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

/// One parameter on its way through the history.
struct Course<'a> {
    parameter: &'a Parameter,
    track: Track,
    /// What is held, and where the stage at work started.
    held: Load,
    start: Load,
    /// Derivative of the gap before deformation, and of the response.
    gap: ndarray::Array2<f64>,
    response: Option<SpectralCompliance>,
}

/// Goes through a history that was solved, and shows its derivatives after every increment. Tells where most cells are about to change their
/// state.
fn tangents(
    plan: &Plan,
    parameters: &[Parameter],
    steps: &[Snapshot],
    mut visit: impl FnMut(&Snapshot, &[&Track]) -> ControlFlow<()>,
) -> Result<Option<NearEvents>, SensitivityError> {
    let operators_failed = |error: ConvolutionError| SensitivityError::Operators(error.to_string());
    let scene = Scene::new(plan, steps);
    let compliance = PairCompliance::of(plan);
    let mut operators =
        scene.operators(&compliance.response, compliance.table.as_ref()).map_err(operators_failed)?;
    let mut courses = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let gap = change_of_gap(parameter, &scene);
        let change = parameter.of_body().map(|number| change_of_response(plan, number));
        let response =
            change.map(|change| scene.compliance(&change)).transpose().map_err(operators_failed)?;
        let track = Track::untouched(&scene, &gap);
        courses.push(Course { parameter, track, held: Load::FREE, start: Load::FREE, gap, response });
    }
    let untouched = crate::model::ContactState::untouched(scene.grid.cells());
    let mut most: Option<NearEvents> = None;
    let (mut stage, mut of_stage) = (usize::MAX, 0);
    for (number, step) in steps.iter().enumerate() {
        let before = if number == 0 { &untouched } else { &steps[number - 1].state };
        let begins = step.record.stage != stage;
        (stage, of_stage) = (step.record.stage, if begins { 1 } else { of_stage + 1 });
        let given = &plan.case.stages[stage];
        for course in &mut courses {
            if begins {
                course.start = course.held.at_start_of(given, &course.track.reached);
            }
            course.held = course.start.after((given, stage), of_stage, course.parameter);
        }
        let law = law_of(plan, stage);
        let solved = scene.solved(step, law, &mut operators);
        let mut knowns = Vec::with_capacity(courses.len());
        for course in &mut courses {
            let drive = drive(course, (&scene, &solved), before, stage);
            let stands = course.track.stands(&drive.load);
            let friction_changes = begins && given.friction.is_some();
            if stands && (friction_changes || !course.track.pauses(&drive.load)) {
                return Err(SensitivityError::NotCovered {
                    key: format!(
                        "increment {number}, in which no load changes but friction or the number itself, {}",
                        course.parameter.path()
                    ),
                    advice: "let a load change in each increment, or take the number of the stage before",
                });
            }
            knowns.push((!stands).then(|| (course.track.known(&scene, &solved, &drive), drive)));
        }
        if let Some(near) = advance((&scene, &solved), &mut operators, &mut courses, knowns)?
            && near.cells > most.map_or(0, |most| most.cells)
        {
            most = Some(near);
        }
        let tracks: Vec<&Track> = courses.iter().map(|course| &course.track).collect();
        if visit(step, &tracks).is_break() {
            return Err(RunError::Interrupted { increment: number }.into());
        }
    }
    Ok(most)
}

/// The law of friction in force at a stage.
fn law_of(plan: &Plan, stage: usize) -> &CoulombFriction {
    let mut latest_first = plan.case.stages.iter().take(stage + 1).rev();
    latest_first.find_map(|stage| stage.friction.as_ref()).unwrap_or(&plan.case.friction)
}

/// Derivative of the gap before deformation in the region; with heights it is counted from the cell that touches first.
fn change_of_gap(parameter: &Parameter, scene: &Scene<'_>) -> ndarray::Array2<f64> {
    let (plan, grid) = (scene.plan, &scene.plan.grid);
    let mut change = ndarray::Array2::zeros(grid.cells());
    if !parameter.is_of_shape() {
        return field(scene.region, &plan.symmetry.part(&change));
    }
    for ((i, j), change) in change.indexed_iter_mut() {
        *change = parameter.change_of_gap(&plan.case, grid.centre(0, i), grid.centre(1, j));
    }
    let gap = plan.case.profile.gap(grid);
    if !plan.case.profile.heights.is_empty() {
        let first = gap.indexed_iter().fold(([0, 0], f64::INFINITY), |(at, least), ((i, j), gap)| {
            if *gap < least { ([i, j], *gap) } else { (at, least) }
        });
        let first = change[first.0];
        change -= first;
    }
    field(scene.region, &plan.symmetry.part(&change))
}

/// What an increment depends on by a parameter.
fn drive(
    course: &mut Course<'_>,
    (scene, solved): (&Scene<'_>, &Solved<'_>),
    before: &crate::model::ContactState,
    stage: usize,
) -> Drive {
    let case = &scene.plan.case;
    let copies = scene.plan.symmetry.copies() as f64;
    let by_response = match &mut course.response {
        Some(change) if solved.contact.len() > 0 => {
            displacements(change, scene.is_frictional(), &solved.tractions)
        }
        _ => zeros(scene.region.len()),
    };
    Drive {
        load: course.held.of_part(scene, before),
        gap: course.gap.clone(),
        friction: course.parameter.change_of_friction(case, stage),
        rig: course.parameter.change_of_rig(case).map(|change| change * copies),
        by_response,
    }
}

/// Solves the linear equations of an increment for all parameters.
fn advance(
    (scene, solved): (&Scene<'_>, &Solved<'_>),
    operators: &mut super::linearised::Operators,
    courses: &mut [Course<'_>],
    knowns: Vec<Option<(Known, Drive)>>,
) -> Result<Option<NearEvents>, SensitivityError> {
    let Some((first, first_drive)) = knowns.iter().flatten().next() else {
        for course in courses {
            course.track.zone.clone_from(&solved.zone);
        }
        return Ok(None);
    };
    let cells = first.cells.clone();
    let asked_of = |track: &Track, drive: &Drive| track.prescribed(scene, solved, drive);
    let kinds = asked_of(&courses[0].track, first_drive).map(|(kind, _)| kind);
    let region = scene.region.len();
    let own = operators.compliance.self_influence();
    let mut near = None;
    let mut linear = Linearised::new(operators, (&solved.contact, &cells), kinds, region);
    for (course, known) in courses.iter_mut().zip(knowns) {
        let Some((known, drive)) = known else { continue };
        let prescribed = asked_of(&course.track, &drive);
        if cells.is_empty() {
            let changes = apart(&course.track, scene, &drive, &prescribed);
            course.track.finish((scene, solved), (&drive, known), &changes);
            continue;
        }
        // Shear that follows a change of the friction bound, whatever else changes.
        let mut given = zeros(region);
        for (number, cell) in solved.contact.cells().enumerate() {
            for axis in 0..2 {
                given[1 + axis][cell] = known.bounds[number].change * cells[number].along[axis];
            }
        }
        let mut moved = linear.displacements(&given);
        for part in 0..3 {
            add_scaled(&mut moved[part], 1.0, &drive.by_response[part]);
        }
        let mut asked = known.asked((scene, solved), &drive);
        for (number, cell) in solved.contact.cells().enumerate() {
            let [normal, x, y] = [0, 1, 2].map(|part| moved[part][cell]);
            asked[0][number] -= normal;
            if let Some(row) = cells[number].row() {
                asked[1][number] -= row[0] * x + row[1] * y;
            } else {
                asked[1][number] -= x;
                asked[2][number] -= y;
            }
        }
        let packed = given.each_ref().map(|field| solved.contact.packed(field));
        let follows = linear.resultants(&packed);
        let amounts: [f64; MOTIONS] = std::array::from_fn(|motion| match prescribed[motion] {
            (Prescribed::Motion, change) => change,
            (Prescribed::Resultant, change) => change - follows[motion],
            (Prescribed::FarEnd(give), change) => change - give * follows[motion],
        });
        let right = linear.right_side(&asked, &amounts);
        let (found, reached) = krylov::solve(&mut linear, &right, TARGET);
        if !(reached <= ENOUGH) {
            let path = course.parameter.path().to_owned();
            let increment = solved.record.increment;
            return Err(SensitivityError::NotSolved { increment, path, reached, target: ENOUGH });
        }
        let (mut tractions, motions) = linear.parted(&found);
        for part in 0..3 {
            add_scaled(&mut tractions[part], 1.0, &given[part]);
        }
        let mut changes = linear.displacements(&tractions);
        for part in 0..3 {
            add_scaled(&mut changes[part], 1.0, &drive.by_response[part]);
        }
        let changes = Changes { tractions, displacements: changes, motions };
        if near.is_none() {
            near = Some(near_events((scene, solved), &known, [own.normal, own.tangential]));
        }
        course.track.finish((scene, solved), (&drive, known), &changes);
    }
    Ok(near)
}

/// Changes of bodies that do not touch: motions that are prescribed, and an approach to the first touch where a force is.
fn apart(
    track: &Track,
    scene: &Scene<'_>,
    drive: &Drive,
    prescribed: &[(Prescribed, f64); MOTIONS],
) -> Changes {
    let lowest =
        scene.undeformed.indexed_iter().fold(([0, 0], f64::INFINITY), |(at, least), ((i, j), gap)| {
            if *gap < least { ([i, j], *gap) } else { (at, least) }
        });
    let motions = std::array::from_fn(|motion| match prescribed[motion] {
        (Prescribed::Motion | Prescribed::FarEnd(_), change) => change,
        (Prescribed::Resultant, _) if motion == 0 => drive.gap[lowest.0],
        (Prescribed::Resultant, _) => track.motions[motion].change,
    });
    let cells = scene.region.len();
    Changes { tractions: zeros(cells), displacements: zeros(cells), motions }
}
