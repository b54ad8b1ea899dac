//! The loop that the solver computes for a rig: the bodies of the case, pressed as it says, driven to and fro by the actuator.

use std::f64::consts::PI;

use fret_core::case::{Case, Course, GridSize, Output, Path, Stage, StageControl};
use fret_core::history::StepRecord;
use fret_core::model::{CoulombFriction, Rig};
use fret_core::plan::Plan;
use fret_core::run::{Silent, Simulation};
use toml::{Table, Value};

use super::computed::{Branch, Loop};
use crate::case_file::CaseFile;
use crate::failure::Failure;
use crate::sweep::key;

/// Increments from rest to the first turn, and from one turn to the next; closer to each other near the turns.
const FIRST: usize = 6;
const HALF: usize = 24;

/// What the loops are computed from.
pub struct Model {
    case_file: CaseFile,
    case: Case,
    /// A key of the case with its value there.
    key: Option<(String, f64)>,
}

impl Model {
    /// The model of a case: its stages up to the first tangential one.
    ///
    /// # Errors
    /// When the case is none of a single contact that is pressed, or has no such key.
    pub fn new(case_file: CaseFile, key: Option<&str>) -> Result<Self, Failure> {
        let key = match key {
            None => None,
            Some(key) => Some((key.to_owned(), value_of(&case_file, key)?)),
        };
        let mut model = Self { case: case_file.case(None)?, case_file, key };
        model.case = reduced(model.case)?;
        let plan = Plan::new(model.case.clone())?;
        let size = plan.grid.size();
        // The same cells for all values of the constants, so that nothing but these changes the loop.
        model.case.size = GridSize::Given(size);
        Ok(model)
    }

    /// The value that the case has for the key that is fitted.
    pub fn key(&self) -> Option<(&str, f64)> {
        self.key.as_ref().map(|(key, value)| (key.as_str(), *value))
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
    ) -> Result<Loop, Failure> {
        let mut case = self.case_with(friction, value)?;
        let compliance = 1.0 / stiffness;
        case.rig = Some(Rig { normal: case.springs().normal, tangential: [compliance; 2] });
        let pressing: usize = case.stages.iter().map(Stage::increments_in_all).sum();
        let mut path: Vec<f64> = (1..=FIRST).map(|k| amplitude * k as f64 / FIRST as f64).collect();
        let wave = |k: usize| (PI * k as f64 / HALF as f64).cos();
        path.extend((1..=HALF).map(|k| amplitude * wave(k)));
        path.extend((1..=HALF).map(|k| -amplitude * wave(k)));
        case.stages.push(driven(StageControl::FarEnd(Path::Through(path.clone())), path.len()));
        let plan = Plan::new(case)?;
        let history = Simulation::new(&plan).run(&mut Silent).map_err(Failure::Unsolved)?;
        let steps = &history.steps[pressing + FIRST - 1..];
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
            branches: [branch(1.0, &steps[..=HALF]), branch(-1.0, &steps[HALF..])],
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
    ) -> Result<Vec<f64>, Failure> {
        let mut case = self.case_with(friction, value)?;
        case.rig = Some(Rig { normal: case.springs().normal, tangential: [0.0; 2] });
        let pressing: usize = case.stages.iter().map(Stage::increments_in_all).sum();
        let mut slid = case.clone();
        let size = Plan::new(case.clone())?.grid.size();
        // As far as the contact is wide: it slides.
        slid.stages.push(driven(StageControl::Motion(Path::To(size[0])), 1));
        let solved = |case: Case| {
            let plan = Plan::new(case)?;
            Simulation::new(&plan).run(&mut Silent).map_err(Failure::Unsolved)
        };
        let limit = solved(slid)?.steps[pressing].tangential_force[0];
        let path = fractions.iter().map(|fraction| fraction * limit).collect();
        case.stages.push(driven(StageControl::Force(Path::Through(path)), fractions.len()));
        let history = solved(case)?;
        Ok(history.steps[pressing..].iter().map(|step| step.shift[0] / limit).collect())
    }

    /// The case with a coefficient of friction and a value of the key.
    fn case_with(&self, friction: f64, value: Option<f64>) -> Result<Case, Failure> {
        let mut case = match (&self.key, value) {
            (Some((key, _)), Some(value)) => {
                let text = with_value(&self.case_file, key, value)?;
                let mut changed = reduced(self.case_file_of(text).case(None)?)?;
                changed.size = self.case.size;
                changed
            }
            _ => self.case.clone(),
        };
        case.friction = CoulombFriction::uniform(friction)
            .map_err(|error| Failure::Call(format!("friction {error}"), String::new()))?
            .with_max_shear_of(&case.friction);
        Ok(case)
    }

    fn case_file_of(&self, text: String) -> CaseFile {
        let folder = self.case_file.beside.as_ref().map_or_else(
            || self.case_file.path.parent().unwrap_or_else(|| std::path::Path::new("")).to_owned(),
            |beside| beside.folder.clone(),
        );
        let contents =
            self.case_file.beside.as_ref().map(|beside| beside.contents.clone()).unwrap_or_default();
        CaseFile::of_text(&self.case_file.name(), text, crate::case_file::Beside { folder, contents })
    }
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
        increments,
        history_tolerance: None,
        course: Course::Linear,
        friction: None,
    }
}

/// The case up to its first tangential stage, without what a loop does not need.
fn reduced(mut case: Case) -> Result<Case, Failure> {
    let refuse = |what: &str, help: &str| Err(Failure::Call(format!("the case {what}"), help.to_owned()));
    if case.periodic {
        return refuse("is periodic: a rig presses one contact", "grid.periodic = false");
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

fn value_of(case_file: &CaseFile, key: &str) -> Result<f64, Failure> {
    let table: Table = case_file.text.parse().map_err(|_| unknown(key))?;
    let root = Value::Table(table);
    let found = key.split('.').try_fold(&root, |here, part| {
        part.parse::<usize>().map_or_else(|_| here.get(part), |index| here.get(index))
    });
    let value =
        found.and_then(|value| value.as_float().or_else(|| value.as_integer().map(|value| value as f64)));
    value.filter(|value| *value > 0.0).ok_or_else(|| unknown(key))
}

fn unknown(key: &str) -> Failure {
    Failure::Call(
        format!("--fit {key}: the case has no positive number there"),
        "a key such as lower.substrate.young or lower.coatings.0.thickness".to_owned(),
    )
}

fn with_value(case_file: &CaseFile, name: &str, value: f64) -> Result<String, Failure> {
    let mut table: Table = case_file.text.parse().map_err(|_| unknown(name))?;
    key::put(&mut table, name, &Value::Float(value)).map_err(|why| Failure::Call(why, String::new()))?;
    toml::to_string(&table).map_err(|error| Failure::Defect(error.to_string()))
}
