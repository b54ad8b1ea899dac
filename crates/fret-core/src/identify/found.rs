//! What a fit found: the constants with their intervals, what was removed from the log, what the loop cannot tell.

use levenberg_marquardt::LeastSquaresProblem;

use super::cycles::MeasuredCycle;
use super::drift::Bend;
use super::error::{IdentifyError, refused};
use super::fit::{Fit, fit};
use super::intervals::Sureness;
use super::model::Model;

/// An interval wider than this on either side, relative, tells nothing of its constant.
pub const TOLD: f64 = 0.5;
/// A loop whose points lie farther off than this part of the amplitudes is another one.
const NEAR: f64 = 0.5;
/// Part of a straight drift that a bend may have: an exponential approach with a time constant of half a cycle.
const BENT: f64 = 0.25;
/// An interval is said to be wider from this factor on.
const WIDER: f64 = 1.2;

/// A fitted constant.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// What it is called.
    pub name: String,
    /// Its unit, in the words of [`crate::units::Units::of`].
    pub unit: &'static str,
    /// Its value, in the units of the case.
    pub value: f64,
    /// 95 % interval, linear about the solution; the discretisation error is not in it.
    pub interval: [f64; 2],
    /// Whether the loop determines it. Where it does not, value and interval mean nothing.
    pub told: bool,
}

/// The answer of a fit to a cycle, with the bend of its drift where neighbouring cycles tell it.
///
/// # Errors
/// When the cycle is none of such a contact, or a loop cannot be solved.
pub fn fitted(
    name: &str,
    cycle: &MeasuredCycle,
    model: &Model<'_>,
    bend: Option<Bend>,
) -> Result<Fitted, IdentifyError> {
    let fit = fit(name, cycle, model, bend)?;
    let unsure = bend.map(|bend| bend.unsure / fit.units[0]);
    fit.answer(name, unsure)
}

/// The answer of a fit.
pub struct Fitted {
    pub constants: Vec<Constant>,
    pub normal_force: f64,
    /// Standard deviation of the points about the loop, relative to the amplitudes.
    pub noise: f64,
    /// Offset of the displacement, its drift from the first point to the last, the bend of the drift, offset of the force.
    pub removed: [f64; 4],
    pub contact_stiffness: f64,
    pub slides: bool,
    /// Displacement of the actuator, force and shift around the loop.
    pub computed: Vec<[f64; 3]>,
    pub notes: Vec<String>,
    /// Correlation of the noise of neighbouring points, where there is more than chance.
    pub correlation: f64,
    /// Value of the key.
    pub value_of_key: Option<f64>,
}

impl Fitted {
    /// Stiffness of the rig, where the loop tells it.
    pub fn stiffness(&self) -> Option<f64> {
        self.told("rig stiffness")
    }

    /// Coefficient of friction, where the loop tells it.
    pub fn friction(&self) -> Option<f64> {
        self.told("friction coefficient")
    }

    fn told(&self, name: &str) -> Option<f64> {
        self.constants
            .iter()
            .find(|constant| constant.name == name && constant.told)
            .map(|constant| constant.value)
    }
}

