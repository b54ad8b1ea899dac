//! The loop that the solver computes for a rig: the bodies of the case, pressed as it says, driven to and fro by the actuator.

use std::f64::consts::PI;

use super::computed::{Branch, Loop};
use super::error::IdentifyError;
use super::request::Key;
use crate::case::{Case, Course, GridSize, Output, Path, Stage, StageControl};
use crate::history::StepRecord;
use crate::model::stage::along_x;
use crate::model::{CoulombFriction, Rig};
use crate::plan::Plan;
use crate::run::{Silent, Simulation};

/// Increments from rest to the first turn, and from one turn to the next; closer to each other near the turns.
const INCREMENTS: [usize; 2] = [6, 24];
/// The same of coarse loops.
const FEW_INCREMENTS: [usize; 2] = [3, 12];
/// Cells of coarse loops along each side, at the least.
const FEW_CELLS: usize = 16;

/// What the loops are computed from.
pub struct Model<'a> {
    case: Case,
    key: Option<Key<'a>>,
    increments: [usize; 2],
    coarse: Option<Box<Model<'a>>>,
}

impl<'a> Model<'a> {
    /// The model of a case: its stages up to the first tangential one.
    ///
    /// # Errors
    /// When the case is none of a single contact that is pressed.
    pub fn new(case: Case, key: Option<Key<'a>>) -> Result<Self, IdentifyError> {
        let mut case = reduced(case)?;
        // The same cells for all values of the constants, so that nothing but these changes the loop.
        case.size = GridSize::Given(Plan::new(case.clone())?.grid.size());
        let mut coarse = case.clone();
        if !has_fields(&case) {
            coarse.cells = case.cells.map(|cells| (cells / 2).max(FEW_CELLS).min(cells));
        }
        let of = |case| Self { case, key, increments: INCREMENTS, coarse: None };
        Ok(of(case).with_coarse(of(coarse)))
    }

    /// The model with the coarse loops of another one.
    pub fn with_coarse(self, coarse: Self) -> Self {
        let coarse = Self { increments: FEW_INCREMENTS, coarse: None, ..coarse };
        Self { coarse: Some(Box::new(coarse)), ..self }
    }

    /// The same in fewer increments and, where nothing belongs to single cells, on fewer of these, at about a tenth of the price: what loops differ by, not what they are.
    pub fn coarse(&self) -> &Self {
        self.coarse.as_deref().unwrap_or(self)
    }

    /// The value that the case has for the key that is fitted.
    pub fn key(&self) -> Option<(&str, f64)> {
        self.key.map(|key| (key.name, key.value))
    }

    /// Friction of the case, where it is one number.
    pub fn friction(&self) -> Option<f64> {
        (!self.case.friction.is_map())
            .then(|| self.case.friction.largest())
            .filter(|friction| *friction > 0.0)
    }

    /// The loop for a coefficient of friction, a tangential stiffness of the rig, an amplitude of the actuator and a value of the key.
    ///
    /// # Errors
    /// When it cannot be solved.
    pub fn loop_of(
        &self,
        friction: f64,
        stiffness: f64,
        amplitude: f64,
        value: Option<f64>,
    ) -> Result<Loop, IdentifyError> {
        let mut case = self.case_with(friction, value)?;
        let compliance = 1.0 / stiffness;
        case.rig = Some(Rig { normal: case.springs().normal, tangential: [compliance; 2] });
        let pressing: usize = case.stages.iter().map(Stage::increments_in_all).sum();
        let [first, half] = self.increments;
        let mut path: Vec<f64> = (1..=first).map(|k| amplitude * k as f64 / first as f64).collect();
        let wave = |k: usize| (PI * k as f64 / half as f64).cos();
        path.extend((1..=half).map(|k| amplitude * wave(k)));
        path.extend((1..=half).map(|k| -amplitude * wave(k)));
        case.stages.push(driven(StageControl::FarEnd(Path::Through(path.clone())), path.len()));
        let plan = Plan::new(case)?;
        let history = Simulation::new(&plan).run(&mut Silent)?;
        let steps = &history.steps[pressing + first - 1..];
        let is_line = plan.grid.cells().contains(&1);
        let branch = |sign: f64, steps: &[StepRecord]| {
            let point = |step: &StepRecord| {
                [step.actuator[0], step.tangential_force[0], step.shift[0]].map(|value| sign * value)
            };
            let sticks: Vec<bool> = steps.iter().map(|step| step.stick_cells > 0).collect();
            Branch::new(steps.iter().map(point).collect(), &sticks, compliance, is_line)
        };
        let [turn, next] = [&steps[0], &steps[1]];
        let contact_stiffness =
            (turn.tangential_force[0] - next.tangential_force[0]) / (turn.shift[0] - next.shift[0]);
        Ok(Loop {
            normal_force: steps[0].normal_force,
            branches: [branch(1.0, &steps[..=half]), branch(-1.0, &steps[half..])],
            contact_stiffness,
            slides: steps.iter().any(|step| step.stick_cells == 0),
            slips: steps.iter().any(|step| step.stick_cells < step.contact_cells),
        })
    }

