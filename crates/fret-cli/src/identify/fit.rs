//! Constants by least squares: the loop of the solver laid through the measured points, by Levenberg and Marquardt's method (MINPACK's,
//! from the crate `levenberg-marquardt`).
//!
//! Noise sits in force and displacement alike, each relative to its amplitude: a point's residual is its difference of force over
//! `sqrt(Q*^2 + (slope d*)^2)`. Offsets of both and a drift of the displacement are fitted with the constants, so that their
//! uncertainty is in the intervals. These are `t` quantiles times `sqrt(diagonal of s^2 (J^T J)^-1)`: linear about the solution,
//! for independent errors; the error of the grid is not in them.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use serde_json::{Value, json};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::cycles::{MeasuredCycle, calm_range};
use super::model::{Loop, Model};
use super::{TOLD, refused};
use crate::failure::Failure;

/// Step of the differences by which derivatives by the constants are found, relative.
const STEP: f64 = 5e-3;
/// Rounds in which the weights follow the solution.
const ROUNDS: usize = 2;
/// Forces over the normal force outside of which units are wrong.
const FORCES: [f64; 2] = [1e-3, 5.0];
/// A rig, or a displacement, that is so many times what it is compared with is of another unit.
const FAR: f64 = 300.0;

/// A fitted constant.
#[derive(Debug, Clone)]
pub struct Constant {
    pub name: String,
    /// In the words of [`fret_core::case::Units::of`].
    pub unit: &'static str,
    pub value: f64,
    /// 95 % interval.
    pub interval: [f64; 2],
    /// Whether the loop says anything of it.
    pub told: bool,
}

impl Constant {
    pub fn to_json(&self) -> Value {
        let [low, high] = self.interval;
        json!({"name": self.name, "unit": self.unit, "value": self.value, "low": low, "high": high, "told": self.told})
    }
}

/// The answer of a fit.
pub struct Fitted {
    pub constants: Vec<Constant>,
    pub normal_force: f64,
    /// Standard deviation of the points about the loop, relative to the amplitudes.
    pub noise: f64,
    /// Offset of the displacement, its drift from the first point to the last, offset of the force.
    pub removed: [f64; 3],
    pub contact_stiffness: f64,
    pub slides: bool,
    /// Displacement of the actuator, force and shift around the loop.
    pub computed: Vec<[f64; 3]>,
    pub notes: Vec<String>,
}

impl Fitted {
    /// Stiffness of the rig, where the loop tells it.
    pub fn stiffness(&self) -> Option<f64> {
        self.constants
            .iter()
            .find(|constant| constant.name == "rig stiffness" && constant.told)
            .map(|constant| constant.value)
    }
}

/// Fits the constants of a model to a cycle.
///
/// # Errors
/// When the cycle is none of such a contact, or a loop cannot be solved.
pub fn fit(name: &str, cycle: &MeasuredCycle, model: &Model) -> Result<Fitted, Failure> {
    let (start, first) = first_guess(name, cycle, model)?;
    let [low, high] = calm_range(&cycle.displacement);
    let [bottom, top] = calm_range(&cycle.force);
    let mut fit = Fit {
        cycle,
        model,
        units: [0.5 * (high - low), 0.5 * (top - bottom)],
        start,
        value: model.key().map(|(_, value)| value),
        parameters: DVector::zeros(6 + usize::from(model.key().is_some())),
        weights: Vec::new(),
        now: Some(first),
    };
    fit.parameters[3] = f64::midpoint(low, high) / fit.units[0];
    fit.parameters[5] = f64::midpoint(bottom, top) / fit.units[1];
    for _ in 0..ROUNDS {
        fit.weigh();
        let (found, report) =
            LevenbergMarquardt::new().with_ftol(1e-8).with_xtol(1e-6).with_patience(8).minimize(fit);
        fit = found;
        if fit.now.is_none() {
            return Err(refused(
                name,
                &format!("no loop of the case comes near the measured one ({:?})", report.termination),
                "compare bodies, normal force and units of the case with those of the test",
            ));
        }
    }
    fit.answer(name)
}

