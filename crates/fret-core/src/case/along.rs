//! A value along x and one along y; in a line contact one value.

use std::fmt;
use std::marker::PhantomData;

use schemars::JsonSchema;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

use super::axis::AxisSchema;
use super::pair::Pair;

/// A list of two values, or a single one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AlongFile<T> {
    /// Along x and y.
    Both([T; 2]),
    /// Across a line contact.
    Line(T),
}

impl<T: Copy> AlongFile<T> {
    /// The values along x and y; `rest` along the line where there is one value.
    pub fn values(&self, rest: T) -> [T; 2] {
        match *self {
            Self::Both(values) => values,
            Self::Line(value) => [value, rest],
        }
    }
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for AlongFile<AxisFile> in the schema")]
pub(super) enum AlongSchema {
    Both([AxisSchema; 2]),
    Line(f64),
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for AlongFile<f64> in the schema")]
pub(super) enum AlongPhaseSchema {
    Both([f64; 2]),
    Line(f64),
}

impl<'de, T: Deserialize<'de> + From<f64>> Deserialize<'de> for AlongFile<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AlongVisitor(PhantomData))
    }
}

struct AlongVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + From<f64>> Visitor<'de> for AlongVisitor<T> {
    type Value = AlongFile<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("two values [x, y], or one number in a line contact")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<AlongFile<T>, E> {
        Ok(AlongFile::Line(T::from(value)))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<AlongFile<T>, E> {
        Ok(AlongFile::Line(T::from(value as f64)))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<AlongFile<T>, E> {
        Ok(AlongFile::Line(T::from(value as f64)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<AlongFile<T>, A::Error> {
        Pair::deserialize(de::value::SeqAccessDeserializer::new(list)).map(|pair| AlongFile::Both(pair.0))
    }
}