    /// First tangential displacement over the friction force [length/force], at so many fractions of that force.
    ///
    /// # Errors
    /// When it cannot be solved.
    pub fn first_loading(
        &self,
        friction: f64,
        fractions: &[f64],
        value: Option<f64>,
    ) -> Result<Vec<f64>, IdentifyError> {
        let mut case = self.case_with(friction, value)?;
        case.rig = Some(Rig { normal: case.springs().normal, tangential: [0.0; 2] });
        let pressing: usize = case.stages.iter().map(Stage::increments_in_all).sum();
        let mut slid = case.clone();
        let size = Plan::new(case.clone())?.grid.size();
        // As far as the contact is wide: it slides.
        slid.stages.push(driven(StageControl::Motion(Path::To(size[0])), 1));
        let solved = |case: Case| {
            let plan = Plan::new(case)?;
            Simulation::new(&plan).run(&mut Silent).map_err(IdentifyError::Unsolved)
        };
        let limit = solved(slid)?.steps[pressing].tangential_force[0];
        let path = fractions.iter().map(|fraction| fraction * limit).collect();
        case.stages.push(driven(StageControl::Force(Path::Through(path)), fractions.len()));
        let history = solved(case)?;
        Ok(history.steps[pressing..].iter().map(|step| step.shift[0] / limit).collect())
    }

    /// The case with a coefficient of friction and a value of the key.
    fn case_with(&self, friction: f64, value: Option<f64>) -> Result<Case, IdentifyError> {
        let mut case = match (self.key, value) {
            (Some(key), Some(value)) => {
                let mut changed = reduced((key.case_with)(value)?)?;
                (changed.size, changed.cells) = (self.case.size, self.case.cells);
                changed
            }
            _ => self.case.clone(),
        };
        case.friction = CoulombFriction::uniform(friction)
            .map_err(|error| IdentifyError::Log { what: format!("friction {error}"), help: String::new() })?
            .with_max_shear_of(&case.friction);
        Ok(case)
    }
}

/// Whether heights or maps belong to the cells of a case.
fn has_fields(case: &Case) -> bool {
    let mut frictions = case.stages.iter().filter_map(|stage| stage.friction.as_ref());
    !case.profile.heights.is_empty() || case.friction.is_map() || frictions.any(CoulombFriction::is_map)
}

/// A stage that is driven along x.
fn driven(control: StageControl, increments: usize) -> Stage {
    Stage {
        name: "loop".to_owned(),
        normal: None,
        tangential: [Some(control), None],
        twist: None,
        tilt: [None, None],
        bulk_stress: [[None, None], [None, None]],
        roll: [None, None],
        steady: false,
        roll_direction: along_x(),
        increments,
        history_tolerance: None,
        divides_first_touch: false,
        course: Course::Linear,
        friction: None,
    }
}

/// The case up to its first tangential stage, without what a loop does not need.
fn reduced(mut case: Case) -> Result<Case, IdentifyError> {
    let refuse = |what: &str, help: &str| {
        Err(IdentifyError::Log { what: format!("the case {what}"), help: help.to_owned() })
    };
    if !case.periodic.is_none() {
        return refuse("is periodic: a rig presses one contact", "grid.periodic = false");
    }
    if case.hardness.is_some() {
        return refuse("has a hardness: the loop is fitted with elastic surfaces", "leave it out");
    }
    let stages: Vec<Stage> = case.stages.iter().take_while(|stage| !stage.is_tangential()).cloned().collect();
    if stages.is_empty() {
        return refuse(
            "has no stage that presses the bodies before it loads them tangentially",
            "[[load]] normal_force = ..., increments = ...; the loop itself comes from the log",
        );
    }
    case.stages = stages;
    case.wear = None;
    case.friction_evolution = None;
    case.stress = None;
    case.output = Output { fields: Vec::new(), every: None };
    Ok(case)
}
