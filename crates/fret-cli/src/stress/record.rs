//! `stress.json`: what is told of the stresses of a run. What is written is what the report reads back.

use std::collections::BTreeMap;

use fret_core::units::Units;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::kinds::kind_of_stress;
use crate::figures::{UNLIMITED, bounded};
use crate::table::{Cell, Columns};

/// All of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StressRecord {
    /// One word.
    pub status: String,
    /// Why the run is not finished, if it is not.
    pub unfinished: Option<String>,
    /// That only the ends of the stages are kept, and how to keep more, where that is so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stage_ends_alone: Option<String>,
    /// That no fatigue is told of cycles in which the places of the bodies travel through the grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub places_travel: Option<String>,
    /// The body.
    pub body: String,
    /// Units that the case declares.
    pub units: Option<Units>,
    /// Increments that were evaluated.
    pub increments: Vec<usize>,
    /// Depths [length].
    pub depths: Vec<f64>,
    /// The layer at each depth, from the surface down.
    pub layers: Vec<usize>,
    /// Largest values of all increments, depths and cells.
    pub largest: Vec<LargestRecord>,
    /// Fatigue over the last cycle.
    pub fatigue: Option<FatigueRecord>,
    /// Fracture of the outermost coating.
    pub coating: Option<Vec<FilmRecord>>,
    /// Time it took [s].
    pub wall_s: f64,
}

/// The largest value of a measure, and where.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LargestRecord {
    /// Which measure.
    pub measure: String,
    /// Its value [pressure].
    pub value: f64,
    /// The increment.
    pub increment: usize,
    /// Place [length].
    pub x: f64,
    /// Place [length].
    pub y: f64,
    /// Place [length].
    pub depth: f64,
    /// The layer, in words.
    pub layer: String,
}

/// Measures that are no tension at all where they are not above zero.
const TENSIONS: [&str; 3] = ["tension", "hydrostatic", "peel"];

impl LargestRecord {
    /// What is told of it, the measure by what it is `called`.
    pub fn columns<'a>(called: impl Fn(&str) -> String + 'a) -> Columns<'a, Self> {
        Columns::<Self>::new()
            .column("maximum", "", move |found| called(&found.measure))
            .column("value", "pressure", |found| {
                found.shown(found.value).map_or("none: compression everywhere".into(), Cell::Number)
            })
            .column("increment", "", |found| found.shown(found.increment))
            .column("x", "length", |found| found.shown(found.x))
            .column("y", "length", |found| found.shown(found.y))
            .column("depth", "length", |found| found.shown(found.depth))
            .column("in", "", |found| found.shown(found.layer.clone()))
    }

    /// What is told of it: nothing of a tension that is none.
    fn shown<T>(&self, value: T) -> Option<T> {
        (self.value > 0.0 || !TENSIONS.contains(&self.measure.as_str())).then_some(value)
    }
}

/// Fatigue over a cycle.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FatigueRecord {
    /// Increments of the cycle.
    pub increments: Vec<usize>,
    /// The most severe place by each parameter.
    pub parameters: BTreeMap<String, ParameterRecord>,
    /// What becomes of a short crack from the surface, where that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crack: Option<CrackRecord>,
}

/// The largest value of a parameter, and where. What a parameter does not have is left away.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct ParameterRecord {
    /// The value, in the unit of the parameter.
    pub largest: f64,
    /// Place [length].
    pub x: f64,
    /// Place [length].
    pub y: f64,
    /// Place [length].
    pub depth: f64,
    /// The layer, from the surface down.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layer: Option<usize>,
    /// Unit normal of the critical plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// The largest value of a cell, where `largest` is extrapolated to the rim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest_cell: Option<f64>,
    /// Cycles to initiation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycles: Option<Bounded>,
    /// The same of the largest cell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest_cell_cycles: Option<Bounded>,
    /// Factor of safety.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor_of_safety: Option<Bounded>,
    /// The same of every layer, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<ParameterRecord>,
    /// The value at the critical distance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical_distance: Option<CriticalDistance>,
}

impl ParameterRecord {
    /// What is told of the parameter of a name; `figure` prints a number beside the kind of its unit.
    pub fn words(&self, name: &str, figure: impl Fn(f64, &str) -> String) -> String {
        let own = |value: f64| figure(value, kind_of_stress(name));
        let [x, y, depth] = [self.x, self.y, self.depth].map(|place| figure(place, "length"));
        let mut words = format!("{:<20} {:<12} at x {x:<12} ", name.replace('_', " "), own(self.largest));
        if self.layer.is_none() {
            return words + "surface";
        }
        words += &format!("y {y:<12} depth {depth:<12}");
        let in_cycles = |cycles: Option<Bounded>| cycles.map(|cycles| bounded(cycles.0) + " cycles");
        if let Some(Bounded(cycles)) = self.cycles {
            words += &format!(" cycles to initiation {}", bounded(cycles));
        }
        if let Some(Bounded(factor)) = self.factor_of_safety {
            words += &format!(" factor of safety {}", bounded(factor));
        }
        if let Some(cell) = self.largest_cell.filter(|cell| *cell != self.largest) {
            let cycles = in_cycles(self.largest_cell_cycles).map(|cycles| format!(", {cycles}"));
            let cycles = cycles.unwrap_or_default();
            words += &format!(" (extrapolated to the rim; largest cell {}{cycles})", own(cell));
        }
        words.truncate(words.trim_end().len());
        if let Some(CriticalDistance { distance, point, line }) = &self.critical_distance {
            let [point, line] = [point, line].map(|at| {
                own(at.value) + &in_cycles(at.cycles).map_or(String::new(), |cycles| format!(" ({cycles})"))
            });
            let distance = figure(*distance, "length");
            words += &format!(
                "\n    at the critical distance {distance}: {point} by the point method, {line} by the line method"
            );
        }
        words
    }
}

