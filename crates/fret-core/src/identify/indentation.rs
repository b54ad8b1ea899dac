//! Numbers of a case from a measured indentation: load over depth, laid by least squares through the curve of the solver.
//!
//! The numbers are moduli, thicknesses and others of bodies and profile; besides, the depth at which the indenter touches, which no instrument
//! knows, and the compliance of its frame. Intervals are those of `intervals`: linear about the solution, with noise of load and depth and the
//! correlation of neighbours; the error of the grid is not in them.

mod fit;
mod indenter;
mod load_curve;
mod log;
mod request;
mod start;
#[cfg(test)]
mod tests;

use super::error::{IdentifyError, refused};
use super::found::{Constant, TOLD};
use super::intervals::Sureness;
use super::turns::noise as from_row_to_row;
use crate::case::Case;
use crate::units::Units;
use fit::{FARTHEST, FARTHEST_TOUCH, Fit, Known, fit};
use indenter::{Indenter, Pressing};
use log::Curves;
pub use request::{IndentationRequest, Numbers, Part};

/// Points of the computed curve.
const POINTS_OF_CURVE: usize = 60;
/// Loading and unloading differ from so many standard deviations of their difference and this part of the largest load on.
const DIFFER: (f64, f64) = (4.0, 0.005);
/// A load below zero of more than this part of the largest is adhesion.
const PULLS: f64 = 0.03;
/// Points lie off the curve by more than noise from this part of the largest load on.
const OFF: f64 = 0.05;
/// From this part on the curve is another one, and tells nothing.
const LOST: f64 = 0.2;

/// What an indentation tells; lengths and forces in the units of the case.
#[derive(Debug, Clone)]
pub struct Indentation {
    /// The name of the file.
    pub log: String,
    /// Units of all numbers; metres and newtons where the case names none.
    pub units: Units,
    /// Whether the case or the file names units.
    pub has_units: bool,
    /// Which part was fitted.
    pub part: Part,
    /// The numbers of the case; then `depth at first touch` and `frame compliance`, where they are fitted.
    pub constants: Vec<Constant>,
    /// By how much each of them differs on half of the cells along each side, in its unit: a sign of what the grid does, which is not in the
    /// intervals, and no bound of it. `None` where that is not solved.
    pub grid: Option<Vec<f64>>,
    /// The depth at which the indenter touches, as the log counts it.
    pub touch: f64,
    /// Compliance of the frame [length/force].
    pub frame: f64,
    /// Standard deviation of the loads about the computed curve, over the largest load.
    pub noise: f64,
    /// Correlation of the residuals of neighbouring points, where it is more than chance.
    pub correlation: f64,
    /// How many indentations the solver computed.
    pub histories: usize,
    /// Depth from the touch on, measured load, and computed load at that depth, row by row of what was fitted.
    pub points: Vec<[f64; 3]>,
    /// Line of every point in the file.
    pub lines: Vec<usize>,
    /// The computed curve: depth from the touch on, load, and depth of the contact itself, without the frame.
    pub computed: Vec<[f64; 3]>,
    /// Rows without a number that were skipped: their lines and what is wrong there.
    pub bad_rows: Vec<String>,
    /// What the data cannot tell, and what was assumed.
    pub notes: Vec<String>,
}

/// Fits numbers of a case to a measured indentation, whose name and bytes are given.
///
/// # Errors
/// When the file cannot be read as load over depth, or the case cannot be solved.
pub fn indentation(
    (name, bytes): (&str, &[u8]),
    case: &Case,
    numbers: &Numbers<'_>,
    request: &IndentationRequest,
) -> Result<Indentation, IdentifyError> {
    if numbers.keys.is_empty() && !request.frame {
        let what = "nothing is fitted but the depth at first touch".to_owned();
        return Err(IdentifyError::Log {
            what,
            help: "name a number of the case, or fit the frame".to_owned(),
        });
    }
    if let Some(touch) = request.touch.filter(|touch| !touch.is_finite()) {
        return Err(IdentifyError::Log {
            what: format!("touch: {touch} is no finite number"),
            help: "give the depth at first touch as the log counts it, in the unit of the case".to_owned(),
        });
    }
    let curves = Curves::read((name, bytes), case.units.as_ref(), request)?;
    let touch = request.touch.map(|touch| curves.sign * touch);
    let known = Known { touch, frame: case.springs().normal, fits_frame: request.frame };
    let indenter = Indenter::new(case, numbers)?;
    let start: Vec<f64> = numbers.keys.iter().map(|(_, value)| *value).collect();
    let mut fit = fit(name, indenter, &start, [&curves.depths, &curves.loads], known)?;
    let coarser = fit.coarser();
    let mut notes = Vec::new();
    fit.histories += 1;
    for warning in fit.indenter.warnings(&fit.values())? {
        notes.push(warning.message);
    }
    let names: Vec<&str> = numbers.keys.iter().map(|(name, _)| name.as_str()).collect();
    let units = case.units.clone().unwrap_or_else(|| Units::new("m", "N"));
    let has_units = case.units.is_some() || curves.has_units;
    let mut found = answer(&fit, &curves, &names, (units, has_units))?;
    found.part = request.part;
    found.grid = coarser.map(|moved| in_units(&fit, moved.as_slice(), curves.sign));
    found.notes.extend(notes_of_grid(&found));
    found.notes.extend(notes);
    Ok(found)
}

