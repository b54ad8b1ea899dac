//! The fit to an indentation: the curve of the solver laid through the measured points, by Levenberg and Marquardt's method (MINPACK's, from the
//! crate `levenberg-marquardt`).
//!
//! Parameters are the logarithms of the numbers of the case, the depth at which the indenter touches and the compliance of the instrument's frame.
//! Noise sits in load and depth: a point's residual is its distance from the curve in units of both,
//! `(P - P_c - slope (h - h_c))/sqrt(s_P^2 + (slope s_h)^2)` with the slope at the foot `(h_c, P_c)` of the point on the curve. Feet are those of
//! the round before. (At the measured depth in place of that of the foot, noise in the depth makes the modulus smaller by its square.) The units
//! are in the ratio of the noise that the signals have from row to row. Derivatives by the numbers come with each solved curve; those by touch
//! and frame are slopes of it, and cost nothing.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::super::error::{IdentifyError, refused};
use super::super::turns::range;
use super::indenter::Pressing;
use super::load_curve::{Curve, Foot, Seen};
use super::start::{SPHERE, first_touch, noises};

/// The touch does not go farther than this from its guess, over the range of depths.
pub const FARTHEST_TOUCH: f64 = 3.0;
/// Curves reach so far beyond the deepest contact.
const BEYOND: f64 = 1.15;
/// Rounds, in which the feet of the points follow the solution, at the most. The grid follows in the first of them, and where the numbers or the
/// deepest contact have moved by more than `SAME_GRID`, relative, since it was made.
const ROUNDS: usize = 14;
const ROUNDS_OF_GRIDS: [usize; 2] = [2, 8];
const SAME_GRID: f64 = 0.02;
/// Rounds end when no parameter moves more than this part of its half-width, or this much by itself.
const STANDS: f64 = 5e-3;
const STANDS_BY_ITSELF: f64 = 1e-7;
/// Residual of every point beside a curve that cannot be solved: more than any other.
const UNSOLVED: f64 = 1e6;
/// The logarithm of a number does not go farther than this from its start.
pub const FARTHEST: f64 = 7.0;
/// A number whose value may not be larger or smaller by this part is at the end of what it may be.
const AT_END: f64 = 5e-3;
/// Singular values below this are nothing.
const NOTHING: f64 = 1e-9;
/// A frame pushes back at the most this much of the depth: what a fit may try on its way. One that ends below zero is held at zero.
const PUSHES: f64 = -0.3;

/// What is known besides the numbers of the case.
#[derive(Debug, Clone, Copy)]
pub struct Known {
    /// The depth at which the indenter touches \[length\]; `None`: fitted.
    pub touch: Option<f64>,
    /// Compliance of the frame [length/force]: known, or where its fit starts.
    pub frame: f64,
    /// Whether it is fitted.
    pub fits_frame: bool,
    /// Of the depths here over those of the log: -1 where the log counts them the other way.
    pub sign: f64,
}

/// The problem of least squares. Parameters: logarithms of the values over those to start from; where they are fitted, the depth at which the
/// indenter touches less that to start from, over the range of depths, and the compliance of the frame times the range of loads over that of depths.
#[derive(Clone)]
pub struct Fit<'a, P> {
    pub indenter: P,
    pub start: Vec<f64>,
    pub depths: &'a [f64],
    pub loads: &'a [f64],
    known: Known,
    touch: f64,
    /// Ranges of depth and load.
    pub units: [f64; 2],
    /// Noise of both, as large as the ranges together.
    pub noises: [f64; 2],
    pub feet: Vec<Foot>,
    pub parameters: DVector<f64>,
    /// Parameters that are held where they are.
    pub held: Vec<bool>,
    /// What the grid was made for.
    grid: MadeFor,
    /// The curve of the parameters.
    pub now: Option<Curve>,
    /// How many histories were solved.
    pub histories: usize,
    /// Whether the rounds ended because nothing moved any more.
    pub stands: bool,
    /// Whether the grid had to follow the numbers to the last.
    pub grid_moves: bool,
}