/// A parameter by the theory of critical distances.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CriticalDistance {
    /// The distance [length].
    pub distance: f64,
    /// By the point method.
    pub point: AtDistance,
    /// By the line method.
    pub line: AtDistance,
}

/// A value below a place of the surface.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct AtDistance {
    /// The value.
    pub value: f64,
    /// Place [length].
    pub x: f64,
    /// Place [length].
    pub y: f64,
    /// Cycles to initiation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycles: Option<Bounded>,
}

/// What becomes of a short crack.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CrackRecord {
    /// One word; "none" where there is none.
    pub fate: String,
    /// Why there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Its course, where it was followed.
    #[serde(flatten)]
    pub course: Option<CrackFollowed>,
}

/// A crack that was followed.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CrackFollowed {
    /// Where it starts [length].
    pub x: f64,
    /// Where it starts [length].
    pub y: f64,
    /// From the normal of the surface [degrees].
    pub angle: f64,
    /// Unit vector in the surface that the angle turns to.
    pub towards: [f64; 2],
    /// Its length at the end [length].
    pub length: f64,
    /// Cycles until then.
    pub cycles: Option<f64>,
}

impl CrackRecord {
    /// What becomes of it, in words; `figure` prints a number beside the kind of its unit.
    pub fn words(&self, figure: impl Fn(f64, &str) -> String) -> String {
        let Some(course) = &self.course else {
            return format!("crack: none: {}", self.reason.as_deref().unwrap_or_default());
        };
        let [x, y, length] = [course.x, course.y, course.length].map(|value| figure(value, "length"));
        let end = match self.fate.as_str() {
            "does_not_grow" => format!("does not grow: below the threshold at {length}"),
            "stops" => format!("stops at length {length}"),
            "fractures" => format!("reaches the toughness at {length}"),
            _ => format!("grows to {length}"),
        };
        let angle = figure(course.angle, "");
        let cycles = course.cycles.map(|cycles| format!(" after {} cycles", figure(cycles, "")));
        let cycles = cycles.unwrap_or_default();
        format!("crack from x {x} y {y}, {angle} degrees from the normal: {end}{cycles}")
    }
}

/// A crack of the outermost coating.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FilmRecord {
    /// Mean stress over the thickness [pressure].
    pub stress: f64,
    /// Its direction from the x axis [degrees].
    pub direction: f64,
    /// The increment.
    pub increment: usize,
    /// Place [length].
    pub x: f64,
    /// Place [length].
    pub y: f64,
    /// Energy released by a channelling crack [pressure x length].
    pub channelling: Option<f64>,
    /// Energy released by delamination [pressure x length].
    pub delamination: f64,
    /// Phase angle of the delamination [degrees].
    pub phase: Option<f64>,
    /// Root of toughness over energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channelling_factor_of_safety: Option<Bounded>,
    /// Root of toughness over energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub delamination_factor_of_safety: Option<Bounded>,
}

impl FilmRecord {
    /// What is told of it to a person; `figure` prints a number beside the kind of its unit.
    pub fn words(&self, figure: impl Fn(f64, &str) -> String) -> String {
        let sense = if self.stress > 0.0 { "tension" } else { "compression" };
        let released = |energy: f64| figure(energy, "pressure x length");
        let unknown = "- (needs lower.coatings[..].fatigue.channelling_factor)";
        let channelling = self.channelling.map_or_else(|| unknown.to_owned(), released);
        let [x, y] = [self.x, self.y].map(|place| figure(place, "length"));
        format!(
            "coating, mean {sense:<11} {:<12} at x {x:<12} y {y:<12} energy released: channelling {channelling}, delamination {}",
            figure(self.stress, "pressure"),
            released(self.delamination)
        )
    }

    /// What is told of it.
    pub fn columns<'a>() -> Columns<'a, Self> {
        let factor = |factor: Option<Bounded>| factor.map(|factor| bounded(factor.0));
        Columns::<Self>::new()
            .column("mean stress", "pressure", |film| film.stress)
            .column("x", "length", |film| film.x)
            .column("y", "length", |film| film.y)
            .column("energy released by channelling", "pressure x length", |film| film.channelling)
            .column("by delamination", "pressure x length", |film| film.delamination)
            .column("factor of safety, channelling", "", move |film| {
                factor(film.channelling_factor_of_safety)
            })
            .column("delamination", "", move |film| factor(film.delamination_factor_of_safety))
    }
}

/// A number that may be beyond all bounds: in files the word "unlimited".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounded(pub f64);

impl Serialize for Bounded {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else {
            serializer.serialize_str(UNLIMITED)
        }
    }
}

impl<'de> Deserialize<'de> for Bounded {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Number(f64),
            Word(String),
        }
        Ok(match Written::deserialize(deserializer)? {
            Written::Number(value) => Self(value),
            Written::Word(word) if word == UNLIMITED => Self(f64::INFINITY),
            Written::Word(word) => {
                return Err(serde::de::Error::custom(format!("{word}: neither a number nor {UNLIMITED}")));
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{from_value, json};

    use super::*;

    #[test]
    fn a_number_beyond_all_bounds_is_a_word_and_no_other_word_is_a_number() {
        for (value, written) in [(f64::INFINITY, json!("unlimited")), (2.5e6, json!(2.5e6))] {
            assert_eq!(json!(Bounded(value)), written);
            assert_eq!(from_value::<Bounded>(written).unwrap(), Bounded(value));
        }
        assert!(from_value::<Bounded>(json!("many")).is_err());
    }
}
