//! Backward differentiation: how objectives change with all that an increment leaves behind, carried from the last increment to the first; one linear
//! problem for each increment and objective serves all numbers of the case.

use std::ops::ControlFlow;

use super::case_number::OF_WEAR;
use super::change::Change;
use super::constants::Constants;
use super::contact::Drive;
use super::error::SensitivityError;
use super::events::{NearEvents, SideOfEvents, cells_near_events, with_cells};
use super::evolution::Evolution;
use super::forward::change_of_gap;
use super::increment::{ENOUGH, Increment};
use super::operators::Operators;
use super::parameter::Parameter;
use super::past::Past;
use super::row::{Column, Composed, Row};
use super::scene::Scene;
use super::snapshot::Snapshot;
use super::solved::Solved;
use super::strain::{STRESSES, Strain};
use super::work::Work;
use crate::fields::{add_scaled, dot};
use crate::model::controls::FREEDOMS;
use crate::run::RunError;

/// An objective: its name, its value, columns of increments, each with its weight, and what it changes with each number of the case beside these.
pub(super) struct Target {
    pub of: String,
    pub value: f64,
    pub columns: Vec<(usize, Column, f64)>,
    pub aside: Vec<f64>,
}

impl Target {
    /// The columns of a part of an increment.
    pub fn of_part(&self, step: &Snapshot) -> impl Iterator<Item = &(usize, Column, f64)> {
        let (number, ends) = (step.record.increment, step.ends_increment());
        self.columns.iter().filter(move |(of, column, _)| *of == number && column.is_in_part(ends))
    }

    /// Adds a result that is made of columns, by a weight.
    pub fn add(&mut self, weight: f64, of: Composed) {
        self.value += weight * of.value;
        self.columns.extend(of.columns.into_iter().map(|(at, column, by)| (at, column, weight * by)));
        add_scaled(&mut self.aside, weight, &of.by);
    }

    /// Its derivatives by all numbers, from those of its columns.
    pub fn with_aside(&self, mut by: Vec<f64>) -> Vec<f64> {
        add_scaled(&mut by, 1.0, &self.aside);
        by
    }
}

/// How an objective changes with what a history is made from.
struct Gathered {
    /// Those after the increment at work, after the one before it, and after the one before that.
    changes: [Change; 3],
    gap: Vec<f64>,
    rig: [f64; 3],
    wear: [f64; OF_WEAR],
    /// Coefficient and thickness of each layer that wears, and numbers of the law by which friction evolves.
    layers: Vec<[f64; 2]>,
    evolution: Vec<f64>,
    /// Of the strains along x and y, each times a bulk stress.
    strain: [[f64; STRESSES]; 2],
    /// Coefficient and strength, and numbers of the controls, stage by stage.
    friction: Vec<[f64; 2]>,
    controls: Vec<[f64; FREEDOMS]>,
    /// The largest product of a right side and of tractions so far.
    largest: f64,
}

impl Gathered {
    fn nothing(scene: &Scene<'_>, stages: usize) -> Self {
        let evolution = scene.plan.case.friction_evolution.as_ref();
        Self {
            changes: [(); 3].map(|()| scene.no_change()),
            gap: vec![0.0; scene.region.len()],
            wear: [0.0; OF_WEAR],
            layers: vec![[0.0; 2]; scene.wearing_layers()],
            evolution: vec![0.0; evolution.map_or(0, |rule| rule.law.numbers())],
            strain: [[0.0; STRESSES]; 2],
            rig: [0.0; 3],
            friction: vec![[0.0; 2]; stages],
            controls: vec![[0.0; FREEDOMS]; stages],
            largest: 0.0,
        }
    }

    /// Takes the columns of the objective in a part of an increment.
    fn take(&mut self, target: &Target, (step, stage): (&Snapshot, usize), solved: &Solved) {
        for (_, column, weight) in target.of_part(step) {
            let [coefficient, _] = &mut self.friction[stage];
            Row::new(column, solved).add(*weight, &mut self.changes[0], coefficient);
        }
    }

    /// Its derivative by a number, without what a constant of a body does by the response.
    fn by(&self, parameter: &Parameter, scene: &Scene<'_>) -> f64 {
        let case = &scene.plan.case;
        let mut sum = dot(&self.wear, &parameter.change_of_wear());
        sum += dot(self.layers.as_flattened(), parameter.change_of_layers(case).as_flattened());
        sum += dot(&self.evolution, &parameter.change_of_evolution(case));
        if parameter.is_of_shape() {
            sum += dot(&self.gap, &change_of_gap(parameter, scene));
        }
        let strain = parameter.of_body().and_then(|number| Strain::by(scene.plan, number, scene.length));
        sum += strain.map_or(0.0, |strain| strain.times(&self.strain));
        for (of, by) in self.rig.iter().zip(parameter.change_of_rig(case)) {
            sum += of * by;
        }
        for (stage, (friction, controls)) in self.friction.iter().zip(&self.controls).enumerate() {
            for (of, by) in friction.iter().zip(parameter.change_of_friction(case, stage)) {
                sum += of * by;
            }
            let of_controls = controls.iter().enumerate();
            sum += of_controls
                .filter(|(freedom, _)| parameter.is_control(stage, *freedom))
                .map(|(_, of)| of)
                .sum::<f64>();
        }
        sum
    }
}

