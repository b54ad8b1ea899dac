//! The page of an identification: the measured loop beside the computed one, the loops of all cycles, what was found.

use fret_core::case::Units;
use maud::{Markup, html};
use serde_json::Value;

use super::cycles::MeasuredCycle;
use super::quantities::COLUMNS;
use crate::drawing::chart::{Chart, Curve, Stroke};
use crate::drawing::scale::Label;
use crate::report::html::{figure_of, number, table};
use crate::report::whole_page;

/// Loops that the stack shows, at the most.
const MOST_LOOPS: usize = 40;

/// Columns of the table of cycles that are in `cycles.csv` alone.
const NOT_ON_THE_PAGE: [&str; 3] = ["points", "contact_sliding_ratio", "slope_after_reversal"];

/// The page.
pub fn page(json: &Value, units: &Units, cycles: &[MeasuredCycle]) -> String {
    let title = format!("Fretting loops of {}", json["log"].as_str().unwrap_or_default());
    let label = |name: &str, unit: &str| Label { name: name.to_owned(), unit: Some(unit.to_owned()) };
    let axes = [label("displacement", &units.length), label("tangential force", &units.force)];
    let notes = json["notes"].as_array().map(Vec::as_slice).unwrap_or_default();
    let content = html! {
        h1 { (title) }
        (constants(json, units))
        (figure_of(
            &beside(json, axes.clone()).in_page(),
            "Measured points without offset and drift, and the loop that the solver computes; dashed: the loop of the contact itself."
        ))
        @if cycles.len() > 1 {
            (figure_of(
                &stack(cycles, axes).in_page(),
                "Fretting log: the loops one after the other, each moved to the right and up; the first at the bottom."
            ))
        }
        (rows(json, units))
        ul { @for note in notes { li { (note.as_str().unwrap_or_default()) } } }
    };
    whole_page(&title, &content)
}

fn shown(value: &Value) -> String {
    value.as_f64().map_or_else(|| "–".to_owned(), number)
}

fn constants(json: &Value, units: &Units) -> Markup {
    let rows: Vec<Vec<String>> = json["parameters"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|constant| {
            let told = constant["told"].as_bool() == Some(true);
            let cell = |key: &str| if told { shown(&constant[key]) } else { "not told".to_owned() };
            vec![
                constant["name"].as_str().unwrap_or_default().to_owned(),
                cell("value"),
                cell("low"),
                cell("high"),
                units.of(constant["unit"].as_str().unwrap_or_default()),
            ]
        })
        .collect();
    table(&["constant", "value", "95 % from", "to", "unit"], &rows)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

fn beside(json: &Value, axes: [Label; 2]) -> Chart {
    let removed = |key: &str| json["removed"][key].as_f64().unwrap_or(0.0);
    let (displacement, force) =
        (numbers(&json["measured"]["displacement"]), numbers(&json["measured"]["force"]));
    let count = displacement.len() as f64;
    let points = displacement.iter().zip(&force).enumerate().map(|(row, (d, q))| {
        let time = (row as f64 + 0.5) / count - 0.5;
        [
            d - removed("displacement_offset")
                - time * removed("displacement_drift")
                - (4.0 * time * time - 1.0 / 3.0) * removed("displacement_bend"),
            q - removed("force_offset"),
        ]
    });
    let computed = |along: &str| -> Vec<[f64; 2]> {
        let [along, force] = [along, "force"].map(|key| numbers(&json["computed"][key]));
        along.into_iter().zip(force).map(|(d, q)| [d, q]).collect()
    };
    let curve = |points: Vec<[f64; 2]>, name: &str, colour: usize, stroke: Stroke| Curve {
        points,
        name: Some(name.to_owned()),
        colour,
        stroke,
        id: None,
    };
    Chart::new(
        "measured and computed fretting loop",
        axes,
        vec![
            curve(points.collect(), "measured", 1, Stroke::Dots),
            curve(computed("displacement"), "computed, at the actuator", 0, Stroke::Line),
            curve(computed("shift"), "computed, the contact's own", 2, Stroke::Dashed),
        ],
    )
}

/// The loops of a log, each moved on by a part of the range.
fn stack(cycles: &[MeasuredCycle], axes: [Label; 2]) -> Chart {
    let cycles: Vec<&MeasuredCycle> = cycles.iter().filter(|cycle| cycle.fault.is_none()).collect();
    let every = cycles.len().div_ceil(MOST_LOOPS).max(1);
    let range = |of: &dyn Fn(&MeasuredCycle) -> &[f64]| {
        let all = cycles.iter().flat_map(|&cycle| of(cycle).iter().copied());
        let [low, high] = all
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        high - low
    };
    let (along, up) = (range(&|cycle| &cycle.displacement), range(&|cycle| &cycle.force));
    let shown: Vec<&MeasuredCycle> = cycles.iter().copied().step_by(every).collect();
    let curves = shown.iter().enumerate().map(|(k, cycle)| {
        let moved = 1.5 * k as f64 / shown.len() as f64;
        let points = cycle.displacement.iter().zip(&cycle.force);
        let mut points: Vec<[f64; 2]> = points.map(|(d, q)| [d + moved * along, q + moved * up]).collect();
        points.extend(points.first().copied());
        Curve {
            points,
            name: None,
            colour: 0,
            stroke: if k + 1 == shown.len() { Stroke::Line } else { Stroke::Faint },
            id: None,
        }
    });
    Chart::new("fretting log: loops of the cycles", axes, curves.collect())
}

fn rows(json: &Value, units: &Units) -> Markup {
    let columns = COLUMNS.into_iter().filter(|(name, _)| !NOT_ON_THE_PAGE.contains(name));
    let head: Vec<String> = columns
        .clone()
        .map(|(name, unit)| {
            if unit.is_empty() {
                name.replace('_', " ")
            } else {
                format!("{} [{}]", name.replace('_', " "), units.of(unit))
            }
        })
        .collect();
    let all = json["cycles"].as_array().map(Vec::as_slice).unwrap_or_default();
    let every = all.len().div_ceil(MOST_LOOPS).max(1);
    let rows: Vec<Vec<String>> = all
        .iter()
        .step_by(every)
        .map(|row| {
            let cell = |(name, _): (&str, &str)| match row[name].as_f64() {
                Some(cycle) if name == "cycle" => cycle.to_string(),
                _ => shown(&row[name]),
            };
            columns.clone().map(cell).collect()
        })
        .collect();
    table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &rows)
}
