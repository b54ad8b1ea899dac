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

use super::error::{IdentifyError, refused};
use super::indenter::Pressing;
use super::intervals::{Left, Sureness, sureness};
use super::load_curve::{Curve, Seen};
use super::turns::{noise, range};

/// Parts of the largest load by whose depths a first guess of the touch is made, as of a sphere: load as the depth to the power of 1.5.
const GUESS: [f64; 2] = [0.1, 0.6];
/// Curves reach so far beyond the deepest contact.
const BEYOND: f64 = 1.15;
/// Noise below this part of the range does not count: what a curve is off is more.
const QUIET: f64 = 1e-4;
/// The noise of one signal over that of the other, relative to the ranges, at the most.
const UNEQUAL: f64 = 4.0;
/// Rounds, in which the feet of the points follow the solution, at the most; in the first of them the grid follows, too.
const ROUNDS: usize = 12;
const ROUNDS_OF_GRIDS: usize = 2;
/// Rounds end when no parameter moves more than this part of its half-width, or this much by itself.
const STANDS: f64 = 5e-3;
const STANDS_BY_ITSELF: f64 = 1e-7;
/// Steps to the foot of a point.
const STEPS_TO_FOOT: usize = 4;
/// Residual of every point beside a curve that cannot be solved: more than any other.
const UNSOLVED: f64 = 1e6;
/// The logarithm of a number does not go farther than this from its start.
pub const FARTHEST: f64 = 7.0;
/// Singular values below this are nothing.
const NOTHING: f64 = 1e-9;
/// A frame pushes back at the most this much of the depth: what a fit may try on its way.
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
}

/// The problem of least squares. Parameters: logarithms of the values over those to start from; where they are fitted, the depth at which the
/// indenter touches less that to start from, over the range of depths, and the compliance of the frame times the range of loads over that of depths.
pub struct Fit<'a, P> {
    pub indenter: P,
    start: Vec<f64>,
    pub depths: &'a [f64],
    pub loads: &'a [f64],
    known: Known,
    touch: f64,
    /// Ranges of depth and load.
    pub units: [f64; 2],
    /// Noise of both, as large as the ranges together.
    noises: [f64; 2],
    feet: Vec<Foot>,
    pub parameters: DVector<f64>,
    /// The curve of the parameters.
    pub now: Option<Curve>,
    /// How many histories were solved.
    pub histories: usize,
    /// Whether the rounds ended because nothing moved any more.
    pub stands: bool,
}

/// The foot of a point on the curve.
#[derive(Debug, Clone, Copy)]
struct Foot {
    /// Depth of the contact there, without that of the frame [length].
    depth: f64,
    /// Slope of the curve as the instrument shows it [force/length].
    slope: f64,
    /// One over the noise of a distance in direction of the load.
    weight: f64,
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
    let numbers = start.len();
    let mut fit = Fit {
        indenter,
        start: start.to_vec(),
        depths,
        loads,
        known,
        touch: known.touch.unwrap_or_else(|| first_touch(depths, loads)),
        units,
        noises: noises([depths, loads], units),
        feet: Vec::new(),
        parameters: DVector::zeros(
            numbers + usize::from(known.touch.is_none()) + usize::from(known.fits_frame),
        ),
        now: None,
        histories: 0,
        stands: false,
    };
    if let Some(place) = fit.place_of_frame() {
        fit.parameters[place] = known.frame * units[1] / units[0];
    }
    for round in 0..ROUNDS {
        if round < ROUNDS_OF_GRIDS {
            let deepest = fit.deepest();
            if !(deepest > 0.0) {
                let what =
                    format!("no depth is larger than {:.6e}, at which the indenter touches", fit.touch());
                return Err(refused(
                    name,
                    &what,
                    "is the depth at first touch right, and in the unit of the case?",
                ));
            }
            let values = fit.values();
            fit.indenter.reach(&values, BEYOND * deepest)?;
            let (curve, histories) = fit.indenter.pressed(&values)?;
            (fit.now, fit.histories) = (Some(curve), fit.histories + histories);
        }
        let before = fit.parameters.clone();
        fit = fit.minimized(name)?;
        let sure = fit.sureness();
        let stands = |k: usize| {
            let moved = (fit.parameters[k] - before[k]).abs();
            moved < STANDS_BY_ITSELF || sure.as_ref().is_some_and(|sure| moved < STANDS * sure.halves[k])
        };
        fit.stands = (0..before.len()).all(stands);
        if round >= ROUNDS_OF_GRIDS && fit.stands {
            break;
        }
    }
    Ok(fit)
}

