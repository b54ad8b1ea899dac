//! Constants by least squares: the loop of the solver laid through the measured points, by Levenberg and Marquardt's method (MINPACK's,
//! from the crate `levenberg-marquardt`).
//!
//! Noise sits in force and displacement: a point's residual is its distance from the loop in units of both, `s_q` and `s_d`, which is
//! `(Q - Q_l - slope (d - d_l))/sqrt(s_q^2 + (slope s_d)^2)` with the slope at the foot `(d_l, Q_l)` of the point on the loop. (At the
//! measured displacement in place of that of the foot, noise in the displacement shifts the constants: 2 % of the amplitude, 5 % of the
//! friction coefficient in partial slip.) Feet are those of the round before. The units are in the ratio of the noise that the
//! signals have from point to point, and as large as the amplitudes. Offsets of both and a drift of the displacement are fitted with the
//! constants, so that their uncertainty is in the intervals. These are linear about the solution (`intervals`); the error of the grid is not in them.
//!
//! A bend of the drift within the cycle changes the stiffness as much as itself, relative to the amplitude, and a loop hardly tells it.
//! It is that of the middles of the neighbouring cycles, where there are two; else it counts in the intervals with as much as the
//! noise hides and a quarter of the drift (an exponential approach with a time constant of half a cycle), or is fitted where the loop tells it.

use std::cell::RefCell;
use std::rc::Rc;

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::computed::Loop;
use super::cycles::MeasuredCycle;
use super::drift::Bend;
use super::error::{IdentifyError, refused};
use super::feet::{Feet, Points};
use super::intervals::{Left, Sureness, sureness};
use super::model::Model;
use super::start::first_guess;
use super::turns::{calm_range, noise};

/// Step of the differences by which derivatives by the constants are found, relative.
const STEP: f64 = 5e-3;
/// Distance of every point from a loop that cannot be solved, in amplitudes: more than from any other.
const UNSOLVED: f64 = 1e3;
/// Rounds in which the feet of the points on the loop follow the solution.
const ROUNDS: usize = 3;
/// Noise below this part of the amplitude does not count: what a loop is off is more.
const QUIET: f64 = 1e-3;
/// The noise of one signal over that of the other, relative to the amplitudes, at the most.
const UNEQUAL: f64 = 4.0;
/// Logarithms of friction, stiffness and amplitude do not go farther than this from their start: the friction of a loop that sticks is
/// bounded by nothing.
const FARTHEST: [f64; 3] = [4.0, 12.0, 12.0];
/// Constants without a bend of the drift and a key.
const ALWAYS: usize = 6;
/// A bend is fitted where it is more than so many of its standard deviations.
const BENDS: f64 = 3.0;

/// Points that lie farther off the loop than this part of the amplitudes, by the root of the mean square, are no noise of a measured one yet: it is begun
/// anew.
const FAR: f64 = 0.04;
/// Offsets below this part of the amplitudes are not begun with.
const SLIGHT: f64 = 1e-3;
/// Factors on the stiffness of the rig to begin with, where the first beginning leads nowhere. Of 30 logs with 32 and 60 rows in a cycle, a tenth of them
/// on the flanks, nine ended 16 % of the amplitudes and more off without them, and none with them.
const OTHER_STARTS: [f64; 4] = [0.3, 3.0, 0.05, 20.0];

/// The fit of the constants of a model to a cycle, with the bend of its drift where that is known.
///
/// # Errors
/// When the cycle is none of such a contact, or a loop cannot be solved.
pub fn fit<'a>(
    name: &str,
    cycle: &'a MeasuredCycle,
    model: &'a Model<'a>,
    bend: Option<Bend>,
) -> Result<Fit<'a>, IdentifyError> {
    let (start, first) = first_guess(name, cycle, model)?;
    let mut best = fit_from(name, (cycle, bend), model, (start, first));
    // Few points on a flank tell its slope badly, and with it where to begin.
    for factor in OTHER_STARTS {
        if best.as_ref().is_ok_and(|fit| fit.off() < FAR) {
            break;
        }
        let [friction, stiffness, amplitude] = start;
        let other = [friction, factor * stiffness, amplitude];
        let Ok(first) = model.loop_of(other[0], other[1], other[2], None) else { continue };
        let other = fit_from(name, (cycle, bend), model, (other, first));
        let is_better = match (&best, &other) {
            (Ok(best), Ok(other)) => other.off() < best.off(),
            (Err(_), Ok(_)) => true,
            _ => false,
        };
        if is_better {
            best = other;
        }
    }
    best
}