/// The answer of a fit.
pub(super) fn answer<P: Pressing>(
    fit: &Fit<'_, P>,
    curves: &Curves,
    names: &[&str],
    (units, has_units): (Units, bool),
) -> Result<Indentation, IdentifyError> {
    let lost = || {
        let what = "the curve cannot be fitted: its numbers do not determine it";
        refused(
            &curves.name,
            what,
            "fit fewer numbers, or compare bodies, profile and units of the case with those of the test",
        )
    };
    let sure = fit.sureness().ok_or_else(lost)?;
    let (touch, frame) = (fit.touch(), fit.frame());
    let point = |(depth, load): (&f64, &f64)| {
        let seen = fit.seen(*depth)?;
        Some([depth - touch, *load, seen.load])
    };
    let points: Vec<[f64; 3]> =
        curves.depths.iter().zip(&curves.loads).map(point).collect::<Option<_>>().ok_or_else(lost)?;
    let most = fit.loads.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let square = points.iter().map(|[_, load, computed]| (load - computed).powi(2)).sum::<f64>();
    let freedom = points.len().saturating_sub(fit.parameters.len()).max(1);
    let noise = (square / freedom as f64).sqrt() / most;
    if !noise.is_finite() {
        return Err(lost());
    }
    let mut constants = constants(fit, &sure, names, curves.sign);
    let mut notes = curves.notes.clone();
    notes.extend(notes_of_bounds(fit, names));
    // Where numbers act as one, the grid follows what nothing holds.
    let wanders = fit.grid_moves && sure.halves.iter().all(|half| half.is_finite());
    let touch_is_bound = fit.place_of_touch().is_some_and(|place| fit.is_bound(place));
    if noise > LOST {
        notes.push(format!(
            "the fit found no curve near the points ({:.0} % of the largest load off): nothing is told; compare profile, bodies and units of the case with the test, or start from other values",
            100.0 * noise
        ));
    } else if wanders {
        notes.push("the contact of the fitted numbers left each grid that was made for it: nothing is told; start from values nearer to those fitted, or fit fewer numbers".to_owned());
    }
    let is_lost = noise > LOST || wanders || touch_is_bound;
    for constant in &mut constants {
        constant.told &= !is_lost;
    }
    let is_shaky = |(k, constant): &(usize, &Constant)| !constant.told && !fit.is_bound(*k);
    let shaky: Vec<&str> =
        constants.iter().enumerate().filter(is_shaky).map(|(_, constant)| constant.name.as_str()).collect();
    if !shaky.is_empty() && !is_lost {
        notes.push(format!(
            "the curve does not tell {}: it hardly changes with it, or changes in the same way with something else that is fitted",
            shaky.join(", ")
        ));
    }
    if !fit.stands && !is_lost {
        notes.push("the numbers still moved in the last round of the fit: they are those of a curve that comes near, not of the nearest".to_owned());
    }
    notes.extend(notes_of_residuals(curves, &points, (noise, sure.correlation), most));
    let deepest = points.iter().fold(0.0_f64, |most, point| most.max(point[0]));
    let along = |k: usize| {
        let depth = deepest * k as f64 / POINTS_OF_CURVE as f64;
        let seen = fit.seen(depth + touch)?;
        Some([depth, seen.load, seen.depth])
    };
    let computed = (0..=POINTS_OF_CURVE).map(along).collect::<Option<_>>().ok_or_else(lost)?;
    Ok(Indentation {
        units,
        has_units,
        part: Part::default(),
        constants,
        grid: None,
        touch: curves.sign * touch,
        frame,
        noise,
        correlation: sure.correlation,
        histories: fit.histories,
        points,
        lines: curves.lines.clone(),
        computed,
        bad_rows: curves.bad_rows.clone(),
        notes,
        log: curves.name.clone(),
    })
}

/// The constants with their intervals.
fn constants<P: Pressing>(fit: &Fit<'_, P>, sure: &Sureness, names: &[&str], sign: f64) -> Vec<Constant> {
    let [length, force] = fit.units;
    let number = |(k, (name, value)): (usize, (&&str, f64))| {
        let half = sure.halves[k];
        Constant {
            name: (*name).to_owned(),
            unit: unit_of(name),
            value,
            interval: [value * (-half.min(FARTHEST)).exp(), value * half.min(FARTHEST).exp()],
            told: half < TOLD && !fit.is_bound(k),
        }
    };
    let mut found: Vec<Constant> = names.iter().zip(fit.values()).enumerate().map(number).collect();
    let mut linear = |name: &str, unit, value: f64, place: Option<usize>, scale: f64| {
        let Some(place) = place else { return };
        let half = sure.halves[place];
        // Of a curve of which nothing bounds it: as far as it may be.
        let apart = half.min(1e3) * scale;
        let interval = [value - apart, value + apart];
        let is_bound = fit.is_bound(place);
        found.push(Constant { name: name.to_owned(), unit, value, interval, told: half < TOLD && !is_bound });
    };
    linear("depth at first touch", "length", sign * fit.touch(), fit.place_of_touch(), length);
    linear("frame compliance", "length/force", fit.frame(), fit.place_of_frame(), length / force);
    found
}

