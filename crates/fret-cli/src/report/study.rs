//! A study of refinement in one page: which resolution to choose, the error of every quantity over the cells and the increments, and over
//! the time that a level took. Read back from `study.json`.

use std::path::Path;
use std::slice;

use fret_core::model::Dimension;
use fret_core::study::{Convergence, Kind, Source};
use maud::{Markup, html};

use super::{chapter, grid, number, read_answer, side_by_side, table, whole_page};
use crate::failure::Failure;
use crate::study::record::{LevelRecord, LineRecord, StudyRecord, UnsolvedRecord};
use crate::study::table::{ErrorColumn, columns, increments, kind_name};
use fret_drawing::{Chart, Curve, Label};

/// Curves of a chart, at the most: each has a colour of its own.
const COLOURS: usize = 6;

/// The answer of a study, which marks its folder.
pub const STUDY: &str = "study.json";

/// The page of a study, and how many levels it has.
///
/// # Errors
/// When the answer of the study cannot be read.
pub fn page(folder: &Path) -> Result<(String, usize), Failure> {
    let study: StudyRecord = read_answer(&folder.join(STUDY), "run `fret study` again")?;
    let levels = study.lines.iter().map(|line| line.levels.len()).sum();
    let title = format!("Study: {}", study.title);
    let content = html! {
        header {
            h1 { (title) }
            p class="lead" { "fretting " (env!("CARGO_PKG_VERSION")) " · " (levels) " levels" }
        }
        (chapter("Which resolution to choose", &html! {
            @for line in study.choice.lines() { p { (line) } }
            (measured_by(&study))
        }))
        @for line in &study.lines { (refined(&study, line)) }
        (unsolved(&study.unsolved))
    };
    Ok((whole_page(&title, &content), levels))
}

/// The name of a quantity, as a person reads it: a line contact has widths in place of areas.
fn in_words(name: &str, dimension: Dimension) -> String {
    name.replace("area", dimension.area()).replace('_', " ")
}

/// What the error of each quantity is measured by.
fn measured_by(study: &StudyRecord) -> Markup {
    let level = study.lines.iter().flat_map(|line| &line.levels).next();
    let dimension = level.map_or(Dimension::Plane, |level| Dimension::of(level.cells));
    let row = |(name, source): (&String, &Option<Source>)| {
        let [reference, _] = study.references.get(name)?.last().copied()??;
        let by = match (source, &study.closed_form) {
            (Some(Source::ClosedForm), Some(form)) => format!("closed form: {form}"),
            (Some(Source::ClosedForm), None) => "closed form".to_owned(),
            (Some(Source::Given), _) => "given".to_owned(),
            (Some(Source::Limit), _)
                if study.convergence.get(name) == Some(&Some(Convergence::TwoLevels)) =>
            {
                "whole difference of two levels".to_owned()
            }
            (Some(Source::Limit), _) => "limit".to_owned(),
            (Some(Source::Finest), _) => "finest".to_owned(),
            (None, _) => "–".to_owned(),
        };
        Some(vec![in_words(name, dimension), number(reference), by])
    };
    let rows: Vec<Vec<String>> = study.measured_by.iter().filter_map(row).collect();
    html! { @if !rows.is_empty() { (table(&["quantity", "reference at the end", "errors against"], &rows)) } }
}

/// A line of levels: charts of its errors, and its table.
fn refined(study: &StudyRecord, line: &LineRecord) -> Markup {
    let LineRecord { refined, levels } = line;
    let resolution = |level: &LevelRecord| match refined {
        Kind::Increments => level.increments.iter().copied().max().unwrap_or(0) as f64,
        Kind::Tolerance => level.tolerance,
        Kind::Cells | Kind::Together => level.cells[0] as f64,
    };
    let known = ErrorColumn::known(slice::from_ref(line));
    let over = |of: &dyn Fn(&LevelRecord) -> f64| -> Vec<Curve> {
        let curve = |(place, column): (usize, &ErrorColumn)| {
            let at = |level: &LevelRecord| Some([of(level), column.of(level)[0]?]);
            let mut points: Vec<[f64; 2]> = levels.iter().filter_map(at).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            Curve::line(points, &column.name, place).dotted()
        };
        known.iter().take(COLOURS).enumerate().flat_map(curve).collect()
    };
    let figure = |axis: Label, of: &dyn Fn(&LevelRecord) -> f64, caption: &str| {
        let axes = [axis, Label::plain("relative error")];
        let chart = Chart::new("relative error of the levels", axes, over(of));
        Chart { logarithmic: true, ..chart }.figure(caption)
    };
    let what = match refined {
        Kind::Increments => "increments per stage or cycle",
        Kind::Tolerance => "tolerance",
        Kind::Cells | Kind::Together => "cells along x",
    };
    let time = Label::with("time", Some("s".to_owned()));
    let figures = [
        figure(Label::plain(what), &resolution, "Error of every quantity over the resolution."),
        figure(time, &|level| level.wall_s, "The same over the time that the level took."),
    ];
    let body = html! {
        @if !known.is_empty() && levels.len() > 1 { (side_by_side(&figures)) }
        (grid(&columns(study, &known), levels.iter().enumerate(), |value, _| value.to_string()))
    };
    chapter(&format!("Refined: {}", kind_name(*refined)), &body)
}

fn unsolved(levels: &[UnsolvedRecord]) -> Markup {
    html! {
        @if !levels.is_empty() {
            (chapter("Levels that were not solved", &html! {
                ul class="out" {
                    @for UnsolvedRecord { cells, increments: counts, message } in levels {
                        li { (Dimension::of(*cells).written(*cells)) " cells, " (increments(counts)) " increments: " (message) }
                    }
                }
            }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_contact_has_widths_and_cells_along_x() {
        assert_eq!(in_words("contact_area", Dimension::Plane), "contact area");
        assert_eq!(in_words("stick_area", Dimension::Line), "stick width");
        assert_eq!(in_words("max_pressure", Dimension::Line), "max pressure");
    }
}
