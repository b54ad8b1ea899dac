//! The curve of load over depth that the solver computes for an indenter: the case, pressed to given depths, with its exact derivatives.

use super::super::error::IdentifyError;
use super::load_curve::Curve;
use super::request::Numbers;
use crate::case::{Case, Course, GridSize, Output, Path, Stage, StageControl};
use crate::history::Warning;
use crate::model::Shape;
use crate::model::stage::along_x;
use crate::plan::Plan;
use crate::run::{Silent, Simulation};
use crate::sensitivity::{Direction, Request, SensitivityError, gradient};

/// Depths at which the contact is solved, in equal factors from the smallest part of the largest one on. Below it the curve continues as a
/// power of the depth: with fewer cells in the contact the grid would be seen.
const DEPTHS: usize = 10;
const SMALLEST: f64 = 1.0 / 16.0;
/// Step of the difference by which a derivative is found that the equations do not give, relative.
const STEP: f64 = 5e-3;
/// Tables of a case whose numbers change the curve.
const TABLES: [&str; 3] = ["upper.", "lower.", "profile."];

/// What a fit asks of an indenter: its curve for values of the numbers, up to a depth.
pub trait Pressing: Clone {
    /// From now on curves reach so deep.
    ///
    /// # Errors
    /// When the case cannot be planned so.
    fn reach(&mut self, values: &[f64], deepest: f64) -> Result<(), IdentifyError>;

    /// The curve with its derivatives, and how many histories were solved for it.
    ///
    /// # Errors
    /// When it cannot be solved.
    fn pressed(&self, values: &[f64]) -> Result<(Curve, usize), IdentifyError>;

    /// Whether the case may have these values.
    fn allows(&self, values: &[f64]) -> bool;

    /// The curve on half of the cells along each side, without derivatives; `None` where there is none.
    fn coarser(&self, values: &[f64]) -> Option<Curve>;
}

/// What the curves are computed from.
#[derive(Clone)]
pub struct Indenter<'a> {
    numbers: &'a Numbers<'a>,
    depths: Vec<f64>,
    size: GridSize,
}

impl<'a> Indenter<'a> {
    /// Of a case, whose numbers are to be fitted.
    ///
    /// # Errors
    /// When it is none of a single contact that ends, or a number is none that the curve depends on.
    pub fn new(case: &Case, numbers: &'a Numbers<'a>) -> Result<Self, IdentifyError> {
        if case.hardness.is_some() {
            return Err(refusal("has a hardness: the curve is fitted with elastic surfaces", "leave it out"));
        }
        if !case.periodic.is_none() || case.is_line() {
            let what = "has no depth of its own: an indenter presses one contact that ends";
            return Err(refusal(what, "grid.cells = [nx, ny], without grid.periodic"));
        }
        for (name, _) in &numbers.keys {
            if !TABLES.iter().any(|table| name.starts_with(table)) {
                return Err(IdentifyError::Log {
                    what: format!("{name}: load over depth tells numbers of the bodies and of the profile"),
                    help: "such as lower.coatings[0].young, lower.coatings[0].thickness, lower.substrate.young, profile.sphere.radius".to_owned(),
                });
            }
        }
        if let Some((name, _)) = numbers.keys.iter().find(|(name, _)| ends_sharply(case, name)) {
            return Err(IdentifyError::Log {
                what: format!(
                    "{name}: the body ends sharply there, and the load changes with it in steps of whole cells, which cannot be fitted"
                ),
                help: "measure it, and fit what is pressed".to_owned(),
            });
        }
        Ok(Self { numbers, depths: Vec::new(), size: case.size })
    }

    /// What about the curve for these values may mislead.
    ///
    /// # Errors
    /// When it cannot be solved.
    pub fn warnings(&self, values: &[f64]) -> Result<Vec<Warning>, IdentifyError> {
        Ok(Simulation::new(&self.plan(values, 1)?).run(&mut Silent)?.warnings)
    }

    fn plan(&self, values: &[f64], coarser: usize) -> Result<Plan, IdentifyError> {
        let mut case = (self.numbers.case_with)(values)?;
        case.size = self.size;
        case.cells = case.cells.map(|cells| cells / coarser);
        self.press(&mut case);
        Ok(Plan::new(case)?)
    }

    /// One stage that presses the case to the depths, without what the curve does not need.
    fn press(&self, case: &mut Case) {
        case.stages = vec![Stage {
            name: "indentation".to_owned(),
            normal: Some(StageControl::Motion(Path::Through(self.depths.clone()))),
            tangential: [None, None],
            twist: None,
            tilt: [None, None],
            bulk_stress: [[None, None], [None, None]],
            roll: [None, None],
            steady: false,
            roll_direction: along_x(),
            increments: self.depths.len(),
            history_tolerance: None,
            divides_first_touch: false,
            course: Course::Linear,
            friction: None,
        }];
        // The fit knows of the frame by itself.
        case.rig = None;
        case.wear = None;
        case.friction_evolution = None;
        case.stress = None;
        case.output = Output { fields: Vec::new(), every: None };
    }