/// Where the indenter touches, for a start.
fn first_touch(depths: &[f64], loads: &[f64]) -> f64 {
    let [_, most] = range(loads);
    let [low, high] = GUESS.map(|part| {
        let mut rows: Vec<usize> = (0..loads.len()).collect();
        rows.sort_by(|one, other| {
            let off = |row: usize| (loads[row] - part * most).abs();
            off(*one).total_cmp(&off(*other))
        });
        rows.truncate((loads.len() / 20).max(1));
        rows.iter().map(|row| depths[*row]).sum::<f64>() / rows.len() as f64
    });
    let ratio = (GUESS[0] / GUESS[1]).powf(2.0 / 3.0);
    (low - ratio * high) / (1.0 - ratio)
}

/// Noise of depth and load, as large as the ranges together.
fn noises([depths, loads]: [&[f64]; 2], units: [f64; 2]) -> [f64; 2] {
    let of = |values: &[f64], unit: f64| (noise(values, 0.0) / unit).hypot(QUIET);
    let [length, force] = [of(depths, units[0]), of(loads, units[1])];
    let ratio = (length / force).clamp(1.0 / UNEQUAL, UNEQUAL);
    let force = (2.0 / (1.0 + ratio * ratio)).sqrt();
    [ratio * force * units[0], force * units[1]]
}

impl<P: Pressing> Fit<'_, P> {
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

    /// The depth at which the indenter touches.
    pub fn touch(&self) -> f64 {
        self.touch + self.place_of_touch().map_or(0.0, |place| self.parameters[place] * self.units[0])
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

    /// The deepest contact, without the part of the frame.
    fn deepest(&self) -> f64 {
        let own = |(depth, load): (&f64, &f64)| depth - self.touch() - self.frame() * load.max(0.0);
        self.depths.iter().zip(self.loads).map(own).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The feet of the points on the curve as it is.
    fn find_feet(&mut self) {
        let Some(now) = &self.now else { return };
        let ([length, force], touch, frame) = (self.noises, self.touch(), self.frame());
        let foot = |(depth, load): (&f64, &f64)| {
            let measured = depth - touch;
            let mut seen = now.seen(measured, frame);
            for _ in 0..STEPS_TO_FOOT {
                let at = seen.depth + frame * seen.load;
                let off = load - seen.load - seen.slope * (measured - at);
                let step = seen.slope * off / ((force / length).powi(2) + seen.slope * seen.slope);
                seen = now.seen(measured + step, frame);
            }
            Foot { depth: seen.depth, slope: seen.slope, weight: 1.0 / force.hypot(seen.slope * length) }
        };
        self.feet = self.depths.iter().zip(self.loads).map(foot).collect();
    }

    /// Weighted distances of the points.
    fn distances(&self, curve: &Curve) -> Vec<f64> {
        let (touch, frame) = (self.touch(), self.frame());
        let points = self.depths.iter().zip(self.loads).zip(&self.feet);
        points
            .map(|((depth, load), foot)| {
                let [expected, _] = curve.at(foot.depth);
                let along = depth - touch - foot.depth - frame * expected;
                foot.weight * (load - expected - foot.slope * along)
            })
            .collect()
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

    /// How sure the parameters are.
    pub fn sureness(&self) -> Option<Sureness> {
        let (residuals, jacobian) = (self.residuals()?, self.jacobian()?);
        let of_force: Vec<f64> =
            self.feet.iter().map(|foot| (foot.weight * self.noises[1]).powi(2)).collect();
        let nothing = DVector::zeros(residuals.len());
        sureness(&Left {
            jacobian: &jacobian,
            residuals: &residuals,
            of_force: &of_force,
            bend: (nothing, 0.0),
        })
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
        let now = self.now.as_ref()?;
        let frame = self.frame();
        let mut jacobian = DMatrix::zeros(self.loads.len(), self.parameters.len());
        for (row, foot) in self.feet.iter().enumerate() {
            for number in 0..self.start.len() {
                let change = now.by(number, foot.depth);
                jacobian[(row, number)] = -foot.weight * change * (1.0 - foot.slope * frame);
            }
            if let Some(place) = self.place_of_touch() {
                jacobian[(row, place)] = foot.weight * foot.slope * self.units[0];
            }
            if let Some(place) = self.place_of_frame() {
                let [load, _] = now.at(foot.depth);
                jacobian[(row, place)] = foot.weight * foot.slope * load * self.units[0] / self.units[1];
            }
        }
        Some(jacobian)
    }
}
