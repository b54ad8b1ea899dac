//! Which closed form speaks about a case, recognised from its plan, and what it says at the end of each stage.
//!
//! Normal: what [`NormalForm`] knows, without normal-tangential coupling. Tangential: what [`TangentialForm`] knows of prescribed forces. A
//! sphere must have a Poisson's ratio of zero: with any other the form neglects the slip across the force, and is no measure of a hundredth
//! of a percent.

use super::normal_form::{NormalForm, Pressed};
use super::partial_slip::{Loaded, PartialSlip, TangentialForm};
use super::quantities::{PerQuantity, Quantity};
use crate::case::{Case, Stage};
use crate::model::{Control, Frame, LoadStep};
use crate::plan::{Coupling, Plan};

/// Fraction of the largest force below which a planned force, or its change, is none.
const NOTHING: f64 = 1e-12;

/// What a closed form says of one stage's end; `None` where it says nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Said(PerQuantity<Option<[f64; 2]>>);

impl Said {
    /// A quantity of interest, scalars first.
    pub fn of(&self, quantity: Quantity) -> Option<[f64; 2]> {
        self.0[quantity as usize]
    }

    fn say(&mut self, quantity: Quantity, value: Option<f64>) {
        self.say_along(quantity, [1.0, 0.0], value);
    }

    fn say_along(&mut self, quantity: Quantity, direction: [f64; 2], value: Option<f64>) {
        self.0[quantity as usize] = value.map(|value| direction.map(|part| part * value));
    }
}

/// Exact answers to a case.
#[derive(Debug, Clone)]
pub struct ClosedForm {
    name: &'static str,
    ends: Vec<Said>,
    last: Pressed,
    /// Partial slip at the end, and the direction of the force.
    shear: Option<(PartialSlip, [f64; 2])>,
}

impl ClosedForm {
    /// The closed form of a plan, where it has one.
    pub fn of(plan: &Plan) -> Option<Self> {
        let case = &plan.case;
        // A contact that has rolled over its bodies lies elsewhere on their grid.
        let lies_elsewhere = case.rolls() && case.kinematics.frame == Frame::Bodies;
        if case.is_open_ended() || plan.coupling == Coupling::Coupled || lies_elsewhere {
            return None;
        }
        let normal = NormalForm::of(plan)?;
        let loads = loads(case);
        let at_end = |number: usize| loads.iter().rfind(|(stage, _)| *stage == number);
        let pressed = (0..case.stages.len()).map(|number| normal.under(at_end(number)?.1.normal));
        let pressed: Vec<Pressed> = pressed.collect::<Option<_>>()?;
        let mut ends: Vec<Said> = pressed.iter().map(said).collect();
        let last = *pressed.last()?;
        let shear = if case.rolls() {
            None // partial slip of bodies that stay opposite each other says nothing of it
        } else if case.is_frictionless() || !case.stages.iter().any(Stage::is_tangential) {
            // Without any tangential cause nothing slips and nothing is lost.
            for said in &mut ends {
                said.say(Quantity::Shift, Some(0.0));
                said.say(Quantity::DissipatedEnergy, Some(0.0));
            }
            None
        } else {
            tangential(plan, &normal, &loads, &mut ends)
        };
        let name = match (&last, &shear) {
            (Pressed::Sphere(_), Some(_)) => "Hertz; Cattaneo and Mindlin",
            (Pressed::Line(..), Some(_)) => "Hertz; Cattaneo",
            _ => normal.name(),
        };
        Some(Self { name, ends, last, shear })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What it says at the end of each stage.
    pub fn ends(&self) -> &[Said] {
        &self.ends
    }

    /// Pressure as a function of the place at the end of the history, for many places [pressure].
    pub fn pressure_everywhere(&self) -> Box<dyn Fn(f64, f64) -> f64> {
        self.last.pressure_everywhere()
    }

    /// Whether it knows the shear.
    pub fn knows_shear(&self) -> bool {
        self.shear.is_some()
    }

    /// Shear at a point at the end of the history, x and y [pressure]; zero where it does not know it.
    pub fn shear(&self, x: f64, y: f64) -> [f64; 2] {
        self.shear
            .as_ref()
            .map_or([0.0; 2], |(slip, direction)| direction.map(|part| part * slip.shear(x, y)))
    }
}

fn said(pressed: &Pressed) -> Said {
    let mut said = Said::default();
    said.say(Quantity::MaxPressure, pressed.peak());
    said.say(Quantity::Approach, pressed.approach());
    said.say(Quantity::ContactArea, Some(pressed.area()));
    said
}

/// The number of the stage of every increment, and what is prescribed at its end. Where a control changes its kind only the end of its stage
/// is right.
fn loads(case: &Case) -> Vec<(usize, LoadStep)> {
    let force = Control::Force(0.0);
    let free = LoadStep { normal: force, tangential: [force; 2], ..LoadStep::FREE };
    let mut held = case.start.unwrap_or(free);
    let mut all = Vec::new();
    for (number, stage) in case.stages.iter().enumerate() {
        let start = held;
        for k in 1..=stage.increments_in_all() {
            held = stage.load(&start, k);
            all.push((number, held));
        }
    }
    all
}

/// Follows the tangential force through the stages and adds what is known; gives the slip at the end, and the direction of the force.
fn tangential(
    plan: &Plan,
    normal: &NormalForm,
    loads: &[(usize, LoadStep)],
    ends: &mut [Said],
) -> Option<(PartialSlip, [f64; 2])> {
    let stages = &plan.case.stages;
    let first = stages.iter().position(Stage::is_tangential)?;
    if stages.iter().any(|stage| stage.twist.is_some() || stage.stretches()) {
        return None;
    }
    let loaded = |(stage, load): &(usize, LoadStep)| {
        // Before the first tangential force nothing is asked of the normal one but that it can be followed.
        let normal = if *stage < first { 0.0 } else { normal.under(load.normal)?.force() };
        let [Control::Force(x), Control::Force(y)] = load.tangential else { return None }; // or a prescribed shift
        Some(Loaded { normal, tangential: [x, y], ..Loaded::default() })
    };
    let history: Vec<Loaded> = loads.iter().map(loaded).collect::<Option<_>>()?;
    let size = |loaded: &Loaded| loaded.tangential[0].hypot(loaded.tangential[1]);
    let largest = history.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let direction = largest.tangential.map(|part| part / size(largest));
    let form = TangentialForm::of(plan, normal, (direction, &history), NOTHING)?;
    let start = (0..history.len()).find(|row| form.after(*row).is_some())?;
    if (start..history.len()).any(|row| form.after(row).is_none()) {
        return None;
    }
    let slip = form.after(history.len() - 1)?.clone();
    if slip.neglects_slip_across() && !normal.without_poisson {
        return None;
    }
    let mut said = ends.to_vec();
    for (row, (number, _)) in loads.iter().enumerate() {
        let (said, after) = (&mut said[*number], form.after(row));
        said.say(Quantity::StickArea, after.map(PartialSlip::stick_area));
        said.say_along(Quantity::Shift, direction, after.map_or(Some(0.0), PartialSlip::shift));
        said.say(Quantity::DissipatedEnergy, after.map_or(Some(0.0), PartialSlip::dissipated_energy));
    }
    ends.copy_from_slice(&said);
    Some((slip, direction))
}
