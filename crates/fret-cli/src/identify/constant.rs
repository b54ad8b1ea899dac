//! A fitted constant in records.

use fret_core::identify::Constant;
use serde_json::{Map, Value, json};

/// A fitted constant.
pub fn of_constant(constant: &Constant) -> Map<String, Value> {
    let [low, high] = constant.interval;
    let entries = [
        ("name", json!(constant.name)),
        ("unit", json!(constant.unit)),
        ("value", json!(constant.value)),
        ("low", json!(low)),
        ("high", json!(high)),
        ("told", json!(constant.told)),
    ];
    entries.map(|(key, value)| (key.to_owned(), value)).into_iter().collect()
}