/// Parameters that went as far as they may: the points do not bound them.
fn notes_of_bounds<P: Pressing>(fit: &Fit<'_, P>, names: &[&str]) -> Vec<String> {
    let note = |k: usize| {
        match names.get(k) {
        Some(name) => {
            format!("{name} went as far from its start as it may, a factor of {:.0}: not told", FARTHEST.exp())
        }
        None if fit.place_of_touch() == Some(k) => {
            format!(
                "the depth at first touch went {FARTHEST_TOUCH} ranges of the depth away from where the points let it be guessed: nothing is told; is the load counted from zero?"
            )
        }
        None => "the frame compliance would be negative: it is held at zero and not told; the other numbers are those of a rigid frame".to_owned(),
    }
    };
    (0..fit.parameters.len()).filter(|k| fit.is_bound(*k)).map(note).collect()
}

/// Changes of the parameters of a fit as those of its constants.
fn in_units<P: Pressing>(fit: &Fit<'_, P>, moved: &[f64], sign: f64) -> Vec<f64> {
    let [length, force] = fit.units;
    let values = fit.values();
    let change = |(k, moved): (usize, &f64)| match values.get(k) {
        Some(value) => value * moved,
        None if fit.place_of_touch() == Some(k) => sign * length * moved,
        None => length / force * moved,
    };
    moved.iter().enumerate().map(change).collect()
}

/// Constants that the grid moves by more than what noise leaves open.
fn notes_of_grid(found: &Indentation) -> Option<String> {
    let grid = found.grid.as_ref()?;
    let moved = |(constant, moved): (&Constant, &f64)| {
        let [low, high] = constant.interval;
        (constant.told && 2.0 * moved.abs() > high - low).then(|| constant.name.clone())
    };
    let names: Vec<String> = found.constants.iter().zip(grid).filter_map(moved).collect();
    (!names.is_empty()).then(|| {
        format!(
            "with half of the cells along each side {} would lie outside of the interval: the grid matters more than the noise; more cells would tell",
            names.join(", ")
        )
    })
}

/// The unit of a number of a case by the end of its path, in the words of [`Units::of`].
fn unit_of(path: &str) -> &'static str {
    let is_key = |part: &&str| part.trim_end_matches(']').parse::<usize>().is_err();
    match path.rsplit(['.', '[']).find(is_key) {
        Some("young") => "pressure",
        Some("thickness" | "radius" | "radius_x" | "radius_y" | "flat_radius" | "edge_radius") => "length",
        Some("normal_stiffness" | "shear_stiffness") => "pressure/length",
        _ => "",
    }
}

/// What the residuals tell.
fn notes_of_residuals(
    curves: &Curves,
    points: &[[f64; 3]],
    (noise, correlation): (f64, f64),
    most: f64,
) -> Vec<String> {
    let mut notes = Vec::new();
    let count = points.len() as f64;
    let independent = (count * (1.0 - correlation) / (1.0 + correlation)).max(1.0);
    if correlation > 0.0 {
        notes.push(format!(
            "the residuals of neighbouring points are correlated ({correlation:.2}), as those of a filtered signal are, or the computed curve has another shape: the intervals are those of {independent:.0} independent point{} in place of {count}",
            if independent < 1.5 { "" } else { "s" }
        ));
    }
    let top = curves.top;
    let off: Vec<f64> = points.iter().map(|[_, load, computed]| (load - computed) / most).collect();
    let mean = |rows: &[f64]| rows.iter().sum::<f64>() / rows.len() as f64;
    let (loading, unloading) = off.split_at(top.min(off.len()));
    if loading.len() > 5 && unloading.len() > 5 {
        let apart = mean(loading) - mean(unloading);
        // By the noise from row to row: that about the curve has the difference in it.
        let chance =
            from_row_to_row(&off, 0.0) * (1.0 / loading.len() as f64 + 1.0 / unloading.len() as f64).sqrt();
        if apart > (DIFFER.0 * chance).max(DIFFER.1) {
            notes.push(format!(
                "loading lies above unloading by {:.1} % of the largest load in the mean: the test is not elastic (plastic, viscous, or it drifts), and the model is; fit one part alone (loading or unloading), or a test with less load",
                100.0 * apart
            ));
        }
    }
    let lowest = points.iter().fold(0.0_f64, |low, point| low.min(point[1])) / most;
    if lowest < -PULLS.max(4.0 * noise) {
        notes.push(format!(
            "the load falls to {:.1} % of the largest: adhesion, or a load that is not counted from zero, of which the model knows nothing",
            100.0 * lowest
        ));
    }
    if noise > OFF && noise <= LOST {
        notes.push(format!(
            "the points lie {:.0} % of the largest load off the curve: more than noise; the case describes another contact",
            100.0 * noise
        ));
    }
    notes
}
