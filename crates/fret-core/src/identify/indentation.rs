//! A modulus or a thickness from a measured indentation: load over depth, laid by least squares through the curve of the solver.
//!
//! One number of the case is fitted, and the depth at which the indenter touches, which no instrument knows. A point's residual is the
//! difference of loads over `sqrt(s_P^2 + (s_d dP/dd)^2)`, the noise of load and depth that the columns show from row to row. Intervals
//! are those of `intervals`: linear about the solution, with noise of both kinds and the correlation of neighbours; the error of the grid is not in them.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::error::{IdentifyError, refused};
use super::found::{Constant, TOLD};
use super::intervals::{Left, Sureness, sureness};
use super::pressing::{Curve, Indenter};
use super::request::{Key, Request};
use super::turns::{noise, range};
use crate::case::{Case, Units};
use crate::measured::{Kind, Role, Table, read, scales};

/// Depth of the indenter, and load, among the roles.
const DEPTH: usize = 0;
const LOAD: usize = 1;

/// What the columns of an indentation can hold.
static ROLES: [Role; 2] = [
    Role {
        name: "depth",
        known: &["depth", "displacement", "indentation", "penetration", "h", "tiefe", "eindringtiefe", "weg"],
        is_needed: true,
        kind: Kind::Length,
        example: "depth",
    },
    Role {
        name: "force",
        known: &[
            "force",
            "load",
            "normal_force",
            "p",
            "f",
            "fn",
            "kraft",
            "last",
            "normalkraft",
            "prüfkraft",
        ],
        is_needed: true,
        kind: Kind::Force,
        example: "load",
    },
];

/// Rows, at the least.
const FEWEST_ROWS: usize = 12;
/// The indenter touches about where the load passes this part of the largest one.
const TOUCHES: f64 = 0.02;
/// Curves go so far beyond the largest depth from there.
const BEYOND: f64 = 1.15;
/// Noise below this part of the range does not count: what a curve is off is more.
const QUIET: f64 = 1e-4;
/// The noise of one signal over that of the other, relative to the ranges, at the most.
const UNEQUAL: f64 = 4.0;
/// Rounds in which the weights of the points follow the solution.
const ROUNDS: usize = 3;
/// Step of the difference by which the derivative by the value is found, relative.
const STEP: f64 = 5e-3;
/// Residual of every point beside a curve that cannot be solved: more than any other.
const UNSOLVED: f64 = 1e6;
/// The logarithm of the value does not go farther than this from its start.
const FARTHEST: f64 = 7.0;
/// Points of the computed curve.
const POINTS_OF_CURVE: usize = 60;

/// What an indentation tells; lengths and forces in the units of the case.
#[derive(Debug, Clone)]
pub struct Indentation {
    /// The name of the log.
    pub log: String,
    /// Units of all numbers; metres and newtons where the case names none.
    pub units: Units,
    /// The number of the case, and the depth at which the indenter touches.
    pub constants: [Constant; 2],
    /// Standard deviation of the points about the computed curve, over the largest load.
    pub noise: f64,
    /// Depth from where the indenter touches, and load, as measured, with the computed load at that depth.
    pub points: Vec<[f64; 3]>,
    /// The computed curve.
    pub computed: Vec<[f64; 2]>,
    /// Rows without a number that were skipped: their lines and what is wrong there.
    pub bad_rows: Vec<String>,
    /// What the data cannot tell, and what was assumed.
    pub notes: Vec<String>,
}

