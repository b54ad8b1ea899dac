//! Forward differentiation: the changes by each number, carried from increment to increment of a history that was solved.

use std::ops::ControlFlow;
use std::sync::Arc;

use ndarray::Array2;

use super::block::Block;
use super::bodies::change_of_response;
use super::change::Change;
use super::contact::Drive;
use super::error::SensitivityError;
use super::events::{NearEvents, SideOfEvents, cells_near_events, with_cells};
use super::evolution::Evolution;
use super::increment::{ENOUGH, Increment};
use super::loads::Load;
use super::operators::displacements;
use super::parameter::Parameter;
use super::replay::Replay;
use super::scene::{Scene, field};
use super::snapshot::Snapshot;
use super::solved::Solved;
use super::strain::Strain;
use super::work::Work;
use crate::compliance::SpectralCompliance;
use crate::model::controls::FREEDOMS;
use crate::run::{PairCompliance, RunError};

/// One number on its way through the history.
struct Course<'a> {
    parameter: &'a Parameter,
    before: Change,
    former: Change,
    /// Derivatives of the gap before deformation, of the response, and of the strain by bulk stresses.
    gap: Vec<f64>,
    response: Option<SpectralCompliance>,
    strain: Option<Strain>,
}

/// Derivative of the response by a number, where it is one of a body.
pub(super) fn response_by(
    scene: &Scene<'_>,
    parameter: &Parameter,
) -> Result<Option<SpectralCompliance>, SensitivityError> {
    // Over the region and what lies behind the mirrors.
    let [rows, columns] = scene.plan.symmetry.whole_of(scene.region.shape);
    let [most_rows, most_columns] = scene.plan.grid.cells();
    let cells = [rows.min(most_rows), columns.min(most_columns)];
    let change = parameter.of_body().map(|number| change_of_response(scene.plan, number, cells));
    let made = change.map(|change| scene.compliance(&change)).transpose();
    made.map_err(|error| SensitivityError::Operators(error.to_string()))
}

/// Derivative of the gap before deformation in the region; with heights it is counted from the cell that touches first.
pub(super) fn change_of_gap(parameter: &Parameter, scene: &Scene<'_>) -> Vec<f64> {
    let (plan, grid) = (scene.plan, &scene.plan.grid);
    let in_region = |change: Array2<f64>| {
        let part = field(scene.region, &plan.symmetry.part(&change));
        part.into_raw_vec_and_offset().0
    };
    let mut change = Array2::zeros(grid.cells());
    if !parameter.is_of_shape() {
        return in_region(change);
    }
    for ((i, j), change) in change.indexed_iter_mut() {
        *change = parameter.change_of_gap(&plan.case, grid.centre(0, i), grid.centre(1, j));
    }
    if !plan.case.profile.heights.is_empty() {
        let gap = plan.case.profile.gap(grid);
        let first = gap.indexed_iter().fold(([0, 0], f64::INFINITY), |(at, least), ((i, j), gap)| {
            if *gap < least { ([i, j], *gap) } else { (at, least) }
        });
        let first = change[first.0];
        change -= first;
    }
    in_region(change)
}

