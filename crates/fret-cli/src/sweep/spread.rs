//! What the samples of a sweep say: statistics and Sobol' indices of its numbers, as `uncertainty.json` and as a table.

use std::collections::BTreeMap;
use std::fmt::Write;

use fret_core::uncertainty::{
    Distribution, QUANTILES, SampleDesign, Sensitivity, Statistics, sensitivity, statistics,
};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::table::Columns;

/// Width of the names on the left.
const NAMES: usize = 32;
/// Widths of the columns of the table.
const WIDTHS: [usize; 5] = [NAMES - 1, 12, 12, 12, 12];

/// A number that varies by less, relative, does not: the last digits of a prescribed force.
const ROUNDING: f64 = 1e-13;

/// `uncertainty.json`. What is written is what the page of the sweep reads back.
#[derive(Debug, Serialize, Deserialize)]
pub struct SpreadRecord {
    /// Samples of one block.
    pub count: usize,
    /// The seed of their points.
    pub seed: u32,
    /// Whether there are blocks for Sobol' indices.
    pub indices: bool,
    /// What each key was drawn from.
    pub distributions: BTreeMap<String, Distribution>,
    /// Fractions below the quantiles.
    pub quantile_fractions: [f64; 5],
    /// The numbers of the answers; nothing of a sweep with axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quantities: Option<Quantities>,
    /// The points of the axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<PointRecord>>,
}

/// The samples at one point of the axes.
#[derive(Debug, Serialize, Deserialize)]
pub struct PointRecord {
    /// Values of the keys that are not drawn.
    pub values: BTreeMap<String, Value>,
    /// The numbers of the answers.
    pub quantities: Quantities,
}

/// Numbers of the answers by their names.
pub type Quantities = BTreeMap<String, QuantityRecord>;

/// What the samples say of a number.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct QuantityRecord {
    /// Its statistics.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Its Sobol' indices by key, where they were asked for and it varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sobol_indices: Option<BTreeMap<String, Sensitivity>>,
}

/// A number of statistics, by its name.
type Read = (&'static str, fn(&Statistics) -> f64);

impl QuantityRecord {
    /// What is told of numbers by their names, the first column under a head of its own; a name in words as it is `called`.
    pub fn columns<'a>(head: String, called: impl Fn(&str) -> String + 'a) -> Columns<'a, (String, Self)> {
        let reads: [Read; 5] = [
            ("mean", |of| of.mean),
            ("deviation", |of| of.deviation),
            ("2.5 %", |of| of.quantiles[0]),
            ("median", |of| of.quantiles[2]),
            ("97.5 %", |of| of.quantiles[4]),
        ];
        let name = Columns::new().column(head, "", move |(name, _): &(String, Self)| called(name));
        reads
            .into_iter()
            .fold(name, |columns, (name, read)| columns.column(name, "", move |(_, of)| read(&of.statistics)))
    }
}

/// A number of all samples.
pub struct Sampled {
    /// Its name.
    pub name: String,
    /// The same with its unit.
    pub heading: String,
    /// Its values; what is missing is not a number.
    pub numbers: Vec<f64>,
}

/// What the samples say about every number of the answers, at each point of the axes beside them.
pub struct Spread<'a> {
    keys: &'a [String],
    design: &'a SampleDesign,
    columns: &'a [Sampled],
    points: Vec<AtPoint>,
}

/// Values of the keys that are not drawn, with their names.
type Values = Vec<(String, toml::Value)>;

/// The samples at one point of the axes.
struct AtPoint {
    /// The same in words.
    place: String,
    values: Values,
    /// Numbers of the answers, in the order of their columns.
    quantities: Vec<(String, QuantityRecord)>,
}

impl<'a> Spread<'a> {
    /// Of columns of numbers, all samples of the first point, then of the next. `at`: the values of the
    /// points, in words and as they are, empty ones where there is no axis.
    pub fn new(
        keys: &'a [String],
        design: &'a SampleDesign,
        at: Vec<(String, Values)>,
        columns: &'a [Sampled],
    ) -> Self {
        let own = if design.indices { 2 * design.count } else { design.count };
        let each = design.points();
        let quantity = |(name, values): (&String, &[f64])| {
            let statistics = statistics(&values[..own.min(values.len())])?;
            let asked = design.indices && statistics.varies(ROUNDING);
            let indices = asked.then(|| sensitivity(values, design.count)).flatten();
            let sobol_indices = indices.map(|indices| keys.iter().cloned().zip(indices).collect());
            Some((name.clone(), QuantityRecord { statistics, sobol_indices }))
        };
        let at_point = |(number, (place, values)): (usize, (String, Values))| {
            let part = |values: &'a [f64]| values.chunks(each).nth(number).unwrap_or_default();
            let parts = columns.iter().map(|column| (&column.name, part(&column.numbers)));
            AtPoint { place, values, quantities: parts.filter_map(quantity).collect() }
        };
        Self { keys, design, columns, points: at.into_iter().enumerate().map(at_point).collect() }
    }

    /// For `uncertainty.json`.
    pub fn record(&self) -> SpreadRecord {
        let quantities = |point: &AtPoint| -> Quantities { point.quantities.iter().cloned().collect() };
        let point = |point: &AtPoint| {
            let values = point.values.iter().map(|(key, value)| (key.clone(), json!(value)));
            PointRecord { values: values.collect(), quantities: quantities(point) }
        };
        let alone = match &self.points[..] {
            [only] if only.values.is_empty() => Some(quantities(only)),
            _ => None,
        };
        let SampleDesign { distributions, count, seed, indices } = self.design;
        SpreadRecord {
            count: *count,
            seed: *seed,
            indices: *indices,
            distributions: self.keys.iter().cloned().zip(distributions.iter().copied()).collect(),
            quantile_fractions: QUANTILES,
            points: alone.is_none().then(|| self.points.iter().map(point).collect()),
            quantities: alone,
        }
    }

    /// For a person: the numbers that vary, point by point.
    pub fn table(&self) -> String {
        let parts = self.points.iter().map(|point| {
            let part = self.part(point);
            if point.place.is_empty() { part } else { format!("{}\n{part}", point.place) }
        });
        parts.collect::<Vec<_>>().join("\n\n")
    }

    fn part(&self, point: &AtPoint) -> String {
        let varying = || point.quantities.iter().filter(|(_, of)| of.statistics.varies(ROUNDING));
        let samples = varying().map(|(_, of)| of.statistics.count).max().unwrap_or(0);
        let with_unit = |name: &str| {
            let column = self.columns.iter().find(|column| column.name == name);
            column.map_or(name, |column| &column.heading).to_owned()
        };
        let columns = QuantityRecord::columns(format!("{samples} samples"), with_unit);
        let mut table = columns.text(&WIDTHS, None, varying());
        if self.design.indices {
            table.push_str("\nSobol' indices, first order and total\n");
            for (name, of) in varying() {
                let Some(indices) = &of.sobol_indices else { continue };
                for (key, index) in self.keys.iter().filter_map(|key| indices.get_key_value(key)) {
                    let _ =
                        writeln!(table, "{name:<NAMES$}{key:<34} {:>6.3} {:>6.3}", index.first, index.total);
                }
            }
        }
        table.truncate(table.trim_end().len());
        table
    }
}