/// Fits a number of a case, and where the indenter touches, to a measured indentation, whose name and bytes are given.
///
/// # Errors
/// When the log cannot be read as load over depth, or the case cannot be solved.
pub fn indentation(
    (name, bytes): (&str, &[u8]),
    case: Case,
    key: Key<'_>,
    request: &Request,
) -> Result<Indentation, IdentifyError> {
    let table = read((name, bytes), (&ROLES, "log"), &request.asked, request.strict)?;
    let mut notes = Vec::new();
    let scale = scales(&table, (&ROLES, &request.asked), case.units.as_ref(), &mut notes)?;
    let units = case.units.clone().unwrap_or_else(|| Units::new("m", "N"));
    let [depths, loads] = pressed(&table, [scale[DEPTH], scale[LOAD]], name)?;
    let [_, most] = range(&loads);
    // Where it touches, for a start: the last row before the load stays above a little of the largest.
    let touches = loads.iter().position(|load| *load > TOUCHES * most).unwrap_or(0);
    let [_, deepest] = range(&depths);
    let start = depths[touches.saturating_sub(1)];
    let indenter = Indenter::new(case, key, BEYOND * (deepest - start))?;
    let mut fit = Fit::new(&indenter, [&depths, &loads], start)?;
    for _ in 0..ROUNDS {
        fit.weigh();
        let (found, report) =
            LevenbergMarquardt::new().with_ftol(1e-9).with_xtol(1e-7).with_patience(8).minimize(fit);
        fit = found;
        if fit.now.is_none() || matches!(report.termination, TerminationReason::User(_)) {
            let what = format!(
                "no curve of the case comes near the measured one: {} = {:.3e} cannot be solved",
                key.name,
                fit.value()
            );
            return Err(refused(
                name,
                &what,
                "compare bodies, profile and units of the case with those of the test",
            ));
        }
    }
    fit.answer(name, (units, table.bad.into_iter().map(|row| row.what).collect(), notes))
}

/// Depths and loads in the units of the case, pressing positive.
fn pressed(table: &Table, scale: [f64; 2], name: &str) -> Result<[Vec<f64>; 2], IdentifyError> {
    let of = |role: usize| -> Vec<f64> { table.of(role).iter().map(|value| value * scale[role]).collect() };
    let (mut depths, mut loads) = (of(DEPTH), of(LOAD));
    if loads.len() < FEWEST_ROWS {
        let what = format!("{} rows of numbers: an indentation needs at least {FEWEST_ROWS}", loads.len());
        return Err(refused(name, &what, "a hundred points serve well"));
    }
    for values in [&mut depths, &mut loads] {
        let [low, high] = range(values);
        if !(high > low) {
            return Err(refused(
                name,
                "a column is the same in all rows: nothing was measured there",
                "choose another column with --columns",
            ));
        }
        // an instrument may count pressing as negative
        if low.abs() > high.abs() {
            values.iter_mut().for_each(|value| *value = -*value);
        }
    }
    Ok([depths, loads])
}

/// The problem of least squares. Parameters: logarithm of the value over that to start from; depth at which the indenter touches, less
/// that to start from, over the range of depths.
struct Fit<'a> {
    indenter: &'a Indenter<'a>,
    depths: &'a [f64],
    loads: &'a [f64],
    start: f64,
    /// Ranges of depth and load.
    units: [f64; 2],
    /// Noise of both, as large as the ranges together.
    noises: [f64; 2],
    weights: Vec<f64>,
    parameters: DVector<f64>,
    now: Option<Curve>,
}

