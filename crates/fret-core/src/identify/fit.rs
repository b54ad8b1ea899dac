//! Constants by least squares: the loop of the solver laid through the measured points, by Levenberg and Marquardt's method (MINPACK's,
//! from the crate `levenberg-marquardt`).
//!
//! Noise sits in force and displacement: a point's residual is its distance from the loop in units of both, `s_q` and `s_d`, which is
//! `(Q - Q_l - slope (d - d_l))/sqrt(s_q^2 + (slope s_d)^2)` with the slope at the foot `(d_l, Q_l)` of the point on the loop. (At the
//! measured displacement in place of that of the foot, noise in the displacement shifts the constants: 2 % of the amplitude, 5 % of the
//! friction coefficient in partial slip.) Feet are those of the round before. Within a round a loop is taken for the coarse one of the same constants
//! and what this lacks where the round begins (`loops`): what is least in the end is the distance from an exact loop, by derivatives of coarse
//! ones. The units are in the ratio of the noise that the signals have from point to point, and as large as the amplitudes. Offsets of both and a
//! drift of the displacement are fitted with the constants, so that their uncertainty is in the intervals. These are linear about the solution (`intervals`); the error of the grid is not in them.
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
use super::loops::{Constants, Loops};
use super::model::Model;
use super::start::first_guess;
use super::turns::{calm_range, noise};

/// Step of the differences by which derivatives by the constants are found, relative, and how near constants are whose derivatives serve as well.
const STEP: f64 = 0.02;
/// Distance of every point from a loop that cannot be solved, in amplitudes: more than from any other.
const UNSOLVED: f64 = 1e3;
/// Rounds in which the feet of the points and what coarse loops lack follow the solution, at the most; and with exact loops alone.
const ROUNDS: [usize; 2] = [8, 3];
/// The last round moves the loop by less than this, in parts of what the points are off it and of the amplitudes: root of the mean square.
const SETTLED: [f64; 2] = [3e-3, 1e-5];
/// Coarse loops are given up where they lack more than this part of the amplitudes, by the root of the mean square, where a round moves the loop by
/// more than the other part of what the one before did, or where one of them cannot be solved.
const UNLIKE: f64 = 0.05;
const NEARER: f64 = 0.5;
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
        exact: None,
        coarse: None,
        lack: DVector::zeros(cycle.force.len()),
        loops: Loops::new(model, ((start, model.key().map(|(_, value)| value)), first)),
        beside: RefCell::default(),
    };
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
    /// The loop of the parameters where a round begins, and at last of the solution.
    pub exact: Option<Rc<Loop>>,
    /// The coarse loop of the parameters, or the exact one in its place.
    coarse: Option<Rc<Loop>>,
    /// Distances of the points from the exact loop less those from the coarse one, where a round begins.
    lack: DVector<f64>,
    loops: Loops<'a>,
    beside: RefCell<Option<Rc<Beside>>>,
}

/// The coarse loop of some parameters, and with one of those changed by a step each.
struct Beside {
    parameters: DVector<f64>,
    of: Rc<Loop>,
    changed: Vec<(f64, Rc<Loop>)>,
}