/// Goes through a history that was solved, and shows the changes by each number after every increment, on the side of the solution or on the other
/// one. Tells where most cells are about to change
/// their state.
pub(super) fn forward(
    (scene, pair): (&Scene<'_>, &Arc<PairCompliance>),
    (parameters, side): (&[Parameter], SideOfEvents),
    steps: &[Snapshot],
    mut visit: impl FnMut((&Snapshot, &Solved), &[&Change]) -> ControlFlow<()>,
) -> Result<(Option<NearEvents>, Work), SensitivityError> {
    let mut operators = scene.operators(pair)?;
    let mut courses = Vec::with_capacity(parameters.len());
    for parameter in parameters {
        let gap = change_of_gap(parameter, scene);
        let untouched = Change { gap: gap.clone(), ..scene.no_change() };
        let response = response_by(scene, parameter)?;
        let strain = parameter.of_body().and_then(|number| Strain::by(scene.plan, number, scene.length));
        courses.push(Course {
            parameter,
            before: untouched.clone(),
            former: untouched,
            gap,
            response,
            strain,
        });
    }
    let mut replay = Replay::new(scene);
    let mut past = [replay.start.clone(), replay.start.clone()];
    let mut most: Option<NearEvents> = None;
    for (place, step) in steps.iter().enumerate() {
        let last = place.checked_sub(1).map(|last| &steps[last]);
        let number = step.record.increment;
        let next = replay.next((step, last), past.each_ref().map(Some), (&mut operators, None));
        let stage = next.load.stage;
        let numbers: Vec<_> = courses.iter().map(|course| course.controls(stage)).collect();
        if let Some(solved) = next.solved {
            let step_and_load = (step.by_end_points, &next.load);
            let increment = Increment::new(scene, step_and_load, &solved, past.each_ref());
            let own = operators.self_influence();
            let near = if increment.contact.cells.is_empty() {
                Vec::new()
            } else {
                cells_near_events(&solved, &increment.contact, [own.normal, own.tangential])
            };
            if let Some(near) = NearEvents::of((scene, &solved, number), near.len())
                && near.cells > most.map_or(0, |most| most.cells)
            {
                most = Some(near);
            }
            let other = (side == SideOfEvents::Other && !near.is_empty()).then(|| with_cells(&solved, &near));
            let increment = match &other {
                Some(other) => Increment::new(scene, step_and_load, other, past.each_ref()),
                None => increment,
            };
            let mut equations = increment.equations(&mut operators)?;
            for (course, numbers) in courses.iter_mut().zip(&numbers) {
                let drive = course.drive(scene, (&solved, &past[0]), &next.load);
                let changes = [&course.before, &course.former];
                let after = increment.forward(&mut equations, changes, (&drive, numbers));
                let after = after.map_err(|reached| SensitivityError::NotSolved {
                    increment: number,
                    of: format!("by {}", course.parameter.path()),
                    reached,
                    target: ENOUGH,
                })?;
                course.former = std::mem::replace(&mut course.before, after);
            }
            drop(equations);
            drop(increment);
            drop(other);
            let [before, former] = &mut past;
            *former = std::mem::replace(before, solved);
        } else {
            let rubbed = scene.evolves() && last.is_some_and(|last| last.block > 0);
            let begins_with_friction =
                rubbed || next.load.begins && scene.plan.case.stages[stage].friction.is_some();
            let before = past[0].clone();
            past[0].stood(step, last, scene.region);
            let block = (step.block > 0).then(|| Block::new(scene, [&before, &past[0]], step.block));
            for (course, numbers) in courses.iter_mut().zip(&numbers) {
                let mut after = course.before.clone();
                next.load.forward(&course.before, numbers, &mut after);
                if begins_with_friction || after.load != course.before.load {
                    return Err(SensitivityError::NotCovered {
                        key: format!(
                            "increment {number}, in which no load changes but friction or the number itself, {}",
                            course.parameter.path()
                        ),
                        advice: "let a load change in each increment, or take the number of the stage before",
                    });
                }
                (course.before.start, course.before.held) = (after.start, after.held);
                course.before.slip.iter_mut().for_each(|slip| slip.fill(0.0));
                if let Some(block) = &block {
                    let (case, parameter) = (&scene.plan.case, course.parameter);
                    let (wear, layers) = (parameter.change_of_wear(), parameter.change_of_layers(case));
                    block.forward(&mut course.before, &wear, &layers);
                }
            }
        }
        let changes: Vec<&Change> = courses.iter().map(|course| &course.before).collect();
        if visit((step, &past[0]), &changes).is_break() {
            return Err(RunError::Interrupted { increment: number }.into());
        }
    }
    let responses = courses.iter().filter_map(|course| course.response.as_ref());
    let of_constants = responses.map(|response| response.applications).sum();
    Ok((most, Work::of(&operators, of_constants)))
}

impl Course<'_> {
    /// Derivatives of what a stage prescribes by the number.
    fn controls(&self, stage: usize) -> [f64; FREEDOMS] {
        std::array::from_fn(|freedom| f64::from(u8::from(self.parameter.is_control(stage, freedom))))
    }

    /// What an increment depends on by the number.
    fn drive(&mut self, scene: &Scene<'_>, (solved, before): (&Solved, &Solved), load: &Load) -> Drive {
        let case = &scene.plan.case;
        let mut drive = Drive::none(scene);
        drive.gap.clone_from(&self.gap);
        drive.friction.everywhere = self.parameter.change_of_friction(case, load.stage);
        if let Some(evolution) = Evolution::of(scene, before.slipped.as_deref()) {
            let numbers = self.parameter.change_of_evolution(case);
            drive.friction.cells = evolution.forward(&self.before.slipped, &numbers);
        }
        drive.rig = self.parameter.change_of_rig(case);
        drive.wear = self.parameter.change_of_wear();
        drive.layers = self.parameter.change_of_layers(case);
        if let Some(strain) = &self.strain {
            drive.strain = strain.under(load.step.bulk_stress);
        }
        if let Some(change) = &mut self.response
            && solved.contact.len() > 0
        {
            drive.response = displacements(change, scene.is_frictional(), &solved.tractions);
        }
        drive
    }
}
