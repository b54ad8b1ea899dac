//! The points of a sweep: the loop and the numbers of each, shown when a link leads there, and the table of all.

use maud::{Markup, html};

use super::view::View;
use super::words::{called, spoken};
use crate::report::{Measured, chapter, pairs};
use crate::sweep::Path;
use fret_drawing::{Chart, Curve};

/// Points that stand in the page each with its loop, at the most: links lead to these.
pub const MOST_LOOPS: usize = 500;
/// Rows of the table, at the most.
const MOST_ROWS: usize = 1000;
/// Columns of the table beside the keys, where a sweep has them.
const TABLED: [&str; 12] = [
    "cycle_regime",
    "regime",
    "max_pressure",
    "cycle_dissipated_energy",
    "cycle_energy_ratio",
    "max_von_mises",
    "smith_watson_topper",
    "smith_watson_topper_cycles",
    "smith_watson_topper_line_cycles",
    "crack_fate",
    "coating_tension",
    "max_temperature_rise",
];

/// All points, of which the page shows the one that a link leads to.
pub fn one_by_one(view: &View) -> Markup {
    let shown = view.record.points.len().min(MOST_LOOPS);
    html! {
        @for point in 0..shown { (one(view, point)) }
        @if shown < view.record.points.len() {
            p class="small" { "Loops of the first " (shown) " of " (view.record.points.len()) " points." }
        }
    }
}

fn one(view: &View, point: usize) -> Markup {
    let keys: Vec<usize> = (0..view.record.keys.len()).collect();
    let answer = view.answers[point].as_ref();
    let numbers = answer.and_then(|answer| answer.numbers.as_ref());
    let known = view.columns.iter().filter(|column| !column.values[point].is_null());
    let told = known.map(|column| (spoken(&column.name), view.told(column, point)));
    html! {
        div class="point" id=(format!("point-{point}")) {
            h3 { "Point " (point) }
            p { (view.place(&keys, point)) }
            @match answer {
                None => p class="warning" { "Not solved yet." },
                Some(answer) if !answer.message().is_empty() => p class="warning" { (answer.message()) },
                Some(_) => {},
            }
            @if let Some(numbers) = numbers {
                (loop_of(view, &numbers.path))
                (pairs(told))
            }
        }
    }
}

fn loop_of(view: &View, path: &Path) -> Markup {
    let moves = path.points.iter().any(|point| point != &path.points[0]);
    html! {
        @if moves {
            @let curve = Curve::plain(path.points.clone());
            (Chart::new("fretting loop of the point", view.loop_labels(path.twists), vec![curve]).figure("The last cycle."))
        }
    }
}

/// The table of all points: their keys, and the numbers that are asked for most.
pub fn table(view: &View) -> Markup {
    let has_cycles = view.column("cycle_regime").is_some_and(|column| {
        column.values.iter().any(|value| value.as_str().is_some_and(|word| !word.is_empty()))
    });
    let columns: Vec<_> = TABLED
        .iter()
        .filter(|name| if has_cycles { **name != "regime" } else { !name.starts_with("cycle_") })
        .filter_map(|name| view.column(name))
        .collect();
    let rows = view.record.points.len().min(MOST_ROWS);
    let body = html! {
        div class="scroll" {
            table class="grid" {
                thead { tr {
                    th { "point" }
                    @for key in &view.record.keys { th title=(key) { (called(key)) } }
                    @for column in &columns { th { (spoken(&column.name)) } }
                } }
                tbody {
                    @for point in 0..rows {
                        tr {
                            td {
                                @if point < MOST_LOOPS { a href=(format!("#point-{point}")) { (point) } } @else { (point) }
                            }
                            @for (key, value) in view.record.points[point].values.iter().enumerate() {
                                td { (view.value(key, value)) }
                            }
                            @if view.answers[point].as_ref().is_some_and(|answer| answer.numbers.is_some()) {
                                @for column in &columns { td { (view.told(column, point)) } }
                            } @else {
                                td colspan=(columns.len()) { (view.answers[point].as_ref().map_or("not solved yet", |answer| answer.status())) }
                            }
                        }
                    }
                }
            }
        }
        p class="small" {
            @if rows < view.record.points.len() { "The first " (rows) " of " (view.record.points.len()) " points. " }
            "All numbers of all points: " code { "summary.csv" } "."
        }
    };
    chapter("All points", &body)
}