impl<'a> Fit<'a> {
    fn new(
        indenter: &'a Indenter<'a>,
        [depths, loads]: [&'a [f64]; 2],
        start: f64,
    ) -> Result<Self, IdentifyError> {
        let units = [range(depths), range(loads)].map(|[low, high]| high - low);
        let of = |values: &[f64], unit: f64| (noise(values, 0.0) / unit).hypot(QUIET);
        let [length, force] = [of(depths, units[0]), of(loads, units[1])];
        let ratio = (length / force).clamp(1.0 / UNEQUAL, UNEQUAL);
        let force = (2.0 / (1.0 + ratio * ratio)).sqrt();
        Ok(Self {
            indenter,
            depths,
            loads,
            start,
            units,
            noises: [ratio * force * units[0], force * units[1]],
            weights: Vec::new(),
            parameters: DVector::zeros(2),
            now: Some(indenter.curve(indenter.key().1)?),
        })
    }

    /// The value of the parameters.
    fn value(&self) -> f64 {
        self.indenter.key().1 * self.parameters[0].clamp(-FARTHEST, FARTHEST).exp()
    }

    /// Where the indenter touches.
    fn touches(&self) -> f64 {
        self.start + self.parameters[1] * self.units[0]
    }

    /// The weights of the points by the curve as it is.
    fn weigh(&mut self) {
        let (Some(now), touches, [length, force]) = (&self.now, self.touches(), self.noises) else { return };
        let weight = |depth: &f64| 1.0 / force.hypot(length * now.at(depth - touches)[1]);
        self.weights = self.depths.iter().map(weight).collect();
    }

    /// Weighted differences of loads from a curve.
    fn differences(&self, curve: &Curve) -> Vec<f64> {
        let touches = self.touches();
        let points = self.depths.iter().zip(self.loads).zip(&self.weights);
        points.map(|((depth, load), weight)| weight * (load - curve.at(depth - touches)[0])).collect()
    }

    fn sureness(&self) -> Option<Sureness> {
        let (residuals, jacobian) = (self.residuals()?, self.jacobian()?);
        let of_force: Vec<f64> =
            self.weights.iter().map(|weight| (weight * self.noises[1]).powi(2)).collect();
        let nothing = DVector::zeros(residuals.len());
        sureness(&Left {
            jacobian: &jacobian,
            residuals: &residuals,
            of_force: &of_force,
            bend: (nothing, 0.0),
        })
    }

    fn answer(
        self,
        name: &str,
        (units, bad_rows, mut notes): (Units, Vec<String>, Vec<String>),
    ) -> Result<Indentation, IdentifyError> {
        let lost = || refused(name, "the curve cannot be fitted: its constants do not determine it", "");
        let sure = self.sureness().ok_or_else(lost)?;
        let now = self.now.as_ref().ok_or_else(lost)?;
        let (value, touches) = (self.value(), self.touches());
        let [half, apart] = [sure.halves[0], sure.halves[1] * self.units[0]];
        let key = self.indenter.key().0;
        let told = half < TOLD && self.parameters[0].abs() < FARTHEST;
        if !told {
            notes.push(format!("the curve does not tell {key}: it hardly changes with it, or changes as with where the indenter touches"));
        }
        if sure.correlation > 0.0 {
            notes.push(format!(
                "neighbouring points are correlated by {:.2}, or the model misses something of the course: the intervals are as much wider",
                sure.correlation
            ));
        }
        let point = |(depth, load): (&f64, &f64)| [depth - touches, *load, now.at(depth - touches)[0]];
        let points: Vec<[f64; 3]> = self.depths.iter().zip(self.loads).map(point).collect();
        let off = points.iter().map(|[_, load, computed]| (load - computed).powi(2)).sum::<f64>();
        let deepest = points.iter().fold(0.0_f64, |most, point| most.max(point[0]));
        let along = |k: usize| deepest * k as f64 / POINTS_OF_CURVE as f64;
        Ok(Indentation {
            log: name.to_owned(),
            units,
            constants: [
                Constant {
                    name: key.to_owned(),
                    unit: "",
                    value,
                    interval: [value * (-half).exp(), value * half.min(700.0).exp()],
                    told,
                },
                Constant {
                    name: "depth at first touch".to_owned(),
                    unit: "length",
                    value: touches,
                    interval: [touches - apart, touches + apart],
                    told: true,
                },
            ],
            noise: (off / (points.len() as f64 - 2.0)).sqrt() / self.units[1],
            computed: (0..=POINTS_OF_CURVE).map(|k| [along(k), now.at(along(k))[0]]).collect(),
            points,
            bad_rows,
            notes,
        })
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Fit<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, parameters: &DVector<f64>) {
        let same = parameters[0] == self.parameters[0];
        self.parameters.clone_from(parameters);
        if !same || self.now.is_none() {
            self.now = self.indenter.curve(self.value()).ok();
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
        Some(DVector::from_vec(self.differences(now)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let now = self.now.as_ref()?;
        let beside = |step: f64| Some((step, self.indenter.curve(self.value() * step.exp()).ok()?));
        let (step, there) = beside(STEP).or_else(|| beside(-STEP))?;
        let (here, there) = (self.differences(now), self.differences(&there));
        let touches = self.touches();
        Some(DMatrix::from_fn(here.len(), 2, |row, k| match k {
            0 => (there[row] - here[row]) / step,
            _ => self.weights[row] * now.at(self.depths[row] - touches)[1] * self.units[0],
        }))
    }
}
