//! What the samples of a sweep say: statistics and Sobol' indices of its numbers, as `uncertainty.json` and as a table.

use std::collections::BTreeMap;
use std::fmt::Write;

use fret_core::uncertainty::{
    Distribution, QUANTILES, SampleDesign, Sensitivity, Statistics, sensitivity, statistics,
};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::sweep::Question;
use crate::sweep::columns::SummaryColumn;
use crate::sweep::setting::Setting;
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

/// The samples of a sweep, with the columns of their numbers: all samples of the first point of the axes, then of the next.
pub struct Spread<'a> {
    question: &'a Question,
    setting: &'a Setting,
    design: &'a SampleDesign,
    columns: Vec<&'a SummaryColumn>,
}

impl<'a> Spread<'a> {
    /// Of a sweep that has samples. Means and quantiles of lives of which some have no bound are none: such a column tells nothing.
    pub fn of(question: &'a Question, setting: &'a Setting, columns: &'a [SummaryColumn]) -> Option<Self> {
        let is_bounded = |column: &&SummaryColumn| column.numbers().iter().all(|value| !value.is_infinite());
        let columns = columns.iter().filter(is_bounded).collect();
        Some(Self { question, setting, design: question.design.as_ref()?, columns })
    }

    /// The points of the axes, by the keys that are not drawn; one without any where there is no axis.
    fn points(&self) -> impl Iterator<Item = Vec<(&String, &toml::Value)>> {
        let keys = &self.question.keys;
        let beside = &keys[..keys.len() - self.question.drawn_keys().len()];
        let firsts = self.question.points.iter().step_by(self.design.points().max(1));
        firsts.map(move |point| beside.iter().zip(&point.values).collect())
    }

    /// For `uncertainty.json`.
    pub fn record(&self) -> SpreadRecord {
        let SampleDesign { distributions, count, seed, indices } = self.design;
        let keys = self.question.drawn_keys();
        let own = if *indices { 2 * count } else { *count };
        let quantity = |(column, numbers): (&&SummaryColumn, &Vec<f64>), point: usize| {
            let values = numbers.chunks(self.design.points()).nth(point).unwrap_or_default();
            let statistics = statistics(&values[..own.min(values.len())])?;
            let asked = *indices && statistics.varies(ROUNDING);
            let found = asked.then(|| sensitivity(values, *count)).flatten();
            let sobol_indices = found.map(|indices| keys.iter().cloned().zip(indices).collect());
            Some((column.name.clone(), QuantityRecord { statistics, sobol_indices }))
        };
        let numbers: Vec<Vec<f64>> = self.columns.iter().map(|column| column.numbers()).collect();
        let at_point = |(point, values): (usize, Vec<(&String, &toml::Value)>)| PointRecord {
            values: values.into_iter().map(|(key, value)| (key.clone(), json!(value))).collect(),
            quantities: self.columns.iter().zip(&numbers).filter_map(|of| quantity(of, point)).collect(),
        };
        let mut points: Vec<PointRecord> = self.points().enumerate().map(at_point).collect();
        let alone = points.pop_if(|only| only.values.is_empty()).map(|only| only.quantities);
        SpreadRecord {
            count: *count,
            seed: *seed,
            indices: *indices,
            distributions: keys.iter().cloned().zip(distributions.iter().copied()).collect(),
            quantile_fractions: QUANTILES,
            points: alone.is_none().then_some(points),
            quantities: alone,
        }
    }

    /// A record for a person: the numbers that vary, point by point.
    pub fn table(&self, record: &SpreadRecord) -> String {
        let parts = record.points.iter().flatten().map(|point| &point.quantities).chain(&record.quantities);
        let part = |(place, quantities)| match self.setting.place(place) {
            place if place.is_empty() => self.part(quantities),
            place => format!("{place}\n{}", self.part(quantities)),
        };
        self.points().zip(parts).map(part).collect::<Vec<_>>().join("\n\n")
    }

    fn part(&self, quantities: &Quantities) -> String {
        let of = |column: &&SummaryColumn| {
            let (name, of) = quantities.get_key_value(&column.name)?;
            of.statistics.varies(ROUNDING).then(|| (name.clone(), of.clone()))
        };
        let varying: Vec<(String, QuantityRecord)> = self.columns.iter().filter_map(of).collect();
        let samples = varying.iter().map(|(_, of)| of.statistics.count).max().unwrap_or(0);
        let with_unit = |name: &str| {
            let column = self.columns.iter().find(|column| column.name == name);
            column.map_or_else(|| name.to_owned(), |column| self.setting.heading(column))
        };
        let columns = QuantityRecord::columns(format!("{samples} samples"), with_unit);
        let mut table = columns.text(&WIDTHS, None, &varying);
        if self.design.indices {
            table.push_str("\nSobol' indices, first order and total\n");
            for (name, of) in &varying {
                let Some(indices) = &of.sobol_indices else { continue };
                let keys = self.question.drawn_keys();
                for (key, index) in keys.iter().filter_map(|key| indices.get_key_value(key)) {
                    let _ =
                        writeln!(table, "{name:<NAMES$}{key:<34} {:>6.3} {:>6.3}", index.first, index.total);
                }
            }
        }
        table.truncate(table.trim_end().len());
        table
    }
}
