//! A judged study as a table for a person and as CSV.

use std::fmt::Write;

use fret_core::model::Dimension;
use fret_core::study::{Convergence, Errors, Form, Judged, Kind, Line, Quantity, Reference, RefinementStudy};

use crate::study::words::name;

/// Width of a column of errors.
const COLUMN: usize = 19;
/// Errors below this are rounding: a level that is its own measure, or a refinement that changes nothing.
const ROUNDING: f64 = 1e-12;

/// What a line refines, in words.
pub fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Cells => "cells",
        Kind::Increments => "increments",
        Kind::Together => "cells and increments together",
        Kind::Tolerance => "tolerance",
    }
}

/// Increments of the stages: one number where all are alike.
pub fn increments(counts: &[usize]) -> String {
    if counts.windows(2).all(|pair| pair[0] == pair[1]) {
        counts.first().map_or(String::new(), ToString::to_string)
    } else {
        counts.iter().map(ToString::to_string).collect::<Vec<_>>().join("/")
    }
}

/// Errors with their orders in the order of the columns, fields last.
fn columns(judged: &Judged) -> Vec<(Option<f64>, Option<f64>)> {
    let Errors { between, pressure, shear, .. } = &judged.errors;
    between
        .iter()
        .copied()
        .zip(judged.orders)
        .chain([*pressure, *shear].into_iter().zip(judged.field_orders))
        .collect()
}

/// Whether any error is known.
pub fn shows_errors(lines: &[Line]) -> bool {
    let judged = lines.iter().flat_map(|line| &line.levels);
    judged.flat_map(columns).any(|(error, _)| error.is_some())
}

/// Whether any error of a quantity is known: whether it has a column.
pub fn shows_errors_of(lines: &[Line], quantity: Quantity) -> bool {
    let mut judged = lines.iter().flat_map(|line| &line.levels);
    judged.any(|level| columns(level)[quantity as usize].0.is_some())
}

/// The table: one block per refined quantity. `*` marks levels that no other level beats in work and in its largest error; `-` stands
/// for an order that the levels do not show.
pub fn table(study: &RefinementStudy, lines: &[Line], reference: &Reference) -> String {
    let shows_none = |column: usize| {
        let quantity = Quantity::ALL.get(column);
        quantity.is_some_and(|quantity| reference.convergence(*quantity) != Convergence::Observed)
    };
    let levels = lines.iter().flat_map(|line| &line.levels);
    let cells =
        levels.filter_map(|judged| study.level(judged.place)).map(|level| level.variation.cells).next();
    let dimension = cells.map_or(Dimension::Plane, Dimension::of);
    let mut names: Vec<&str> = Quantity::ALL.into_iter().map(|quantity| name(quantity, dimension)).collect();
    names.extend(["pressure L2", "shear L2"]);
    let known: Vec<usize> = (0..names.len())
        .filter(|column| {
            lines.iter().flat_map(|line| &line.levels).any(|level| columns(level)[*column].0.is_some())
        })
        .collect();
    let mut table = String::new();
    for line in lines {
        let _ = writeln!(table, "refined: {}", kind_name(line.kind));
        let _ = write!(
            table,
            "{:<12}{:>11}{:>10}{:>10}{:>13}",
            "  cells", "increments", "tolerance", "time [s]", "convolutions"
        );
        for column in &known {
            let _ = write!(table, "{:>COLUMN$}", names[*column]);
        }
        table.push('\n');
        for (row, judged) in line.levels.iter().enumerate() {
            let Some(level) = study.level(judged.place) else { continue };
            let _ = write!(
                table,
                "{} {:<10}{:>11}{:>10.0e}{:>10.3}{:>13}",
                if judged.is_efficient[Form::Between as usize] { '*' } else { ' ' },
                dimension.written(level.variation.cells),
                increments(&level.variation.increments),
                level.variation.tolerance,
                level.wall_s,
                level.work.convolutions
            );
            let columns = columns(judged);
            for column in &known {
                let (error, order) = columns[*column];
                let error = error.map_or("-".to_owned(), |error| {
                    if error < ROUNDING { "0".to_owned() } else { format!("{error:.1e}") }
                });
                let none = if row > 0 && shows_none(*column) { "-" } else { "" };
                let order = order.map_or(none.to_owned(), |order| format!("{order:.1}"));
                let _ = write!(table, "{error:>13} {order:>5}");
            }
            table.truncate(table.trim_end().len());
            table.push('\n');
        }
        table.push('\n');
    }
    if known.is_empty() {
        table.truncate(table.trim_end().len());
        return table;
    }
    table.push_str("errors are relative, each followed by the observed order against the row above; * no other level takes less work and is more accurate");
    table
}

/// A row a level of every line. Errors are relative and empty where nothing is known; `_plain` as the cells have the number,
/// `_extrapolated` with the next coarser grid; `order_` against the row before in the same line.
pub fn csv(study: &RefinementStudy, lines: &[Line]) -> String {
    let mut text = String::from(
        "refined,nx,ny,increments,tolerance,wall_s,convolutions,full_grid_convolutions,efficient,efficient_plain,efficient_extrapolated",
    );
    for quantity in Quantity::ALL {
        let name = quantity.name();
        let _ = write!(text, ",{name},{name}_plain,{name}_extrapolated,order_{name}");
    }
    text.push_str(",pressure_l2,order_pressure_l2,shear_l2,order_shear_l2\n");
    let shown = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
    for line in lines {
        for judged in &line.levels {
            let Some(level) = study.level(judged.place) else { continue };
            let [nx, ny] = level.variation.cells;
            let [plain, between, extrapolated] = judged.is_efficient;
            let _ = write!(
                text,
                "{},{nx},{ny},{},{:e},{:e},{},{},{between},{plain},{extrapolated}",
                kind_key(line.kind),
                increments(&level.variation.increments),
                level.variation.tolerance,
                level.wall_s,
                level.work.convolutions,
                level.work.full_grid_convolutions
            );
            for quantity in Quantity::ALL {
                let number = quantity as usize;
                for form in [Form::Between, Form::Plain, Form::Extrapolated] {
                    let _ = write!(text, ",{}", shown(judged.errors.of(form)[number]));
                }
                let _ = write!(text, ",{}", shown(judged.orders[number]));
            }
            for (error, order) in
                [judged.errors.pressure, judged.errors.shear].into_iter().zip(judged.field_orders)
            {
                let _ = write!(text, ",{},{}", shown(error), shown(order));
            }
            text.push('\n');
        }
    }
    text
}

/// A kind in files.
fn kind_key(kind: Kind) -> String {
    serde_json::to_value(kind).ok().and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}