/// The fit from constants and their loop.
fn fit_from<'a>(
    name: &str,
    (cycle, bend): (&'a MeasuredCycle, Option<Bend>),
    model: &'a Model<'a>,
    (start, first): ([f64; 3], Loop),
) -> Result<Fit<'a>, IdentifyError> {
    let [low, high] = calm_range(&cycle.displacement);
    let [bottom, top] = calm_range(&cycle.force);
    let units = [0.5 * (high - low), 0.5 * (top - bottom)];
    let mut fit = Fit {
        cycle,
        model,
        units,
        start,
        value: model.key().map(|(_, value)| value),
        parameters: DVector::zeros(ALWAYS + usize::from(model.key().is_some())),
        bend: bend.map_or(0.0, |bend| bend.value / units[0]),
        bend_is_fitted: false,
        noises: noises(cycle, units),
        feet: Feet::default(),
        now: None,
        loops: RefCell::default(),
    };
    fit.now = fit.keep(&fit.parameters, Some(first));
    // The first step is bounded by the size of what it starts from, but for nothing: offsets that are rounding would forbid it.
    let of_note = |offset: f64| if offset.abs() < SLIGHT { 0.0 } else { offset };
    fit.parameters[3] = of_note(f64::midpoint(low, high) / fit.units[0]);
    fit.parameters[5] = of_note(f64::midpoint(bottom, top) / fit.units[1]);
    fit = fit.minimized(name)?;
    if bend.is_none() && fit.is_bent() {
        fit.bend_is_fitted = true;
        fit.parameters = fit.parameters.clone().push(0.0);
        fit = fit.minimized(name)?;
    }
    Ok(fit)
}

/// The problem of least squares. Parameters: logarithms of friction, stiffness and amplitude over those to start from; offset and drift of
/// the displacement and offset of the force over the amplitudes; logarithm of the value of a key; bend of the drift, where it is fitted.
pub struct Fit<'a> {
    pub cycle: &'a MeasuredCycle,
    pub model: &'a Model<'a>,
    /// Amplitudes of displacement and force.
    pub units: [f64; 2],
    start: [f64; 3],
    value: Option<f64>,
    pub parameters: DVector<f64>,
    /// Bend of the drift over the amplitude, where it is not fitted.
    bend: f64,
    pub bend_is_fitted: bool,
    /// Noise of displacement and force over their amplitudes, in their own unit: their squares are two.
    noises: [f64; 2],
    feet: Feet,
    /// The loop of the parameters.
    pub now: Option<Rc<Loop>>,
    /// The loops that were solved, by their constants; `None` where there is no solution. The rounds, and what is asked about the solution after
    /// them, meet the same ones again.
    loops: RefCell<Vec<(Constants, Option<Rc<Loop>>)>>,
}

/// Friction, stiffness of the rig and amplitude, and the value of the key.
type Constants = ([f64; 3], Option<f64>);