/// Friction, stiffness of the rig and amplitude to start from, with their loop; refuses units that cannot be.
fn first_guess(name: &str, cycle: &MeasuredCycle, model: &Model) -> Result<([f64; 3], Loop), Failure> {
    let [low, high] = calm_range(&cycle.displacement);
    let [bottom, top] = calm_range(&cycle.force);
    let (amplitude, force) = (0.5 * (high - low), 0.5 * (top - bottom));
    let slope = cycle.slope_after_reversal().unwrap_or(force / amplitude);
    let probe = model.loop_of(model.friction().unwrap_or(0.5), slope, amplitude, None)?;
    let ratio = force / probe.normal_force;
    if !(FORCES[0]..=FORCES[1]).contains(&ratio) {
        return Err(refused(
            name,
            &format!(
                "the tangential force has an amplitude of {force:.4e}, {ratio:.3e} times the normal force of {:.4e}: friction coefficients lie between 0.01 and 2",
                probe.normal_force
            ),
            "is the unit of the force right? --units \"force=mN\", or units in the case",
        ));
    }
    let own = probe.contact_stiffness;
    if slope > 5.0 * own {
        return Err(refused(
            name,
            &format!(
                "the loop rises by {slope:.4e} after reversal, {:.3e} times the stiffness of the contact itself, {own:.4e}: nothing in series with it can be stiffer",
                slope / own
            ),
            "is the unit of the displacement right? --units \"displacement=um\"; and are the moduli of the case in its units?",
        ));
    }
    if slope < own / FAR {
        return Err(refused(
            name,
            &format!(
                "the loop rises by {slope:.4e} after reversal, only {:.3e} times the stiffness of the contact itself, {own:.4e}: a rig that gives so much measures itself alone",
                slope / own
            ),
            "is the unit of the displacement right? --units \"displacement=um\"; and are the moduli of the case in its units?",
        ));
    }
    let series = 1.0 / slope - 1.0 / own;
    let stiffness = if series > 0.05 / own { 1.0 / series } else { 20.0 * own };
    let quantities = cycle.quantities(probe.normal_force, None);
    // In partial slip more than the force asks for; the less is dissipated, the more.
    let friction = quantities.plateau_friction.unwrap_or_else(|| {
        let width = quantities.dissipated_energy / (force * force / own);
        ratio * (0.25 / width.max(0.01)).clamp(1.15, 3.0)
    });
    let start = [friction, stiffness, amplitude];
    let first = model.loop_of(friction, stiffness, amplitude, None)?;
    Ok((start, first))
}

/// The problem of least squares. Parameters: logarithms of friction, stiffness and amplitude over those to start from; offset and drift of
/// the displacement and offset of the force over the amplitudes; logarithm of the value of a key.
struct Fit<'a> {
    cycle: &'a MeasuredCycle,
    model: &'a Model,
    /// Amplitudes of displacement and force.
    units: [f64; 2],
    start: [f64; 3],
    value: Option<f64>,
    parameters: DVector<f64>,
    weights: Vec<f64>,
    now: Option<Loop>,
}