impl Fit<'_> {
    /// The answer; `bend` is the standard deviation of that of the drift, relative to the amplitude, where neighbouring cycles tell it.
    pub fn answer(self, name: &str, bend: Option<f64>) -> Result<Fitted, IdentifyError> {
        let lost = || refused(name, "the loop cannot be fitted: its constants do not determine it", "");
        let residuals = self.residuals().ok_or_else(lost)?;
        let freedom = residuals.len() as f64 - self.parameters.len() as f64;
        if !(freedom >= 1.0) {
            return Err(refused(name, "fewer points than constants", "a hundred points a cycle serve well"));
        }
        let noise = (residuals.norm_squared() / freedom).sqrt();
        let is_alone = bend.is_none() && !self.bend_is_fitted;
        let bend =
            bend.unwrap_or_else(|| if is_alone { noise.hypot(BENT * self.parameters[4]) } else { 0.0 });
        let sure = self.sureness(bend).ok_or_else(lost)?;
        let half = |k: usize| sure.halves[k];
        let now = self.exact.as_ref().ok_or_else(lost)?;
        let ([friction, stiffness, amplitude], value) = self.constants(&self.parameters);
        let constant = |name: &str, unit, value: f64, k: usize| {
            let half = half(k);
            Constant {
                name: name.to_owned(),
                unit,
                value,
                interval: [value * (-half).exp(), value * half.min(300.0).exp()],
                told: half < TOLD && noise < NEAR && !self.is_unbounded(k),
            }
        };
        let mut constants = vec![
            constant("friction coefficient", "", friction, 0),
            constant("rig stiffness", "force/length", stiffness, 1),
            constant("actuator amplitude", "length", amplitude, 2),
        ];
        if let (Some(value), Some((key, _))) = (value, self.model.key()) {
            constants.push(constant(key, "", value, 6));
        }
        let [length, force] = self.units;
        let mut notes = Vec::new();
        let reached = force / now.normal_force;
        // A loop that sticks is a line, whose ends a noisy one does not tell; friction is told by what is missing from it at its ends.
        if !now.slips || !constants[0].told || !constants[2].told {
            constants[0].told = false;
            notes.push(format!(
                "the contact sticks in this loop: it tells the rig, not friction; mu is more than {reached:.3}"
            ));
        }
        if !constants[1].told {
            notes.push(
                "the flanks of this loop do not tell the rig: it may be much stiffer than the contact, or there are too few points on them; a loop in partial slip tells it".to_owned(),
            );
        }
        if now.slides && constants[0].told {
            notes.push("the plateaus determine the friction coefficient; the flanks, the stiffness of rig and contact in series".to_owned());
        }
        if let (Some(last), true) = (constants.get(3), self.model.key().is_some())
            && !last.told
        {
            notes.push(format!(
                "{}: the loop does not tell it beside the rig; fix one of the two by another measurement",
                last.name
            ));
        }
        let names: Vec<&str> = constants.iter().map(|constant| constant.name.as_str()).collect();
        notes.extend(self.notes_of_sureness(&sure, is_alone, &names));
        if noise > 0.05 {
            notes.push(format!(
                "the points lie {:.0} % of the amplitudes off the loop: more than noise; the case describes another contact, or the loop is not a steady one",
                100.0 * noise
            ));
        }
        if let Some(measured) = self.cycle.normal_force
            && (measured / now.normal_force - 1.0).abs() > 0.05
        {
            notes.push(format!(
                "the measured normal force is {measured:.4e}, that of the case {:.4e}: friction is that of the case",
                now.normal_force
            ));
        }
        Ok(Fitted {
            constants,
            normal_force: now.normal_force,
            noise,
            removed: [
                length * self.parameters[3],
                length * self.parameters[4],
                length * self.bend(),
                force * self.parameters[5],
            ],
            contact_stiffness: now.contact_stiffness,
            slides: now.slides,
            computed: now.around(),
            notes,
            correlation: sure.correlation,
            value_of_key: value,
        })
    }

    /// What makes the intervals wider than those of independent points about a straight drift.
    fn notes_of_sureness(&self, sure: &Sureness, is_alone: bool, names: &[&str]) -> Vec<String> {
        let mut notes = Vec::new();
        if sure.correlation > 0.0 {
            let points = self.cycle.force.len() as f64;
            let independent = (points * (1.0 - sure.correlation) / (1.0 + sure.correlation)).max(1.0);
            notes.push(format!(
                "neighbouring points are correlated ({:.2}), as those of a filtered signal are, or the computed loop has another shape: the intervals are those of {independent:.0} independent point{} in place of {points}",
                sure.correlation,
                if independent < 1.5 { "" } else { "s" }
            ));
        }
        if self.bend_is_fitted {
            notes.push(format!(
                "the drift of the displacement bends within the cycle by {:.2e}: fitted with the constants",
                self.units[0] * self.bend()
            ));
        }
        let wider = |k: usize| sure.halves[k] > WIDER * sure.halves_of_straight[k];
        if let (true, true) = (is_alone, sure.halves[1] < TOLD && wider(1)) {
            notes.push(format!(
                "one loop does not tell whether the drift of the displacement bends: the interval of the {} is {:.1} times as wide for it; two more cycles beside it in the log would tell",
                names[1],
                sure.halves[1] / sure.halves_of_straight[1]
            ));
        }
        notes
    }
}