impl Fit<'_> {
    /// How far the points lie off the loop, over the amplitudes: root of the mean square.
    fn off(&self) -> f64 {
        self.residuals().map_or(f64::INFINITY, |off| (off.norm_squared() / off.len() as f64).sqrt())
    }

    fn minimized(mut self, name: &str) -> Result<Self, IdentifyError> {
        for round in 0..ROUNDS {
            self.find_feet(round);
            let (found, report) =
                LevenbergMarquardt::new().with_ftol(1e-8).with_xtol(1e-6).with_patience(8).minimize(self);
            self = found;
            let is_lost =
                matches!(report.termination, TerminationReason::User(_) | TerminationReason::Numerical(_));
            if self.now.is_none() || is_lost {
                let ([friction, stiffness, amplitude], _) = self.constants(&self.parameters);
                return Err(refused(
                    name,
                    &format!(
                        "no loop of the case comes near the measured one: the last one tried, with mu = {friction:.3e}, a rig stiffness of {stiffness:.3e} and an amplitude of {amplitude:.3e}, cannot be solved"
                    ),
                    "compare bodies, normal force and units of the case with those of the test",
                ));
            }
        }
        Ok(self)
    }

    /// The place of the bend of the drift among the parameters.
    fn place_of_bend(&self) -> Option<usize> {
        self.bend_is_fitted.then(|| self.parameters.len() - 1)
    }

    /// The bend of the drift over the amplitude.
    pub fn bend(&self) -> f64 {
        self.place_of_bend().map_or(self.bend, |place| self.parameters[place])
    }

    /// Whether a constant went as far as it may: the points do not bound it.
    pub fn is_unbounded(&self, constant: usize) -> bool {
        FARTHEST.get(constant).is_some_and(|farthest| self.parameters[constant].abs() >= *farthest)
    }

    /// The fit's own parameters that change the computed loop.
    fn of_loop(&self) -> impl Iterator<Item = usize> + use<> {
        (0..3).chain(self.value.is_some().then_some(ALWAYS))
    }

    /// Friction, stiffness of the rig and amplitude, and the value of the key.
    pub fn constants(&self, parameters: &DVector<f64>) -> Constants {
        let constants =
            [0, 1, 2].map(|k| self.start[k] * parameters[k].clamp(-FARTHEST[k], FARTHEST[k]).exp());
        (constants, self.value.map(|value| value * parameters[6].clamp(-3.0, 3.0).exp()))
    }

    fn solve(&self, parameters: &DVector<f64>) -> Option<Rc<Loop>> {
        let constants = self.constants(parameters);
        let known =
            self.loops.borrow().iter().find(|(known, _)| *known == constants).map(|(_, found)| found.clone());
        known.unwrap_or_else(|| {
            let ([friction, stiffness, amplitude], value) = constants;
            self.keep(parameters, self.model.loop_of(friction, stiffness, amplitude, value).ok())
        })
    }

    /// Keeps a loop that was solved.
    fn keep(&self, parameters: &DVector<f64>, found: Option<Loop>) -> Option<Rc<Loop>> {
        let found = found.map(Rc::new);
        self.loops.borrow_mut().push((self.constants(parameters), found.clone()));
        found
    }

    /// The points without offsets and drift.
    fn points(&self) -> Points {
        let count = self.cycle.force.len();
        let [offset, drift, bend] = [self.parameters[3], self.parameters[4], self.bend()];
        let place = |(row, displacement): (usize, &f64)| {
            let moved = offset + drift * time(row, count) + bend * bent(time(row, count));
            displacement - self.units[0] * moved
        };
        let level = self.units[1] * self.parameters[5];
        Points {
            places: self.cycle.displacement.iter().enumerate().map(place).collect(),
            forces: self.cycle.force.iter().map(|force| force - level).collect(),
        }
    }

    /// Noise of displacement and force, in one unit.
    fn noises(&self) -> [f64; 2] {
        [0, 1].map(|k| self.noises[k] * self.units[k])
    }

    /// The feet of the points on the loop; of the first round, at the measured displacements.
    fn find_feet(&mut self, round: usize) {
        if let Some(now) = &self.now {
            self.feet = Feet::on(now, &self.points(), self.cycle.turns, self.noises(), round > 0);
        }
    }

    fn distances(&self, of: &Loop) -> Vec<f64> {
        self.feet.distances(of, &self.points())
    }

    /// Part of every residual's variance that is of the force.
    fn of_force(&self) -> Vec<f64> {
        let force = self.noises()[1];
        self.feet.slopes().map(|[_, weight]| (force * weight).powi(2)).collect()
    }

    /// How sure the parameters are, with a bend of the drift of so much, relative to the amplitude, beside them.
    pub fn sureness(&self, bend: f64) -> Option<Sureness> {
        let (residuals, jacobian) = (self.residuals()?, self.jacobian()?);
        let count = residuals.len();
        let column = (0..count).map(|row| jacobian[(row, 3)] * bent(time(row, count)));
        let column = DVector::from_iterator(count, column);
        sureness(&Left {
            jacobian: &jacobian,
            residuals: &residuals,
            of_force: &self.of_force(),
            bend: (column, bend),
        })
    }

    /// Whether the points tell a bend of the drift: the step of Gauss and Newton with it.
    fn is_bent(&self) -> bool {
        let (Some(residuals), Some(jacobian)) = (self.residuals(), self.jacobian()) else { return false };
        let (count, constants) = jacobian.shape();
        let column = DVector::from_fn(count, |row, _| jacobian[(row, 3)] * bent(time(row, count)));
        let mut wider = jacobian.insert_column(constants, 0.0);
        wider.set_column(constants, &column);
        let nothing = DVector::zeros(count);
        let left = Left {
            jacobian: &wider,
            residuals: &residuals,
            of_force: &self.of_force(),
            bend: (nothing, 0.0),
        };
        let (Some(sure), Ok(step)) = (sureness(&left), wider.clone().svd(true, true).solve(&residuals, 1e-9))
        else {
            return false;
        };
        // Half-widths of 95 % are two standard deviations.
        step[constants].abs() > BENDS * 0.5 * sure.halves[constants]
    }
}

