//! A judged study as a table for a person, for a page, and as CSV.

use fret_core::model::Dimension;
use fret_core::study::{Convergence, Kind, Quantity};

use crate::study::record::{LevelRecord, LineRecord, OfQuantities, StudyRecord};
use crate::table::Columns;

/// What the errors of the fields are called.
const PRESSURE: &str = "pressure L2";
const SHEAR: &str = "shear L2";
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

/// Errors with their orders: what they are of, and both of a level.
pub struct ErrorColumn {
    /// What they are of, in words.
    pub name: String,
    /// The quantity of interest; none of fields, whose error is that of the mean square.
    quantity: Option<Quantity>,
}

impl ErrorColumn {
    /// Those of which some level has an error.
    pub fn known(lines: &[LineRecord]) -> Vec<Self> {
        let levels = || lines.iter().flat_map(|line| &line.levels);
        let dimension = levels().next().map_or(Dimension::Plane, |level| Dimension::of(level.cells));
        let quantities = Quantity::ALL.map(|of| Self { name: of.in_words(dimension), quantity: Some(of) });
        let fields = [PRESSURE, SHEAR].map(|name| Self { name: name.to_owned(), quantity: None });
        let is_known = |column: &Self| levels().any(|level| column.of(level)[0].is_some());
        quantities.into_iter().chain(fields).filter(is_known).collect()
    }

    /// Whether it is that of a quantity.
    pub fn is_of(&self, quantity: Quantity) -> bool {
        self.quantity == Some(quantity)
    }

    /// Error and order of a level.
    pub fn of(&self, level: &LevelRecord) -> [Option<f64>; 2] {
        match self.quantity {
            Some(of) => [&level.errors, &level.orders].map(|all| all.get(of.name()).copied().flatten()),
            None if self.name == PRESSURE => [level.error_of_pressure, level.order_of_pressure],
            None => [level.error_of_shear, level.order_of_shear],
        }
    }
}

/// A level, and its number in its line, from 0.
type Row<'a> = (usize, &'a LevelRecord);

/// What is told of the levels of a line.
pub fn columns<'a>(study: &'a StudyRecord, known: &'a [ErrorColumn]) -> Columns<'a, Row<'a>> {
    let columns = Columns::<Row<'a>>::new()
        .column("cells", "", |(_, level)| Dimension::of(level.cells).written(level.cells))
        .column("increments", "", |(_, level)| increments(&level.increments))
        .column("tolerance", "", |(_, level)| format!("{:.0e}", level.tolerance))
        .column("time [s]", "", |(_, level)| format!("{:.3}", level.wall_s))
        .column("convolutions", "", |(_, level)| level.work.convolutions);
    known.iter().fold(columns, |columns, column| {
        let convergence = column.quantity.and_then(|of| study.convergence.get(of.name()).copied().flatten());
        let shows_none = convergence.is_some_and(|convergence| convergence != Convergence::Observed);
        let shown = |value: f64| if value < ROUNDING { "0".to_owned() } else { format!("{value:.1e}") };
        columns
            .column(column.name.as_str(), "", move |(_, level)| {
                column.of(level)[0].map_or("-".to_owned(), shown)
            })
            .column("order", "", move |(number, level)| {
                let none = if *number > 0 && shows_none { "-" } else { "" };
                column.of(level)[1].map_or(none.to_owned(), |order| format!("{order:.1}"))
            })
    })
}

/// The table: one block per refined quantity. `*` marks levels that no other level beats in work and in its largest error; `-` stands
/// for an order that the levels do not show.
pub fn table(study: &StudyRecord) -> String {
    let known = ErrorColumn::known(&study.lines);
    let columns = columns(study, &known);
    let row = |mark: &str, cells: Vec<String>| -> String {
        let [cells, increments, tolerance, time, convolutions, errors @ ..] = &cells[..] else {
            return String::new();
        };
        let pair = |pair: &[String]| match pair[1].as_str() {
            "order" => format!("{:>COLUMN$}", pair[0]),
            order => format!("{:>13} {order:>5}", pair[0]),
        };
        let errors: String = errors.chunks_exact(2).map(pair).collect();
        let row =
            format!("{mark} {cells:<10}{increments:>11}{tolerance:>10}{time:>10}{convolutions:>13}{errors}");
        row.trim_end().to_owned()
    };
    let blocks = study.lines.iter().map(|line| {
        let head = row(" ", columns.names().into_iter().map(str::to_owned).collect());
        let levels = line.levels.iter().enumerate().map(|level| {
            let mark = if level.1.is_efficient { "*" } else { " " };
            row(mark, columns.cells(&level, |_, value, _| value.to_string()))
        });
        let heads = [format!("refined: {}", kind_name(line.refined)), head];
        heads.into_iter().chain(levels).collect::<Vec<_>>().join("\n")
    });
    let mut table = blocks.collect::<Vec<_>>().join("\n\n");
    if !known.is_empty() {
        table.push_str("\n\nerrors are relative, each followed by the observed order against the row above; * no other level takes less work and is more accurate");
    }
    table
}

/// A row a level of every line. Errors are relative and empty where nothing is known; `_plain` as the cells have the number,
/// `_extrapolated` with the next coarser grid; `order_` against the row before in the same line.
pub fn csv(lines: &[LineRecord]) -> String {
    let mut columns = Columns::<(Kind, &LevelRecord)>::new()
        .column("refined", "", |(kind, _)| kind_key(*kind))
        .column("nx", "", |(_, level)| level.cells[0])
        .column("ny", "", |(_, level)| level.cells[1])
        .column("increments", "", |(_, level)| increments(&level.increments))
        .column("tolerance", "", |(_, level)| level.tolerance)
        .column("wall_s", "", |(_, level)| level.wall_s)
        .column("convolutions", "", |(_, level)| level.work.convolutions)
        .column("full_grid_convolutions", "", |(_, level)| level.work.full_grid_convolutions.to_string())
        .column("efficient", "", |(_, level)| level.is_efficient.to_string())
        .column("efficient_plain", "", |(_, level)| level.is_efficient_otherwise[0].to_string())
        .column("efficient_extrapolated", "", |(_, level)| level.is_efficient_otherwise[1].to_string());
    for name in Quantity::ALL.map(Quantity::name) {
        let of = move |all: &OfQuantities<Option<f64>>| all.get(name).copied().flatten();
        columns = columns
            .column(name, "", move |(_, level)| of(&level.errors))
            .column(format!("{name}_plain"), "", move |(_, level)| of(&level.errors_plain))
            .column(format!("{name}_extrapolated"), "", move |(_, level)| of(&level.errors_extrapolated))
            .column(format!("order_{name}"), "", move |(_, level)| of(&level.orders));
    }
    let columns = columns
        .column("pressure_l2", "", |(_, level)| level.error_of_pressure)
        .column("order_pressure_l2", "", |(_, level)| level.order_of_pressure)
        .column("shear_l2", "", |(_, level)| level.error_of_shear)
        .column("order_shear_l2", "", |(_, level)| level.order_of_shear);
    columns.csv(None, lines.iter().flat_map(|line| line.levels.iter().map(|level| (line.refined, level))))
}

/// A kind in files.
fn kind_key(kind: Kind) -> String {
    serde_json::to_value(kind).ok().and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}
