//! A number for one axis, or the word "held".

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Visitor};

/// A number for one axis, or the word "held".
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AxisFile {
    Value(f64),
    Held,
}

impl AxisFile {
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value(value) => Some(value),
            Self::Held => None,
        }
    }
}

impl From<f64> for AxisFile {
    fn from(value: f64) -> Self {
        Self::Value(value)
    }
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for AxisFile in the schema")]
pub(super) enum AxisSchema {
    Value(f64),
    Held(HeldWord),
}

#[derive(JsonSchema)]
#[serde(rename_all = "lowercase")]
#[expect(dead_code, reason = "stands for a word in the schema")]
pub(super) enum HeldWord {
    Held,
}

impl<'de> Deserialize<'de> for AxisFile {
    fn deserialize<D: de::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AxisVisitor;
        impl Visitor<'_> for AxisVisitor {
            type Value = AxisFile;
            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a number or \"held\"")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<AxisFile, E> {
                Ok(AxisFile::Value(value))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<AxisFile, E> {
                Ok(AxisFile::Value(value as f64))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<AxisFile, E> {
                Ok(AxisFile::Value(value as f64))
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<AxisFile, E> {
                if word == "held" {
                    Ok(AxisFile::Held)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(word), &self))
                }
            }
        }
        deserializer.deserialize_any(AxisVisitor)
    }
}
