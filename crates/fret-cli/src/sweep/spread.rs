//! What the samples of a sweep say: statistics and Sobol' indices of its numbers, as `uncertainty.json` and as a table.

use std::fmt::Write;

use fret_core::uncertainty::{QUANTILES, SampleDesign, Sensitivity, Statistics, sensitivity, statistics};
use serde_json::{Map, Value, json};

use crate::figures::figure;

/// Width of the names on the left.
const NAMES: usize = 32;
/// Width of a column of numbers.
const COLUMN: usize = 13;

/// A number that varies by less, relative, does not: the last digits of a prescribed force.
const ROUNDING: f64 = 1e-13;

/// A number of the answers.
struct Quantity {
    name: String,
    statistics: Statistics,
    /// One for each key, where they were asked for and the number varies.
    indices: Option<Vec<Sensitivity>>,
}

impl Quantity {
    /// Whether the number varies by more than rounding.
    fn varies(&self) -> bool {
        let Statistics { deviation, min, max, .. } = self.statistics;
        // what is endless in some samples has no deviation, and varies
        deviation > ROUNDING * min.abs().max(max.abs()) || min < max && (max - min).is_infinite()
    }
}

/// What the samples say about every number of the answers, at each point of the axes beside them.
pub struct Spread<'a> {
    keys: &'a [String],
    design: &'a SampleDesign,
    points: Vec<AtPoint>,
}

/// Values of the keys that are not drawn, with their names.
type Values = Vec<(String, toml::Value)>;

/// The samples at one point of the axes.
struct AtPoint {
    values: Values,
    quantities: Vec<Quantity>,
}

impl<'a> Spread<'a> {
    /// Of columns of numbers, all samples of the first point, then of the next; what is missing is not a number. `at`: the values of the
    /// points, empty ones where there is no axis.
    pub fn new(
        keys: &'a [String],
        design: &'a SampleDesign,
        at: Vec<Values>,
        columns: &'a [(String, Vec<f64>)],
    ) -> Self {
        let own = if design.indices { 2 * design.count } else { design.count };
        let each = design.points();
        let quantity = |(name, values): (&String, &[f64])| {
            let statistics = statistics(&values[..own.min(values.len())])?;
            let mut quantity = Quantity { name: name.clone(), statistics, indices: None };
            if design.indices && quantity.varies() {
                quantity.indices = sensitivity(values, design.count);
            }
            Some(quantity)
        };
        let at_point = |(place, values): (usize, Values)| {
            let part = |values: &'a [f64]| values.chunks(each).nth(place).unwrap_or_default();
            let columns = columns.iter().map(|(name, values)| (name, part(values)));
            AtPoint { values, quantities: columns.filter_map(quantity).collect() }
        };
        Self { keys, design, points: at.into_iter().enumerate().map(at_point).collect() }
    }

    /// For `uncertainty.json`: `quantities`, or with axes `points`, each with its `values` and its `quantities`.
    pub fn to_json(&self) -> Value {
        let quantities = |point: &AtPoint| -> Value {
            let mut quantities = Map::new();
            for Quantity { name, statistics, indices } in &point.quantities {
                let mut entry = json!(statistics);
                if let Some(indices) = indices {
                    entry["sobol_indices"] = self
                        .keys
                        .iter()
                        .zip(indices)
                        .map(|(key, index)| (key.clone(), json!(index)))
                        .collect();
                }
                quantities.insert(name.clone(), entry);
            }
            quantities.into()
        };
        let keys = self.keys.iter().zip(&self.design.distributions);
        let mut told = json!({
            "count": self.design.count,
            "seed": self.design.seed,
            "indices": self.design.indices,
            "distributions": keys.map(|(key, of)| (key.clone(), json!(of))).collect::<Map<_, _>>(),
            "quantile_fractions": QUANTILES,
        });
        match &self.points[..] {
            [only] if only.values.is_empty() => told["quantities"] = quantities(only),
            points => {
                let points = points.iter().map(|point| {
                    let values = point.values.iter().map(|(key, value)| (key.clone(), json!(value)));
                    json!({"values": values.collect::<Map<_, _>>(), "quantities": quantities(point)})
                });
                told["points"] = points.collect();
            }
        }
        told
    }

    /// For a person: the numbers that vary, point by point.
    pub fn table(&self) -> String {
        let parts = self.points.iter().map(|point| {
            let value = |(key, value): &(String, toml::Value)| format!("{key} = {value}");
            let head = point.values.iter().map(value).collect::<Vec<_>>().join(", ");
            if head.is_empty() { self.part(point) } else { format!("{head}\n{}", self.part(point)) }
        });
        parts.collect::<Vec<_>>().join("\n\n")
    }

    fn part(&self, point: &AtPoint) -> String {
        let varying = || point.quantities.iter().filter(|quantity| quantity.varies());
        let samples = varying().map(|quantity| quantity.statistics.count).max().unwrap_or(0);
        let mut table = format!("{:<NAMES$}", format!("{samples} samples"));
        for head in ["mean", "deviation", "2.5 %", "median", "97.5 %"] {
            let _ = write!(table, "{head:<COLUMN$}");
        }
        table.truncate(table.trim_end().len());
        table.push('\n');
        for Quantity { name, statistics, .. } in varying() {
            let [low, _, median, _, high] = statistics.quantiles;
            let _ = write!(table, "{name:<NAMES$}");
            for value in [statistics.mean, statistics.deviation, low, median, high] {
                let word = match value {
                    f64::INFINITY => "unlimited".to_owned(),
                    value if value.is_nan() => "-".to_owned(),
                    value => figure(value),
                };
                let _ = write!(table, "{word:<COLUMN$}");
            }
            table.truncate(table.trim_end().len());
            table.push('\n');
        }
        if self.design.indices {
            table.push_str("\nSobol' indices, first order and total\n");
            for Quantity { name, indices, .. } in varying() {
                let Some(indices) = indices else { continue };
                for (key, index) in self.keys.iter().zip(indices) {
                    let _ =
                        writeln!(table, "{name:<NAMES$}{key:<34} {:>6.3} {:>6.3}", index.first, index.total);
                }
            }
        }
        table.truncate(table.trim_end().len());
        table
    }
}
