//! A study of refinement in one page: which resolution to choose, the error of every quantity over the cells and the increments, and over
//! the time that a level took. Read back from `study.json`.

use std::fs;
use std::path::Path;

use maud::{Markup, html};
use serde_json::Value;

use super::html::{chapter, figure_of, side_by_side, table};
use super::whole_page;
use crate::drawing::chart::{Chart, Curve, Stroke};
use crate::drawing::scale::Label;
use crate::failure::Failure;

/// The answer of a study, which marks its folder.
pub const STUDY: &str = "study.json";

/// The page of a study, and how many levels it has.
///
/// # Errors
/// When the answer of the study cannot be read.
pub fn page(folder: &Path) -> Result<(String, usize), Failure> {
    let path = folder.join(STUDY);
    let refuse = |why: String| {
        Failure::Call(format!("{}: {why}", path.display()), "run `fret study` again".to_owned())
    };
    let text = fs::read(&path).map_err(|error| refuse(error.to_string()))?;
    let study: Value =
        serde_json::from_slice(&text).map_err(|error| refuse(format!("cannot be read: {error}")))?;
    let lines: Vec<&Value> = study["lines"].as_array().into_iter().flatten().collect();
    let levels = lines.iter().map(|line| levels(line).len()).sum();
    let title = format!("Study: {}", study["title"].as_str().unwrap_or("a case"));
    let content = html! {
        header {
            h1 { (title) }
            p class="lead" { "fretting " (env!("CARGO_PKG_VERSION")) " · " (levels) " levels" }
        }
        (chapter("Which resolution to choose", &html! {
            @for line in study["choice"].as_str().unwrap_or_default().lines() { p { (line) } }
            (measured_by(&study))
        }))
        @for line in &lines { (refined(line)) }
        (unsolved(&study))
    };
    Ok((whole_page(&title, &content), levels))
}

fn levels(line: &Value) -> Vec<&Value> {
    line["levels"].as_array().into_iter().flatten().collect()
}

/// What the error of each quantity is measured by.
fn measured_by(study: &Value) -> Markup {
    let rows: Vec<Vec<String>> = study["measured_by"]
        .as_object()
        .into_iter()
        .flatten()
        .filter_map(|(name, by)| {
            // value and tolerance at the end of every stage: the last one
            let reference = study["references"][name].as_array()?.last()?[0].as_f64()?;
            let by = study["closed_form"].as_str().filter(|_| by == "closed_form").map_or_else(
                || by.as_str().unwrap_or("–").replace('_', " "),
                |form| format!("closed form: {form}"),
            );
            Some(vec![name.replace('_', " "), super::html::number(reference), by])
        })
        .collect();
    html! { @if !rows.is_empty() { (table(&["quantity", "reference at the end", "errors against"], &rows)) } }
}

/// A line of levels: charts of its errors, and its table.
fn refined(line: &Value) -> Markup {
    let levels = levels(line);
    let kind = line["refined"].as_str().unwrap_or_default();
    let resolution = |level: &Value| match kind {
        "increments" => largest(&level["increments"]),
        "tolerance" => level["tolerance"].as_f64().unwrap_or(f64::NAN),
        _ => level["cells"][0].as_f64().unwrap_or(f64::NAN),
    };
    let names: Vec<String> = levels
        .iter()
        .flat_map(|level| level["errors"].as_object().into_iter().flatten())
        .filter(|(_, error)| error.as_f64().is_some())
        .map(|(name, _)| name.clone())
        .fold(Vec::new(), |mut names, name| {
            if !names.contains(&name) {
                names.push(name);
            }
            names
        });
    let over = |of: &dyn Fn(&Value) -> f64| -> Vec<Curve> {
        let curve = |(place, name): (usize, &String)| {
            let at = |level: &&Value| Some([of(level), level["errors"][name].as_f64()?]);
            let mut points: Vec<[f64; 2]> = levels.iter().filter_map(at).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let dots = Curve {
                points: points.clone(),
                name: None,
                colour: place % 6,
                stroke: Stroke::Dots,
                id: None,
            };
            [Curve::line(points, &name.replace('_', " "), place % 6), dots]
        };
        names.iter().enumerate().flat_map(curve).collect()
    };
    let chart = |label: Label, curves: Vec<Curve>| Chart {
        logarithmic: true,
        ..Chart::new("relative error of the levels", [label, Label::plain("relative error")], curves)
    };
    let what = match kind {
        "increments" => "increments per stage or cycle",
        "tolerance" => "tolerance",
        _ => "cells along x",
    };
    let seconds = |level: &Value| level["wall_s"].as_f64().unwrap_or(f64::NAN);
    let figures = [
        figure_of(
            &chart(Label::plain(what), over(&resolution)).in_page(),
            "Error of every quantity over the resolution.",
        ),
        figure_of(
            &chart(Label { name: "time".to_owned(), unit: Some("s".to_owned()) }, over(&seconds)).in_page(),
            "The same over the time that the level took.",
        ),
    ];
    let body = html! {
        @if !names.is_empty() && levels.len() > 1 { (side_by_side(&figures)) }
        (rows(&levels, &names))
    };
    chapter(&format!("Refined: {}", kind.replace("together", "cells and increments together")), &body)
}

fn rows(levels: &[&Value], names: &[String]) -> Markup {
    let mut head =
        vec!["cells".to_owned(), "increments".to_owned(), "tolerance".to_owned(), "time [s]".to_owned()];
    for name in names {
        head.extend([name.replace('_', " "), "order".to_owned()]);
    }
    let rows: Vec<Vec<String>> = levels
        .iter()
        .map(|level| {
            let mut row = vec![
                format!("{} x {}", level["cells"][0], level["cells"][1]),
                increments(&level["increments"]),
                level["tolerance"].as_f64().map_or(String::new(), |value| format!("{value:.0e}")),
                level["wall_s"].as_f64().map_or(String::new(), |value| format!("{value:.3}")),
            ];
            for name in names {
                row.push(
                    level["errors"][name].as_f64().map_or("–".to_owned(), |error| format!("{error:.1e}")),
                );
                row.push(
                    level["orders"][name].as_f64().map_or("–".to_owned(), |order| format!("{order:.1}")),
                );
            }
            row
        })
        .collect();
    table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &rows)
}

fn increments(counts: &Value) -> String {
    let mut counts: Vec<String> = counts.as_array().into_iter().flatten().map(ToString::to_string).collect();
    if counts.windows(2).all(|pair| pair[0] == pair[1]) {
        counts.truncate(1);
    }
    counts.join("/")
}

fn largest(counts: &Value) -> f64 {
    counts.as_array().into_iter().flatten().filter_map(Value::as_f64).fold(0.0, f64::max)
}

fn unsolved(study: &Value) -> Markup {
    let levels: Vec<&Value> = study["unsolved"].as_array().into_iter().flatten().collect();
    html! {
        @if !levels.is_empty() {
            (chapter("Levels that were not solved", &html! {
                ul class="out" {
                    @for level in levels {
                        li { (level["cells"][0]) " x " (level["cells"][1]) " cells, " (increments(&level["increments"])) " increments: " (level["message"].as_str().unwrap_or_default()) }
                    }
                }
            }))
        }
    }
}