/// Noise of displacement and force over their amplitudes, as large as these together.
fn noises(cycle: &MeasuredCycle, units: [f64; 2]) -> [f64; 2] {
    let of = |values: &[f64], unit: f64| (noise(values, 0.0) / unit).hypot(QUIET);
    let [length, force] = [of(&cycle.displacement, units[0]), of(&cycle.force, units[1])];
    let ratio = (length / force).clamp(1.0 / UNEQUAL, UNEQUAL);
    let force = (2.0 / (1.0 + ratio * ratio)).sqrt();
    [ratio * force, force]
}

/// Time of a point in its cycle, from -1/2 to 1/2.
pub fn time(row: usize, count: usize) -> f64 {
    (row as f64 + 0.5) / count as f64 - 0.5
}

/// A bend of one, from the middle of the cycle to its ends, without its mean.
pub fn bent(time: f64) -> f64 {
    4.0 * time * time - 1.0 / 3.0
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Fit<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        let same = self.of_loop().all(|k| parameters[k] == self.parameters[k]);
        self.parameters.clone_from(parameters);
        if !same || self.now.is_none() {
            self.now = self.solve(parameters);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Some(now) = &self.now else {
            // Too long a step, to a contact that the grid does not hold, say: it is taken back.
            return Some(DVector::from_element(self.cycle.force.len(), UNSOLVED));
        };
        Some(DVector::from_vec(self.distances(now)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let now = self.now.as_ref()?;
        let here = self.distances(now);
        let count = here.len();
        let mut jacobian = DMatrix::zeros(count, self.parameters.len());
        for k in self.of_loop() {
            let beside = |step: f64| {
                let mut beside = self.parameters.clone();
                beside[k] += step;
                self.solve(&beside).map(|of| (step, self.distances(&of)))
            };
            let (step, there) = beside(STEP).or_else(|| beside(-STEP))?;
            for row in 0..count {
                jacobian[(row, k)] = (there[row] - here[row]) / step;
            }
        }
        let [length, force] = self.units;
        for (row, [slope, weight]) in self.feet.slopes().enumerate() {
            jacobian[(row, 3)] = slope * length * weight;
            jacobian[(row, 4)] = slope * length * weight * time(row, count);
            jacobian[(row, 5)] = -force * weight;
            if let Some(place) = self.place_of_bend() {
                jacobian[(row, place)] = slope * length * weight * bent(time(row, count));
            }
        }
        Some(jacobian)
    }
}
