//! Curves over an axis of a sweep: each telling number over the key with most values, a curve for every value of the other keys.

use maud::{Markup, html};

use super::view::{View, spoken};
use crate::drawing::chart::{Chart, Curve, Stroke};
use crate::figures::capitalised;
use crate::report::html::{chapter, side_by_side};
use crate::sweep::columns::SummaryColumn;

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
    let finite = || column.numbers().into_iter().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    high - low > ROUNDING * low.abs().max(high.abs())
}

fn drawn(view: &View, column: &SummaryColumn, across: usize, others: &[usize]) -> Markup {
    let numbers = column.numbers();
    let mut groups: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    for (point, number) in numbers.iter().enumerate() {
        let name = view.place(others, point);
        let at = [view.position(across, point), *number];
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, points)) => points.push(at),
            None => groups.push((name, vec![at])),
        }
    }
    let all = groups.len();
    groups.truncate(MOST_CURVES);
    let mut curves = Vec::new();
    for (place, (name, mut points)) in groups.into_iter().enumerate() {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let name = Some(name).filter(|name| !name.is_empty());
        let line = Curve { colour: place % COLOURS, ..Curve::plain(points) };
        curves.push(Curve { name, ..line.clone() });
        curves.push(line.drawn(Stroke::Dots));
    }
    let finite = || numbers.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(0.0, f64::max));
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
