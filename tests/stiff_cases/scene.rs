//! One scene: a rigid sphere or wave, pressed and pulled, on a body under coatings; solved and judged.

use std::fmt::Write;

use fret_core::case::Case;
use fret_core::history::{History, StepRecord};
use fret_core::kernel::PairResponse;
use fret_core::plan::{LeaveOut, Plan, Simplification};
use fret_core::run::{RunError, Silent, Simulation};

use super::balance::Accounts;
use super::bodies::Stack;
use super::judgement::Judgement;
use super::{operator, twin};

/// Solver tolerance of all scenes.
pub const TOLERANCE: f64 = 1e-8;
/// Radius of the sphere in nominal contact radii.
const RADIUS: f64 = 100.0;

/// A scene; lengths in nominal contact radii, moduli in those of the plain substrate.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The numbers that make it what it is.
    pub label: String,
    /// The lower body.
    pub stack: Stack,
    /// Cells.
    pub cells: [usize; 2],
    /// Side lengths.
    pub size: [f64; 2],
    /// Contact radius, if nothing gave way but the sphere's shape.
    pub contact: f64,
    /// A wave that repeats instead of the sphere, pressed by so many times what flattens it on the substrate alone.
    pub wave: Option<f64>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Tangential force over what friction carries.
    pub pull: f64,
    /// Increments of pressing and of pulling.
    pub increments: [usize; 2],
    /// Factor on every length and on every modulus.
    pub units: [f64; 2],
}

/// How a scene ended.
#[derive(Debug, Clone)]
pub enum Outcome {
    /// Solved.
    Judged(Judgement),
    /// Not a case that can be computed, with the reason.
    Refused(String),
    /// Not solved.
    Failed(String),
}

impl Scene {
    /// The benign scene, on so many cells a side.
    pub fn benign(label: String, cells: usize) -> Self {
        Self {
            label,
            stack: Stack::plain(),
            cells: [cells; 2],
            size: [3.6; 2],
            contact: 1.0,
            wave: None,
            friction: 0.3,
            pull: 0.8,
            increments: [3, 4],
            units: [1.0; 2],
        }
    }

    /// The same scene on another body.
    pub fn on(self, stack: Stack) -> Self {
        Self { stack, ..self }
    }

    /// Solves it and judges what is found.
    pub fn judged(&self) -> Outcome {
        match self.pressing_force() {
            Ok(force) => self.pulled(force).unwrap_or_else(|ended| ended),
            Err(ended) => ended,
        }
    }

    /// The force that presses the sphere to its nominal contact, or the wave.
    fn pressing_force(&self) -> Result<f64, Outcome> {
        let [length, modulus] = self.units;
        if let Some(times) = self.wave {
            // Johnson, Greenwood and Higginson: full contact of cos cos waves at sqrt(2) pi E* amplitude / wavelength
            let [width, depth] = self.size;
            let substrate = self.stack.substrate.unwrap_or([1.0, 0.3]);
            let elastic = substrate[0] / (1.0 - substrate[1] * substrate[1]);
            let full = 2.0_f64.sqrt() * std::f64::consts::PI * elastic * self.amplitude() / width;
            return Ok(times * full * modulus * width * depth * length * length);
        }
        let approach = length * self.contact * self.contact / RADIUS;
        let text = format!("{}[[load]]\napproach = {approach:e}\nincrements = 1\n", self.head(0.0));
        let plan = planned(&text)?;
        let history =
            Simulation::new(&plan).run(&mut Silent).map_err(|error| failed("pressed alone: ", &error))?;
        Ok(history.steps.last().map_or(0.0, |step| step.normal_force))
    }