impl Fit<'_> {
    fn constants(&self, parameters: &DVector<f64>) -> ([f64; 3], Option<f64>) {
        let constants = [0, 1, 2].map(|k| self.start[k] * parameters[k].clamp(-12.0, 12.0).exp());
        (constants, self.value.map(|value| value * parameters[6].clamp(-3.0, 3.0).exp()))
    }

    fn solve(&self, parameters: &DVector<f64>) -> Option<Loop> {
        let ([friction, stiffness, amplitude], value) = self.constants(parameters);
        self.model.loop_of(friction, stiffness, amplitude, value).ok()
    }

    /// Difference of force of every point, with the slope of the loop there.
    fn off(&self, of: &Loop) -> Vec<[f64; 2]> {
        let count = self.cycle.force.len();
        let [length, force] = self.units;
        let [offset, drift, level] = [3, 4, 5].map(|k| self.parameters[k]);
        (0..count)
            .map(|row| {
                let moved = length * (offset + drift * time(row, count));
                let [expected, slope] =
                    of.at(self.cycle.is_falling(row), self.cycle.displacement[row] - moved);
                [self.cycle.force[row] - force * level - expected, slope]
            })
            .collect()
    }

    fn weigh(&mut self) {
        let Some(now) = &self.now else { return };
        let [length, force] = self.units;
        self.weights =
            self.off(now).into_iter().map(|[_, slope]| 1.0 / force.hypot(slope * length)).collect();
    }

    fn weighted(&self, of: &Loop) -> Vec<f64> {
        self.off(of).into_iter().zip(&self.weights).map(|([off, _], weight)| off * weight).collect()
    }

    fn answer(self, name: &str) -> Result<Fitted, Failure> {
        let lost = || refused(name, "the loop cannot be fitted: its constants do not determine it", "");
        let residuals = self.residuals().ok_or_else(lost)?;
        let jacobian = self.jacobian().ok_or_else(lost)?;
        let freedom = residuals.len() as f64 - self.parameters.len() as f64;
        if !(freedom >= 1.0) {
            return Err(refused(name, "fewer points than constants", "a hundred points a cycle serve well"));
        }
        let variance = residuals.norm_squared() / freedom;
        let quantile = StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |law| law.inverse_cdf(0.975));
        let decomposition = jacobian.svd(false, true);
        let directions = decomposition.v_t.as_ref().ok_or_else(lost)?;
        let largest = decomposition.singular_values.max();
        let half = |k: usize| {
            let square: f64 = decomposition
                .singular_values
                .iter()
                .enumerate()
                .map(|(row, value)| (directions[(row, k)] / value.max(1e-9 * largest)).powi(2))
                .sum();
            quantile * (variance * square).sqrt()
        };
        let now = self.now.as_ref().ok_or_else(lost)?;
        let ([friction, stiffness, amplitude], value) = self.constants(&self.parameters);
        let constant = |name: &str, unit, value: f64, k: usize| {
            let half = half(k);
            Constant {
                name: name.to_owned(),
                unit,
                value,
                interval: [value * (-half).exp(), value * half.min(700.0).exp()],
                told: half < TOLD,
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
        let noise = variance.sqrt();
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
        let around = now.branches[0].iter().rev().chain(&now.branches[1]).copied().collect();
        Ok(Fitted {
            constants,
            normal_force: now.normal_force,
            noise,
            removed: [length * self.parameters[3], length * self.parameters[4], force * self.parameters[5]],
            contact_stiffness: now.contact_stiffness,
            slides: now.slides,
            computed: around,
            notes,
        })
    }
}

/// Time of a point in its cycle, from -1/2 to 1/2.
fn time(row: usize, count: usize) -> f64 {
    (row as f64 + 0.5) / count as f64 - 0.5
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Fit<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        let solver_alone = |parameters: &DVector<f64>| [0, 1, 2].map(|k| parameters[k]);
        let same = solver_alone(parameters) == solver_alone(&self.parameters)
            && (parameters.len() < 7 || parameters[6] == self.parameters[6]);
        self.parameters.clone_from(parameters);
        if !same || self.now.is_none() {
            self.now = self.solve(parameters);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(DVector::from_vec(self.weighted(self.now.as_ref()?)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let now = self.now.as_ref()?;
        let here = self.weighted(now);
        let count = here.len();
        let mut jacobian = DMatrix::zeros(count, self.parameters.len());
        for k in [0, 1, 2, 6] {
            if k >= self.parameters.len() {
                continue;
            }
            let mut beside = self.parameters.clone();
            beside[k] += STEP;
            let there = self.weighted(&self.solve(&beside)?);
            for row in 0..count {
                jacobian[(row, k)] = (there[row] - here[row]) / STEP;
            }
        }
        let [length, force] = self.units;
        for (row, [_, slope]) in self.off(now).into_iter().enumerate() {
            let weight = self.weights[row];
            jacobian[(row, 3)] = slope * length * weight;
            jacobian[(row, 4)] = slope * length * weight * time(row, count);
            jacobian[(row, 5)] = -force * weight;
        }
        Some(jacobian)
    }
}
