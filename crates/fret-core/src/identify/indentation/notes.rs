//! What is said beside the numbers of an indentation: what the points do not tell, what the grid does, what the residuals show.

use super::super::found::Constant;
use super::super::turns::{noise as from_row_to_row, range};
use super::fit::{FARTHEST, FARTHEST_TOUCH, Fit};
use super::indenter::Pressing;
use super::log::Curves;

/// From this part on the curve is another one, and tells nothing.
pub const LOST: f64 = 0.2;
/// Loading and unloading differ from so many standard deviations of their difference and this part of the largest load on.
const DIFFER: (f64, f64) = (4.0, 0.005);
/// A load below zero of more than this part of the largest is adhesion.
const PULLS: f64 = 0.03;
/// The shallowest points, over so much of the range of depths, lie before the touch where their load rises by less than this part of the mean
/// slope; a convex curve that begins deeper rises by more, or has less load there than `OFFSET` of the largest and so many standard deviations.
const BEFORE_TOUCH: [f64; 6] = [0.3, 0.2, 0.15, 0.1, 0.07, 0.05];
const FEWEST_BEFORE: usize = 5;
const FLAT: f64 = 0.2;
const OFFSET: (f64, f64) = (0.02, 4.0);
/// Points lie off the curve by more than noise from this part of the largest load on.
const OFF: f64 = 0.05;

/// Parameters that went as far as they may: the points do not bound them.
pub fn notes_of_bounds<P: Pressing>(fit: &Fit<'_, P>, names: &[&str]) -> Vec<String> {
    let note = |k: usize| {
        match names.get(k) {
        Some(name) if fit.ends(k) => {
            format!("{name} went to the end of what it may be, {:.5}: not told; are the other numbers of the case those of the test?", fit.values()[k])
        }
        Some(name) => {
            format!("{name} went as far from its start as it may, a factor of {:.0}: not told", FARTHEST.exp())
        }
        None if fit.place_of_touch() == Some(k) => {
            format!(
                "the depth at first touch went {FARTHEST_TOUCH} ranges of the depth away from where the points let it be guessed: nothing is told; is the load counted from zero?"
            )
        }
        None => "the frame compliance would be negative: it is held at zero and not told; the other numbers are those of a rigid frame, their intervals those of one that is fitted".to_owned(),
    }
    };
    (0..fit.parameters.len()).filter(|k| fit.is_bound(*k)).map(note).collect()
}

/// Constants that the grid moves by more than what noise leaves open.
pub fn note_of_grid(constants: &[Constant], grid: &[f64]) -> Option<String> {
    let moved = |(constant, moved): (&Constant, &f64)| {
        let [low, high] = constant.interval;
        (constant.told && 2.0 * moved.abs() > high - low).then(|| constant.name.clone())
    };
    let names: Vec<String> = constants.iter().zip(grid).filter_map(moved).collect();
    (!names.is_empty()).then(|| {
        format!(
            "with half of the cells along each side {} would lie outside of the interval: the grid matters more than the noise; more cells would tell",
            names.join(", ")
        )
    })
}

/// What the residuals tell.
pub fn notes_of_residuals(
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

/// That the load of the points before the touch is not zero: where the shallowest ones do not rise, and have a load.
pub fn note_of_zero(curves: &Curves, most: f64) -> Option<String> {
    let [shallowest, deepest] = range(&curves.depths);
    let [_, highest] = range(&curves.loads);
    let [wide, high] = [deepest - shallowest, highest - range(&curves.loads)[0]];
    let flat = |part: &f64| {
        let points: Vec<[f64; 2]> = curves
            .depths
            .iter()
            .zip(&curves.loads)
            .map(|(depth, load)| [(depth - shallowest) / wide, load / high])
            .filter(|point| point[0] <= *part)
            .collect();
        let count = points.len() as f64;
        if points.len() < FEWEST_BEFORE {
            return None;
        }
        let [depth, load] = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
        let square: f64 = points.iter().map(|point| (point[0] - depth).powi(2)).sum();
        let slope = points.iter().map(|point| (point[0] - depth) * (point[1] - load)).sum::<f64>() / square;
        let off: f64 =
            points.iter().map(|point| (point[1] - load - slope * (point[0] - depth)).powi(2)).sum();
        let scatter = (off / (count - 2.0)).sqrt();
        (slope.abs() + 2.0 * scatter / square.sqrt() < FLAT).then_some((
            points.len(),
            *part,
            load,
            scatter / count.sqrt(),
        ))
    };
    let (count, part, load, unsure) = BEFORE_TOUCH.iter().find_map(flat)?;
    let load = load * high / most;
    (load.abs() > OFFSET.0.max(OFFSET.1 * unsure)).then(|| {
        format!(
            "the {count} shallowest points, up to a depth of {:.6e}, do not rise, and have a load of {:.1} % of the largest in the mean: the load is not counted from zero, and nothing is told; subtract it from the column of the load",
            curves.sign * (shallowest + part * wide),
            100.0 * load
        )
    })
}
