//! A fitted constant, as it is told.

use fret_core::identify::Constant;
use serde_json::{Value, json};

use crate::figures::figure;
use crate::report::number;

/// For programs.
pub fn of_constant(constant: &Constant) -> Value {
    let Constant { name, unit, value, interval: [low, high], told } = constant;
    json!({ "name": name, "unit": unit, "value": value, "low": low, "high": high, "told": told })
}

/// A value of it on a page.
pub fn cell(constant: &Constant, value: f64) -> String {
    if constant.told { number(value) } else { "not told".to_owned() }
}

/// Its name, value and interval on a page.
pub fn cells(constant: &Constant) -> [String; 4] {
    let [low, high] = constant.interval;
    let [value, low, high] = [constant.value, low, high].map(|value| cell(constant, value));
    [constant.name.clone(), value, low, high]
}

/// A line for a person, its `value` with the unit; `what` does not tell it where it is not told.
pub fn line(constant: &Constant, value: &str, (width, what, more): (usize, &str, &str)) -> String {
    let name = &constant.name;
    if !constant.told {
        return format!("  {name:<width$} not told by this {what}");
    }
    let [low, high] = constant.interval.map(figure);
    format!("  {name:<width$} {value}   95 %: {low} .. {high}{more}")
}