impl Fit<'_> {
    /// How far the points lie off the loop, over the amplitudes: root of the mean square.
    fn off(&self) -> f64 {
        self.residuals().map_or(f64::INFINITY, |off| (off.norm_squared() / off.len() as f64).sqrt())
    }

    /// The solution: by steps of coarse loops, or, where these lead to none, by those of exact ones from the start.
    fn minimized(self, name: &str) -> Result<Self, IdentifyError> {
        let start = self.parameters.clone();
        let (mut fit, mut is_settled) = self.in_rounds();
        if is_settled != Some(true) && !fit.loops.are_exact() {
            fit.give_up_coarse_loops();
            fit.parameters = start;
            (fit, is_settled) = fit.in_rounds();
        }
        if is_settled.is_none() {
            return Err(fit.lost(name));
        }
        Ok(fit)
    }

    /// Rounds until the loop moves no more, and whether that is so; `None` where a loop cannot be solved.
    fn in_rounds(mut self) -> (Self, Option<bool>) {
        let mut last = f64::INFINITY;
        let mut is_settled = false;
        for round in 0..ROUNDS[usize::from(self.loops.are_exact())] {
            let Some(before) = self.begun(round > 0) else { return (self, None) };
            let (found, report) =
                LevenbergMarquardt::new().with_ftol(1e-6).with_xtol(1e-4).with_patience(8).minimize(self);
            self = found;
            let is_lost =
                matches!(report.termination, TerminationReason::User(_) | TerminationReason::Numerical(_));
            let after = self.residuals().filter(|_| self.coarse.is_some() && !is_lost);
            let Some(after) = after else { return (self, None) };
            let moved = (&after - before).norm();
            let [of_distance, of_amplitude] = SETTLED;
            let much = (of_distance * after.norm()).hypot(of_amplitude * (after.len() as f64).sqrt());
            is_settled = round > 0 && moved < much;
            if is_settled || !self.loops.are_exact() && round > 1 && moved > NEARER * last {
                break;
            }
            last = moved;
        }
        let is_like = self.compared().map(|_| self.loops.lead());
        (self, is_like.map(|is_like| is_like && is_settled))
    }

    /// Where a round begins: the exact loop of the parameters, the feet of the points on it, nearest or at the measured displacements, and what the
    /// coarse loop lacks. The points' distances.
    fn begun(&mut self, near: bool) -> Option<DVector<f64>> {
        self.exact = self.loops.exact(self.constants(&self.parameters));
        self.feet = Feet::on(self.exact.as_ref()?, &self.points(), self.cycle.turns, self.noises(), near);
        self.compared()
    }

    /// The points' distances from the exact loop of the parameters, and what the coarse one lacks; `None` also where that is too much.
    fn compared(&mut self) -> Option<DVector<f64>> {
        let constants = self.constants(&self.parameters);
        self.exact = self.loops.exact(constants);
        self.coarse = self.loops.coarse(constants);
        let points = self.points();
        let [off, of_coarse] = [self.exact.as_ref()?, self.coarse.as_ref()?]
            .map(|of| DVector::from(self.feet.distances(of, &points)));
        self.lack = &off - of_coarse;
        (self.lack.norm() < UNLIKE * (off.len() as f64).sqrt()).then_some(off)
    }

    fn give_up_coarse_loops(&mut self) {
        self.loops.give_up_coarse();
        self.beside.take();
    }

    fn lost(&self, name: &str) -> IdentifyError {
        let ([friction, stiffness, amplitude], _) = self.constants(&self.parameters);
        refused(
            name,
            &format!(
                "no loop of the case comes near the measured one: the last one tried, with mu = {friction:.3e}, a rig stiffness of {stiffness:.3e} and an amplitude of {amplitude:.3e}, cannot be solved"
            ),
            "compare bodies, normal force and units of the case with those of the test",
        )
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

    /// Coarse loops of parameters near to those of now and beside these.
    fn loops_beside(&self) -> Option<Rc<Beside>> {
        let is_near = |beside: &&Rc<Beside>| {
            self.of_loop().all(|k| (beside.parameters[k] - self.parameters[k]).abs() < STEP)
        };
        if let Some(known) = self.beside.borrow().as_ref().filter(is_near) {
            return Some(Rc::clone(known));
        }
        let changed = |k: usize, step: f64| {
            let mut changed = self.parameters.clone();
            changed[k] += step;
            Some((step, self.loops.coarse(self.constants(&changed))?))
        };
        let found = Rc::new(Beside {
            parameters: self.parameters.clone(),
            of: Rc::clone(self.coarse.as_ref()?),
            changed: self
                .of_loop()
                .map(|k| changed(k, STEP).or_else(|| changed(k, -STEP)))
                .collect::<Option<_>>()?,
        });
        self.beside.replace(Some(Rc::clone(&found)));
        Some(found)
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

    /// Distances of the points from the loop that a coarse one stands for.
    fn distances(&self, of: &Loop) -> DVector<f64> {
        DVector::from(self.feet.distances(of, &self.points())) + &self.lack
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
        if !same || self.coarse.is_none() {
            self.coarse = self.loops.coarse(self.constants(parameters));
        }
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Some(now) = &self.coarse else {
            // Too long a step, to a contact that the grid does not hold, say: it is taken back.
            return Some(DVector::from_element(self.cycle.force.len(), UNSOLVED));
        };
        Some(self.distances(now))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let count = self.cycle.force.len();
        let mut jacobian = DMatrix::zeros(count, self.parameters.len());
        let beside = self.loops_beside()?;
        let from = self.distances(&beside.of);
        for (k, (step, of)) in self.of_loop().zip(&beside.changed) {
            let to = self.distances(of);
            for row in 0..count {
                jacobian[(row, k)] = (to[row] - from[row]) / step;
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
