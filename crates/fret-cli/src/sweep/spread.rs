//! What the samples of a sweep say: statistics and Sobol' indices of its numbers, as `uncertainty.json` and as a table.

use std::fmt::Write;

use fret_core::uncertainty::{QUANTILES, SampleDesign, Sensitivity, Statistics, sensitivity, statistics};
use serde_json::{Map, Value, json};

use crate::figures::figure;

/// Width of the names on the left.
const NAMES: usize = 32;
/// Width of a column of numbers.
const COLUMN: usize = 13;

/// A number of the answers.
struct Quantity {
    name: String,
    statistics: Statistics,
    /// One for each key, where they were asked for and the number varies.
    indices: Option<Vec<Sensitivity>>,
}

/// What the samples say about every number of the answers.
pub struct Spread<'a> {
    keys: &'a [String],
    design: &'a SampleDesign,
    quantities: Vec<Quantity>,
}

impl<'a> Spread<'a> {
    /// Of columns of numbers, one value a point, in the order of the points; what is missing is not a number.
    pub fn new(keys: &'a [String], design: &'a SampleDesign, columns: Vec<(String, Vec<f64>)>) -> Self {
        let own = if design.indices { 2 * design.count } else { design.count };
        let quantity = |(name, values): (String, Vec<f64>)| {
            let statistics = statistics(&values[..own.min(values.len())])?;
            let indices = design.indices.then(|| sensitivity(&values, design.count)).flatten();
            Some(Quantity { name, statistics, indices })
        };
        Self { keys, design, quantities: columns.into_iter().filter_map(quantity).collect() }
    }

    /// For `uncertainty.json`.
    pub fn to_json(&self) -> Value {
        let mut quantities = Map::new();
        for Quantity { name, statistics, indices } in &self.quantities {
            let mut entry = json!(statistics);
            if let Some(indices) = indices {
                entry["sobol_indices"] =
                    self.keys.iter().zip(indices).map(|(key, index)| (key.clone(), json!(index))).collect();
            }
            quantities.insert(name.clone(), entry);
        }
        let keys = self.keys.iter().zip(&self.design.distributions);
        json!({
            "count": self.design.count,
            "seed": self.design.seed,
            "indices": self.design.indices,
            "distributions": keys.map(|(key, of)| (key.clone(), json!(of))).collect::<Map<_, _>>(),
            "quantile_fractions": QUANTILES,
            "quantities": quantities,
        })
    }

    /// For a person: the numbers that vary.
    pub fn table(&self) -> String {
        let mut table = format!("{:<NAMES$}", format!("{} samples", self.design.count));
        for head in ["mean", "deviation", "2.5 %", "median", "97.5 %"] {
            let _ = write!(table, "{head:<COLUMN$}");
        }
        table.truncate(table.trim_end().len());
        table.push('\n');
        let varying = || self.quantities.iter().filter(|quantity| quantity.statistics.deviation > 0.0);
        for Quantity { name, statistics, .. } in varying() {
            let [low, _, median, _, high] = statistics.quantiles;
            let _ = write!(table, "{name:<NAMES$}");
            for value in [statistics.mean, statistics.deviation, low, median, high] {
                let _ = write!(table, "{:<COLUMN$}", figure(value));
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
