//! `heat.json`: what is told of heat and current. What is written is what the report reads back; a person and the page read the same lines.

use fret_core::units::Units;
use serde::{Deserialize, Deserializer, Serialize};

/// All of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct HeatRecord {
    /// One word.
    pub status: String,
    /// Why the run is not finished, if it is not.
    pub unfinished: Option<String>,
    /// Units that the case declares.
    #[serde(default)]
    pub units: Option<Units>,
    /// Temperature rise by the friction of the last cycle, where a frequency was given.
    pub temperature: Option<RiseRecord>,
    /// Contact resistances, an entry an increment.
    pub resistance: Vec<ResistanceRecord>,
    /// Time it took [s].
    pub wall_s: f64,
}

/// Temperature rise by the friction of a cycle.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RiseRecord {
    /// Cycles per unit of time.
    pub frequency: f64,
    /// The cycle.
    pub cycle: Increments,
    /// Energy dissipated in it [force x length].
    pub dissipated_energy: f64,
    /// The fraction of that which the kept fields account for.
    pub kept_fields_account_for: f64,
    /// Friction power.
    pub power: f64,
    /// The fraction of the heat that goes into the lower body.
    pub lower_fraction: Option<f64>,
    /// The largest rise, and where.
    pub max_rise: AtPlace,
    /// Mean of the rise, weighted by the heat that is made.
    pub mean_rise: f64,
}

/// Increments of a cycle.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Increments {
    /// The first one.
    pub first_increment: usize,
    /// The last one.
    pub last_increment: usize,
}

/// A value at a place of the surface.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct AtPlace {
    /// The value.
    pub value: f64,
    /// Place [length].
    pub x: f64,
    /// Place [length].
    pub y: f64,
}

/// Contact resistances in an increment; left away where a body does not conduct, `null` where the bodies are apart.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct ResistanceRecord {
    /// The increment.
    pub increment: usize,
    /// To heat.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "told")]
    pub thermal: Option<Resistance>,
    /// To electric current.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "told")]
    pub electrical: Option<Resistance>,
}

/// A contact resistance: in files a number, or `null`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Resistance {
    /// Of bodies in contact.
    Found(f64),
    /// There is none: the bodies are apart.
    Apart,
}

fn told<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Resistance>, D::Error> {
    Resistance::deserialize(deserializer).map(Some)
}

/// A line of the answer: its name, its number in words, and to what it belongs.
pub type Line = [String; 3];

impl HeatRecord {
    /// The answer line by line; `figure` prints a number of a kind of quantity.
    pub fn lines(&self, figure: impl Fn(f64, &str) -> String) -> Vec<Line> {
        let mut lines = Vec::new();
        if let Some(rise) = &self.temperature {
            let AtPlace { value, x, y } = rise.max_rise;
            let [x, y] = [x, y].map(|place| figure(place, "length"));
            let plain = |value: f64| figure(value, "");
            let told = [
                ("friction power", plain(rise.power)),
                ("max temperature rise", format!("{} at x {x}, y {y}", plain(value))),
                ("mean temperature rise", format!("{} where heat is made", plain(rise.mean_rise))),
                ("heat into the lower body", rise.lower_fraction.map_or("-".to_owned(), plain)),
            ];
            lines.extend(told.map(|(name, value)| [name.to_owned(), value, String::new()]));
        }
        for of in &self.resistance {
            for (name, found) in [("thermal", of.thermal), ("electrical", of.electrical)] {
                let Some(found) = found else { continue };
                let value = match found {
                    Resistance::Found(value) => figure(value, ""),
                    Resistance::Apart => "none: the bodies are apart".to_owned(),
                };
                let of = format!("increment {}", of.increment);
                lines.push([format!("{name} contact resistance"), value, of]);
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{from_value, json};

    use super::*;

    /// Bodies that are apart are not bodies that do not conduct.
    #[test]
    fn a_resistance_that_is_none_is_told_from_one_that_was_not_asked_for() {
        let written = json!({ "increment": 3, "thermal": null });
        let read: ResistanceRecord = from_value(written.clone()).unwrap();
        assert_eq!((read.thermal, read.electrical), (Some(Resistance::Apart), None));
        assert_eq!(json!(read), written);
    }
}