/// The fit of numbers, from their values on, to depths and loads.
///
/// # Errors
/// When the first curve cannot be solved, or none comes near.
pub fn fit<'a, P: Pressing>(
    name: &str,
    indenter: P,
    start: &[f64],
    [depths, loads]: [&'a [f64]; 2],
    known: Known,
) -> Result<Fit<'a, P>, IdentifyError> {
    let units = [range(depths), range(loads)].map(|[low, high]| high - low);
    let parameters = start.len() + usize::from(known.touch.is_none()) + usize::from(known.fits_frame);
    let mut fit = Fit {
        indenter,
        start: start.to_vec(),
        depths,
        loads,
        known,
        touch: known.touch.unwrap_or_else(|| first_touch([depths, loads], known.frame, SPHERE)),
        units,
        noises: noises([depths, loads], units),
        feet: Vec::new(),
        parameters: DVector::zeros(parameters),
        held: vec![false; parameters],
        grid: None,
        now: None,
        histories: 0,
        stands: false,
        grid_moves: false,
    };
    if let Some(place) = fit.place_of_frame() {
        fit.parameters[place] = known.frame * units[1] / units[0];
        fit.held[place] = true;
    }
    fit = fit.scaled(name)?;
    // A first round without the frame: it would make up for a touch that is only guessed.
    fit = fit.rounds(name, if known.fits_frame { 1 } else { ROUNDS })?;
    if let Some(place) = fit.place_of_frame() {
        fit.held[place] = false;
        fit = fit.rounds(name, ROUNDS)?;
        if fit.parameters[place] < 0.0 {
            fit.parameters[place] = 0.0;
            fit.held[place] = true;
            fit.now = None;
            fit = fit.rounds(name, ROUNDS)?;
        }
    }
    Ok(fit)
}

/// What a grid was made for: logarithms of the numbers, and the deepest contact.
type MadeFor = Option<(Vec<f64>, f64)>;