    fn pulled(&self, force: f64) -> Result<Outcome, Outcome> {
        let [press, pull] = self.increments;
        let along = self.pull * self.friction * force;
        let mut text = self.head(self.friction);
        let _ = write!(
            text,
            "[[load]]\nnormal_force = {force:e}\nincrements = {press}\n\
             [[load]]\ntangential_force = [{along:e}, 0.0]\nincrements = {pull}\n"
        );
        let plan = planned(&text)?;
        let whole = planned_leaving_out(&text, LeaveOut::all_but(Simplification::Mirror))?;
        let operator_failed = |error: fret_fft::ConvolutionError| Outcome::Failed(error.to_string());
        let failed = |error: RunError| failed("", &error);
        let mut accounts = Accounts::of(&plan).map_err(operator_failed)?;
        let history = Simulation::new(&plan).run(&mut accounts).map_err(failed)?;
        let mut accounts_of_whole = Accounts::of(&whole).map_err(operator_failed)?;
        let history_of_whole = Simulation::new(&whole).run(&mut accounts_of_whole).map_err(failed)?;
        let pair = &plan.case.bodies;
        let shown = operator::shown(pair, plan.grid.spacing(), plan.case.periodic.is_both())
            .map_err(operator_failed)?;
        let increments = history.steps.len().max(1);
        Ok(Outcome::Judged(Judgement {
            response: self.response_error(&PairResponse::new(pair)),
            asymmetry: shown.asymmetry,
            pivot: shown.pivot,
            residual: history.largest_residual(),
            balance: accounts.balance(),
            mirror: accounts_of_whole.mirror().max(apart(&history, &history_of_whole)),
            effort: history.work().convolutions as f64 / increments as f64,
        }))
    }

    /// Error of the frequency response on waves from far longer than the contact to far shorter ones.
    fn response_error(&self, response: &PairResponse) -> f64 {
        let [length, modulus] = self.units;
        let stack = self.stack.scaled(length, modulus);
        let waves = [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3];
        let errors = waves.into_iter().map(|wave| {
            let k = wave / (self.contact * length);
            twin::error(&stack, k, response.times_k(k))
        });
        errors.fold(0.0, f64::max)
    }

    fn amplitude(&self) -> f64 {
        self.size[0] / RADIUS
    }

    fn head(&self, friction: f64) -> String {
        let [length, modulus] = self.units;
        let [width, depth] = self.size.map(|side| side * length);
        let stack = self.stack.scaled(length, modulus).text();
        let profile = if self.wave.is_some() {
            let amplitude = self.amplitude() * length;
            format!(
                "[profile.wave]\namplitude = {amplitude:e}\nwavelength_x = {width:e}\nwavelength_y = {depth:e}\n"
            )
        } else {
            format!("[profile.sphere]\nradius = {:e}\n", RADIUS * length)
        };
        let [nx, ny] = self.cells;
        // By end points: only of that rule is the balance of energy an identity of the equations.
        format!(
            "[grid]\ncells = [{nx}, {ny}]\nsize = [{width:e}, {depth:e}]\nperiodic = {}\n[upper]\nrigid = true\n\
             [lower]\n{stack}{profile}[friction]\ncoefficient = {friction:e}\n\
             [solver]\nintegration = \"end_point\"\ntolerance = {TOLERANCE:e}\n[output]\nfields = [\"pressure\"]\n",
            self.wave.is_some()
        )
    }
}

/// Largest difference of two histories in largest pressure, approach and shift, relative to the largest of each run; as far as they
/// took the same steps: an increment that one of them solved in halves has another history of slip.
fn apart(one: &History, other: &History) -> f64 {
    let largest =
        |value: fn(&StepRecord) -> f64| one.steps.iter().map(|step| value(step).abs()).fold(0.0, f64::max);
    let [pressure, approach] = [largest(|step| step.max_pressure), largest(|step| step.approach)];
    let steps = one.steps.iter().zip(&other.steps).take_while(|(a, b)| a.parts == b.parts);
    steps.fold(0.0, |worst, (a, b)| {
        let motion = (a.approach - b.approach).abs().max((a.shift[0] - b.shift[0]).abs());
        worst.max((a.max_pressure - b.max_pressure).abs() / pressure).max(motion / approach)
    })
}

fn failed(when: &str, error: &RunError) -> Outcome {
    Outcome::Failed(format!("{when}{error}"))
}

fn planned(text: &str) -> Result<Plan, Outcome> {
    planned_leaving_out(text, LeaveOut::ALL)
}

fn planned_leaving_out(text: &str, leave_out: LeaveOut) -> Result<Plan, Outcome> {
    let refused = |error: fret_core::case::CaseError| {
        let said: Vec<&str> = error.mistakes().iter().map(|mistake| mistake.message.as_str()).collect();
        Outcome::Refused(said.join("; "))
    };
    Case::from_toml(text, "scene").and_then(|case| Plan::leaving_out(case, leave_out)).map_err(refused)
}
