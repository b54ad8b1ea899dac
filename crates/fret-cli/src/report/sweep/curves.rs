//! Curves over an axis of a sweep: each telling number over the key with most values, a curve for every value of the other keys.

use maud::{Markup, html};

use super::view::View;
use super::words::spoken;
use crate::figures::capitalised;
use crate::report::{chapter, side_by_side};
use crate::sweep::columns::SummaryColumn;
use fret_drawing::{Axis, Chart, Curve};

/// Numbers that are drawn where they vary, the most asked first.
const DRAWN: [&str; 22] = [
    "cycle_dissipated_energy",
    "cycle_energy_ratio",
    "cycle_sliding_ratio",
    "cycle_stiffness",
    "cycle_force_amplitude",
    "cycle_displacement_amplitude",
    "smith_watson_topper_cycles",
    "smith_watson_topper_line_cycles",
    "smith_watson_topper",
    "fatemi_socie_cycles",
    "dang_van_factor_of_safety",
    "crossland_factor_of_safety",
    "crack_cycles",
    "max_von_mises",
    "max_tension",
    "coating_tension",
    "coating_delamination",
    "max_temperature_rise",
    "electrical_resistance",
    "cycle_max_worn_depth",
    "max_pressure",
    "contact_area",
];
/// More charts are not drawn.
const MOST_CHARTS: usize = 12;
/// Colours of curves, and curves that are named.
const COLOURS: usize = 6;
/// More curves are not drawn in one chart.
const MOST_CURVES: usize = 12;
/// Numbers that vary by less, relative, do not.
const ROUNDING: f64 = 1e-9;

/// The chapter; nothing of a sweep without axes, or of samples, whose scatter `spread` shows.
pub fn curves(view: &View) -> Markup {
    let axes = view.axes();
    let Some(&across) = axes.iter().max_by_key(|&&key| view.distinct(key).len()) else { return html! {} };
    if !view.record.drawn.is_empty() {
        return html! {};
    }
    let others: Vec<usize> = axes.into_iter().filter(|axis| *axis != across).collect();
    let varying = DRAWN.iter().filter_map(|name| view.column(name)).filter(|column| varies(column));
    let figures: Vec<Markup> =
        varying.take(MOST_CHARTS).map(|column| drawn(view, column, across, &others)).collect();
    if figures.is_empty() {
        return html! {};
    }
    chapter("Over an axis", &side_by_side(&figures))
}

fn varies(column: &SummaryColumn) -> bool {
    let [low, high] = Axis::ends(column.numbers());
    high - low > ROUNDING * low.abs().max(high.abs())
}

fn drawn(view: &View, column: &SummaryColumn, across: usize, others: &[usize]) -> Markup {
    let numbers = column.numbers();
    let mut groups = view.groups(others);
    let all = groups.len();
    groups.truncate(MOST_CURVES);
    let mut curves = Vec::new();
    for (place, (name, points)) in groups.into_iter().enumerate() {
        let at = |point| [view.position(across, point), numbers[point]];
        let mut points: Vec<[f64; 2]> = points.into_iter().map(at).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let name = Some(name).filter(|name| !name.is_empty());
        curves.extend(Curve { name, colour: place % COLOURS, ..Curve::plain(points) }.dotted());
    }
    let [low, high] = Axis::ends(numbers.iter().copied());
    let chart = Chart {
        logarithmic: low > 0.0 && high > 30.0 * low,
        ..Chart::new(&spoken(&column.name), [view.key_label(across), view.label_of(column)], curves)
    };
    let mut caption = capitalised(&spoken(&column.name));
    let unlimited = numbers.iter().filter(|value| value.is_infinite()).count();
    if unlimited > 0 {
        caption += &format!("; without limit at {unlimited} of {} points", numbers.len());
    }
    if all > MOST_CURVES {
        caption += &format!("; {MOST_CURVES} of {all} curves");
    }
    chart.figure(&(caption + "."))
}