impl<P: Pressing> Fit<'_, P> {
    /// Rounds until nothing moves any more, or so many.
    fn rounds(mut self, name: &str, most: usize) -> Result<Self, IdentifyError> {
        let mut grids = 0;
        for round in 0..most {
            let is_early = (1..ROUNDS_OF_GRIDS[0]).contains(&round);
            let follows = is_early || self.now.is_none() || self.has_left_grid();
            if follows && grids < ROUNDS_OF_GRIDS[1] {
                self.solve_on_new_grid(name)?;
                grids += 1;
            }
            let before = self.parameters.clone();
            self = self.minimized(name)?;
            let sure = self.sureness(false);
            let stands = |k: usize| {
                let moved = (self.parameters[k] - before[k]).abs();
                moved < STANDS_BY_ITSELF || sure.as_ref().is_some_and(|sure| moved < STANDS * sure.halves[k])
            };
            self.stands = (0..before.len()).all(stands);
            self.grid_moves = self.has_left_grid();
            if round >= ROUNDS_OF_GRIDS[0] && self.stands && !self.grid_moves {
                break;
            }
        }
        Ok(self)
    }

    /// The same with a parameter held at a value: two rounds, on the grid that there is where the contact is the same.
    pub fn held_at(mut self, name: &str, place: usize, value: f64) -> Result<Self, IdentifyError> {
        let mut parameters = self.parameters.clone();
        parameters[place] = value;
        self.held[place] = true;
        self.set_params(&parameters);
        for _ in 0..2 {
            if self.now.is_none() || self.has_left_grid() {
                self.solve_on_new_grid(name)?;
            }
            self = self.minimized(name)?;
        }
        Ok(self)
    }

    /// Whether the contact is another one than that for which the grid was made.
    fn has_left_grid(&self) -> bool {
        let Some((parameters, deepest)) = &self.grid else { return true };
        let apart = |(k, before): (usize, &f64)| (self.parameters[k] - before).abs() > SAME_GRID;
        parameters.iter().enumerate().any(apart) || (self.deepest() / deepest).ln().abs() > SAME_GRID
    }

    /// The curve of the parameters, on a grid made for them.
    pub fn solve_on_new_grid(&mut self, name: &str) -> Result<(), IdentifyError> {
        let deepest = self.deepest();
        if !(deepest > 0.0) {
            return Err(self.without_depth(name));
        }
        let values = self.values();
        self.indenter.reach(&values, BEYOND * deepest)?;
        let (curve, histories) = self.indenter.pressed(&values)?;
        if self.grid.is_none() && self.known.touch.is_none() {
            // The power is that of the case's own curve.
            let [load, slope] = curve.at(0.5 * deepest);
            self.touch = first_touch([self.depths, self.loads], self.frame(), slope * 0.5 * deepest / load);
        }
        (self.now, self.histories) = (Some(curve), self.histories + histories);
        self.grid = Some((self.parameters.as_slice()[..self.start.len()].to_vec(), deepest));
        Ok(())
    }

    /// That no point is deeper than the touch.
    fn without_depth(&self, name: &str) -> IdentifyError {
        let touch = self.known.sign * self.touch();
        let most = self.depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if most > self.touch() {
            let what = format!(
                "the frame, of a compliance of {:.6e}, gives more than the depths of the log from {touch:.6e} on",
                self.frame()
            );
            return refused(name, &what, "is rig.normal_stiffness right, and in the units of the case?");
        }
        let what = format!("no point lies deeper than {touch:.6e}, at which the indenter touches");
        let help = if self.known.touch.is_some() {
            "is the depth at first touch right, and in the unit of the case?"
        } else {
            "the fit came to that depth by itself: compare bodies, profile and units of the case with those of the test, or name the depth with --touch DEPTH"
        };
        refused(name, &what, help)
    }

    /// The solution with the feet as they are.
    fn minimized(mut self, name: &str) -> Result<Self, IdentifyError> {
        self.find_feet();
        let (fit, report) =
            LevenbergMarquardt::new().with_ftol(1e-10).with_xtol(1e-9).with_patience(8).minimize(self);
        if fit.now.is_none() || matches!(report.termination, TerminationReason::User(_)) {
            let values: Vec<String> = fit.values().iter().map(|value| format!("{value:.3e}")).collect();
            let what = format!(
                "no curve of the case comes near the measured one: the last one tried, with {}, cannot be solved",
                values.join(", ")
            );
            let help = "compare bodies, profile and units of the case with those of the test";
            return Err(refused(name, &what, help));
        }
        Ok(fit)
    }

    /// The values of the numbers of the case.
    pub fn values(&self) -> Vec<f64> {
        let value = |(k, start): (usize, &f64)| start * self.parameters[k].clamp(-FARTHEST, FARTHEST).exp();
        self.start.iter().enumerate().map(value).collect()
    }

    /// The place of the touch among the parameters.
    pub fn place_of_touch(&self) -> Option<usize> {
        self.known.touch.is_none().then_some(self.start.len())
    }

    /// The place of the frame among the parameters.
    pub fn place_of_frame(&self) -> Option<usize> {
        self.known.fits_frame.then(|| self.parameters.len() - 1)
    }

    /// Whether a parameter went as far as it may.
    pub fn is_bound(&self, place: usize) -> bool {
        if self.place_of_frame() == Some(place) {
            return self.held[place];
        }
        let farthest = if self.place_of_touch() == Some(place) { FARTHEST_TOUCH } else { FARTHEST };
        self.parameters[place].abs() >= farthest || self.ends(place)
    }

    /// Whether a number of the case is at the end of what it may be there, as a Poisson's ratio of 1/2.
    pub fn ends(&self, place: usize) -> bool {
        place < self.start.len()
            && [-AT_END, AT_END].iter().any(|step| {
                let mut values = self.values();
                values[place] *= step.exp();
                !self.indenter.allows(&values)
            })
    }

    /// The depth at which the indenter touches, counted as pressing.
    pub fn touch(&self) -> f64 {
        let farthest = FARTHEST_TOUCH;
        self.touch
            + self
                .place_of_touch()
                .map_or(0.0, |place| self.parameters[place].clamp(-farthest, farthest) * self.units[0])
    }

    /// Compliance of the frame [length/force].
    pub fn frame(&self) -> f64 {
        self.place_of_frame().map_or(self.known.frame, |place| {
            self.parameters[place].max(PUSHES) * self.units[0] / self.units[1]
        })
    }

    /// What the instrument would show at a measured depth; `None` without a curve.
    pub fn seen(&self, depth: f64) -> Option<Seen> {
        Some(self.now.as_ref()?.seen(depth - self.touch(), self.frame()))
    }

    /// Depths of the contact itself, by the measured loads.
    pub fn own_depths(&self) -> impl Iterator<Item = f64> {
        let own = |(depth, load): (&f64, &f64)| depth - self.touch() - self.frame() * load.max(0.0);
        self.depths.iter().zip(self.loads).map(own)
    }

    /// The deepest contact, without the part of the frame.
    fn deepest(&self) -> f64 {
        self.own_depths().fold(f64::NEG_INFINITY, f64::max)
    }

    /// By how much the parameters differ on half of the cells along each side, to first order; `None` where that is not solved.
    pub fn coarser(&mut self) -> Option<DVector<f64>> {
        let coarser = self.indenter.coarser(&self.values())?;
        self.histories += 1;
        let now = self.now.as_ref()?;
        let apart = |(there, here): (f64, f64)| here - there;
        let moved = self.distances(&coarser).into_iter().zip(self.distances(now)).map(apart).collect();
        self.jacobian()?.svd(true, true).solve(&DVector::from_vec(moved), NOTHING).ok()
    }

    /// Derivatives of the residuals by the parameters; those of the others are nothing.
    pub fn derivatives(&self, of: impl Fn(usize) -> bool) -> Option<DMatrix<f64>> {
        let now = self.now.as_ref()?;
        let frame = self.frame();
        let mut jacobian = DMatrix::zeros(self.loads.len(), self.parameters.len());
        for (row, foot) in self.feet.iter().enumerate() {
            for number in (0..self.start.len()).filter(|number| of(*number)) {
                let change = now.by(number, foot.depth);
                jacobian[(row, number)] = -foot.weight * change * (1.0 - foot.slope * frame);
            }
            if let Some(place) = self.place_of_touch().filter(|place| of(*place)) {
                jacobian[(row, place)] = foot.weight * foot.slope * self.units[0];
            }
            if let Some(place) = self.place_of_frame().filter(|place| of(*place)) {
                let [load, _] = now.at(foot.depth);
                jacobian[(row, place)] = foot.weight * foot.slope * load * self.units[0] / self.units[1];
            }
        }
        Some(jacobian)
    }
}

impl<P: Pressing> LeastSquaresProblem<f64, Dyn, Dyn> for Fit<'_, P> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        let same = (0..self.start.len()).all(|k| parameters[k] == self.parameters[k]);
        self.parameters.clone_from(parameters);
        if !same || self.now.is_none() {
            let found = self.indenter.pressed(&self.values()).ok();
            self.histories += found.as_ref().map_or(1, |(_, histories)| *histories);
            self.now = found.map(|(curve, _)| curve);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let Some(now) = &self.now else {
            // Too long a step, to a contact that the grid does not hold, say: it is taken back.
            return Some(DVector::from_element(self.loads.len(), UNSOLVED));
        };
        Some(DVector::from_vec(self.distances(now)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.derivatives(|place| !self.held[place])
    }
}