/// Derivatives of targets by all numbers, where most cells are about to change their state, and what that took.
pub(super) type Found = (Vec<Vec<f64>>, Option<NearEvents>, Work);

/// Derivatives of the targets by all numbers, on the side of the solution or on the other one, with all cells that are about to change their state
/// in that. `visit` is told every increment.
pub(super) fn backward(
    scene: &Scene<'_>,
    (past, operators, steps): (&mut Past<'_>, &mut Operators, &[Snapshot]),
    side: SideOfEvents,
    parameters: &[Parameter],
    targets: &[Target],
    mut visit: impl FnMut(&Snapshot) -> ControlFlow<()>,
) -> Result<Found, SensitivityError> {
    let stages = scene.plan.case.stages.len();
    let mut gathered: Vec<Gathered> = targets.iter().map(|_| Gathered::nothing(scene, stages)).collect();
    let mut constants = Constants::new(scene, parameters, targets.len())?;
    let mut most: Option<NearEvents> = None;
    for (place, step) in steps.iter().enumerate().rev() {
        past.come_to(place, operators)?;
        let (load, now, before) = past.at(place);
        let number = step.record.increment;
        for (gathered, target) in gathered.iter_mut().zip(targets) {
            gathered.take(target, (step, load.stage), now);
        }
        if visit(step).is_break() {
            return Err(RunError::Interrupted { increment: number }.into());
        }
        let increment = Increment::new(scene, (step.by_end_points, load), now, before);
        let own = operators.self_influence();
        let near = cells_near_events(now, &increment.contact, [own.normal, own.tangential]);
        // The earliest of those with as many, as forward.
        if let Some(near) = NearEvents::of((scene, now, number), near.len())
            && near.cells >= most.map_or(0, |most| most.cells)
        {
            most = Some(near);
        }
        let other = (side == SideOfEvents::Other && !near.is_empty()).then(|| with_cells(now, &near));
        let increment = match &other {
            Some(other) => Increment::new(scene, (step.by_end_points, load), other, before),
            None => increment,
        };
        if gathered.iter().all(|gathered| gathered.changes[0].is_none()) {
            for gathered in &mut gathered {
                gathered.changes.rotate_left(1);
            }
            continue;
        }
        constants.begin(&now.tractions);
        let [last, _] = before;
        let evolution = Evolution::of(scene, last.slipped.as_deref());
        let mut equations = increment.equations(operators)?;
        for (objective, (gathered, target)) in gathered.iter_mut().zip(targets).enumerate() {
            let [after, before, former] = &mut gathered.changes;
            let after = std::mem::replace(after, scene.no_change());
            if after.is_none() {
                gathered.changes.rotate_left(1);
                continue;
            }
            let mut drive = Drive::none(scene);
            let numbers = &mut gathered.controls[load.stage];
            let found = increment.transposed(
                &mut equations,
                after,
                [&mut *before, former],
                (&mut drive, numbers),
                &mut gathered.largest,
            );
            found.map_err(|reached| SensitivityError::NotSolved {
                increment: number,
                of: format!("of {}", target.of),
                reached,
                target: ENOUGH,
            })?;
            add_scaled(&mut gathered.gap, 1.0, &drive.gap);
            for (sum, by) in gathered.friction[load.stage].iter_mut().zip(drive.friction.everywhere) {
                *sum += by;
            }
            for (sum, by) in gathered.rig.iter_mut().zip(drive.rig) {
                *sum += by;
            }
            if let Some(evolution) = &evolution {
                evolution.transposed(&drive.friction.cells, &mut before.slipped, &mut gathered.evolution);
            }
            add_scaled(&mut gathered.wear, 1.0, &drive.wear);
            add_scaled(gathered.layers.as_flattened_mut(), 1.0, drive.layers.as_flattened());
            for (sums, of) in gathered.strain.iter_mut().zip(drive.strain) {
                let stresses = load.step.bulk_stress.as_flattened();
                sums.iter_mut().zip(stresses).for_each(|(sum, stress)| *sum += of * stress);
            }
            constants.take(objective, &now.tractions, &drive.response);
            gathered.changes.rotate_left(1);
        }
    }
    for gathered in &mut gathered {
        let [start, earlier, _] = &gathered.changes;
        add_scaled(&mut gathered.gap, 1.0, &start.gap);
        add_scaled(&mut gathered.gap, 1.0, &earlier.gap);
    }
    let by = |(objective, gathered): (usize, &Gathered)| {
        let of =
            |(number, parameter)| gathered.by(parameter, scene) + constants.derivative(objective, number);
        parameters.iter().enumerate().map(of).collect()
    };
    let work = Work::of(operators, constants.applications());
    Ok((gathered.iter().enumerate().map(by).collect(), most, work))
}
