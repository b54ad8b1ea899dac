//! Numbers of a case from a measured indentation: load over depth, laid by least squares through the curve of the solver.
//!
//! The numbers are moduli, thicknesses and others of bodies and profile; besides, the depth at which the indenter touches, which no instrument
//! knows, and the compliance of its frame. Intervals are those of `intervals`: linear about the solution, with noise of load and depth and the
//! correlation of neighbours; the error of the grid is not in them.

mod feet;
mod fit;
mod indenter;
mod load_curve;
mod log;
mod notes;
mod request;
mod scaling;
mod start;
mod sureness;
#[cfg(test)]
mod tests;

use super::error::{IdentifyError, refused};
use super::found::Constant;
use crate::case::Case;
use crate::units::Units;
use fit::{FARTHEST, Fit, Known, fit};
use indenter::{Indenter, Pressing};
use log::Curves;
use notes::{LOST, note_of_grid, note_of_zero, notes_of_bounds, notes_of_residuals};
pub use request::{IndentationRequest, Numbers, Part};
use sureness::Sides;

/// Points of the computed curve.
const POINTS_OF_CURVE: usize = 60;
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
    let known = Known { touch, frame: case.springs().normal, fits_frame: request.frame, sign: curves.sign };
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
    let by_grid = found.grid.as_deref().and_then(|grid| note_of_grid(&found.constants, grid));
    found.notes.extend(by_grid);
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
    let sure = fit.sureness(false).ok_or_else(lost)?;
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
    let zero = note_of_zero(curves, most);
    let is_lost = noise > LOST || wanders || touch_is_bound || zero.is_some();
    notes.extend(zero);
    let linear = Sides::linear(&sure);
    let sides = if is_lost { linear } else { fit.sides(&curves.name, linear, sure.correlation) };
    let mut constants = constants(fit, &sides, names, curves.sign);
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
    let held: Vec<&str> =
        constants.iter().filter(|constant| constant.told).map(|constant| constant.name.as_str()).collect();
    if !sides.beside.is_empty() && !held.is_empty() {
        let beside: Vec<&str> = sides.beside.iter().map(|place| names[*place]).collect();
        notes.push(format!(
            "{}: the interval holds for all values of {} that the points allow, by fits with that held",
            held.join(", "),
            beside.join(", ")
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
        histories: fit.histories + sides.histories,
        points,
        lines: curves.lines.clone(),
        computed,
        bad_rows: curves.bad_rows.clone(),
        notes,
        log: curves.name.clone(),
    })
}

/// The constants with their intervals.
fn constants<P: Pressing>(fit: &Fit<'_, P>, sides: &Sides, names: &[&str], sign: f64) -> Vec<Constant> {
    let [length, force] = fit.units;
    let told = |place: usize| sides.tell(place) && !fit.is_bound(place);
    let number = |(k, (name, value)): (usize, (&&str, f64))| {
        let [below, above] = sides.of[k].map(|side| side.min(FARTHEST));
        Constant {
            name: (*name).to_owned(),
            unit: unit_of(name),
            value,
            interval: [value * (-below).exp(), value * above.exp()],
            told: told(k),
        }
    };
    let mut found: Vec<Constant> = names.iter().zip(fit.values()).enumerate().map(number).collect();
    let mut linear = |name: &str, unit, value: f64, place: Option<usize>, scale: f64, sign: f64| {
        let Some(place) = place else { return };
        // Of a curve of which nothing bounds it: as far as it may be.
        let [below, above] = sides.of[place].map(|side| side.min(1e3) * scale);
        let [below, above] = if sign < 0.0 { [above, below] } else { [below, above] };
        let interval = [value - below, value + above];
        found.push(Constant { name: name.to_owned(), unit, value, interval, told: told(place) });
    };
    linear("depth at first touch", "length", sign * fit.touch(), fit.place_of_touch(), length, sign);
    linear("frame compliance", "length/force", fit.frame(), fit.place_of_frame(), length / force, 1.0);
    found
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