    fn loads(&self, values: &[f64], coarser: usize) -> Result<Vec<f64>, IdentifyError> {
        let history = Simulation::new(&self.plan(values, coarser)?).run(&mut Silent)?;
        Ok(history.steps.iter().map(|step| step.normal_force).collect())
    }

    fn points(&self, loads: &[f64]) -> Vec<[f64; 2]> {
        self.depths.iter().zip(loads).map(|(depth, load)| [*depth, *load]).collect()
    }

    /// Loads at the depths, and the derivatives of their logarithms by those of the numbers, through the equations of the increments; `None`
    /// where these do not give them.
    fn exact(&self, values: &[f64]) -> Result<Option<Pressed>, IdentifyError> {
        if values.is_empty() {
            return Ok(None);
        }
        let request = Request {
            of: (0..self.depths.len()).map(|k| format!("increments[{k}].normal_force")).collect(),
            by: self.numbers.keys.iter().map(|(name, _)| name.clone()).collect(),
            direction: Some(Direction::Forward),
        };
        let found = match gradient(&self.plan(values, 1)?, &request, &mut Silent) {
            Ok(found) => found,
            Err(SensitivityError::Run(error)) => return Err(IdentifyError::Unsolved(error)),
            Err(_) => return Ok(None),
        };
        let by = |k: usize| found.gradients.iter().map(|of| of.by[k] * values[k] / of.value).collect();
        let by = (0..values.len()).map(by).collect();
        Ok(Some(Pressed { loads: found.gradients.iter().map(|of| of.value).collect(), by, histories: 1 }))
    }

    /// The same by differences.
    fn by_differences(&self, values: &[f64]) -> Result<Pressed, IdentifyError> {
        let loads = self.loads(values, 1)?;
        let by = |k: usize| {
            let beside = |step: f64| {
                let mut beside = values.to_vec();
                beside[k] *= step.exp();
                Ok((step, self.loads(&beside, 1)?))
            };
            let (step, there) = beside(STEP).or_else(|_: IdentifyError| beside(-STEP))?;
            Ok(loads.iter().zip(there).map(|(load, there)| (there / load).ln() / step).collect())
        };
        let by = (0..values.len()).map(by).collect::<Result<_, IdentifyError>>()?;
        Ok(Pressed { loads, by, histories: 1 + values.len() })
    }
}

/// Loads at the depths, derivatives of their logarithms by those of each number, and how many histories were solved.
struct Pressed {
    loads: Vec<f64>,
    by: Vec<Vec<f64>>,
    histories: usize,
}

impl Pressing for Indenter<'_> {
    fn reach(&mut self, values: &[f64], deepest: f64) -> Result<(), IdentifyError> {
        self.depths =
            (0..DEPTHS).map(|k| deepest * SMALLEST.powf(1.0 - k as f64 / (DEPTHS - 1) as f64)).collect();
        let case = (self.numbers.case_with)(values)?;
        self.size = case.size;
        // The same cells for all values, so that nothing but these changes the curve.
        self.size = GridSize::Given(self.plan(values, 1)?.grid.size());
        Ok(())
    }

    fn pressed(&self, values: &[f64]) -> Result<(Curve, usize), IdentifyError> {
        let found = match self.exact(values)? {
            Some(found) => found,
            None => self.by_differences(values)?,
        };
        let curve = Curve::through(&self.points(&found.loads), &found.by).ok_or_else(|| {
            refusal(
                "does not touch at the measured depths",
                "compare profile and units with the test; with few cells the contact may lie between them: grid.cells larger, grid.size = \"auto\"",
            )
        })?;
        Ok((curve, found.histories))
    }

    fn allows(&self, values: &[f64]) -> bool {
        (self.numbers.case_with)(values).is_ok()
    }

    fn coarser(&self, values: &[f64]) -> Option<Curve> {
        Curve::through(&self.points(&self.loads(values, 2).ok()?), &[])
    }
}

/// Whether a number says where a profile ends, without body beyond.
fn ends_sharply(case: &Case, name: &str) -> bool {
    let has = |of: fn(&Shape) -> bool| case.profile.shapes.iter().any(of);
    let ends = |name: &str| match name {
        "flat_punch.radius" | "cylinder.length" | "crowned_roller.length" => true,
        "rectangular_punch.length_x" | "rectangular_punch.length_y" => {
            has(|shape| matches!(shape, Shape::RectangularPunch { edge_radius: None, .. }))
        }
        _ => false,
    };
    name.split_once("profile.").is_some_and(|(_, name)| ends(name))
}

fn refusal(what: &str, help: &str) -> IdentifyError {
    IdentifyError::Log { what: format!("the case {what}"), help: help.to_owned() }
}
