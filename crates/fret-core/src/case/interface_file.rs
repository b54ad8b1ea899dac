//! The interface below a coating, as it is written: a word, or springs.

use std::fmt;

use schemars::JsonSchema;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use toml::Spanned;

/// How a coating is bonded to what lies below it.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum InterfaceFile {
    Bonded,
    Frictionless,
    Springs(SpringsFile),
}

/// Springs of no thickness between a coating and what lies below it: displacement jumps by traction over stiffness.
#[derive(Debug, Clone, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpringsFile {
    /// Normal stiffness [pressure/length], positive. Default: bonded along the normal.
    #[schemars(with = "Option<f64>")]
    pub normal_stiffness: Option<Spanned<f64>>,
    /// Shear stiffness [pressure/length], the same in all directions; 0: no shear passes. Default: bonded against shear.
    #[schemars(with = "Option<f64>")]
    pub shear_stiffness: Option<Spanned<f64>>,
}

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for InterfaceFile in the schema")]
pub(super) enum InterfaceSchema {
    Word(InterfaceWord),
    Springs(SpringsFile),
}

#[derive(JsonSchema)]
#[serde(rename_all = "lowercase")]
#[expect(dead_code, reason = "stands for a word in the schema")]
pub(super) enum InterfaceWord {
    Bonded,
    Frictionless,
}

impl<'de> Deserialize<'de> for InterfaceFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InterfaceVisitor;
        impl<'de> Visitor<'de> for InterfaceVisitor {
            type Value = InterfaceFile;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str(
                    "\"bonded\", \"frictionless\" or { normal_stiffness = ..., shear_stiffness = ... }",
                )
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<InterfaceFile, E> {
                match word {
                    "bonded" => Ok(InterfaceFile::Bonded),
                    "frictionless" => Ok(InterfaceFile::Frictionless),
                    _ => Err(E::invalid_value(de::Unexpected::Str(word), &self)),
                }
            }
            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<InterfaceFile, A::Error> {
                let springs = SpringsFile::deserialize(de::value::MapAccessDeserializer::new(table));
                springs.map(InterfaceFile::Springs)
            }
        }
        deserializer.deserialize_any(InterfaceVisitor)
    }
}
