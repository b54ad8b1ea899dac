//! Residual stress of a layer, as it is written: a number, one along each axis, or a table over its depth.

use std::fmt;

use schemars::JsonSchema;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

/// Rows of depth and stress along x and y; one row at depth 0 where it does not change with depth.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ResidualFile(pub Vec<(f64, [f64; 2])>);

#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "stands for ResidualFile in the schema")]
pub(super) enum ResidualSchema {
    Even(f64),
    Axes([f64; 2]),
    Table(Vec<Vec<f64>>),
}

/// A number, or a row of them.
enum Entry {
    Number(f64),
    Row(Vec<f64>),
}

impl<'de> Deserialize<'de> for Entry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct EntryVisitor;
        impl<'de> Visitor<'de> for EntryVisitor {
            type Value = Entry;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a number, or a row [depth, stress] or [depth, stress along x, along y]")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Entry, E> {
                Ok(Entry::Number(value))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Entry, E> {
                Ok(Entry::Number(value as f64))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Entry, E> {
                Ok(Entry::Number(value as f64))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Entry, A::Error> {
                let mut row = Vec::new();
                while let Some(value) = list.next_element::<f64>()? {
                    row.push(value);
                }
                Ok(Entry::Row(row))
            }
        }
        deserializer.deserialize_any(EntryVisitor)
    }
}

impl<'de> Deserialize<'de> for ResidualFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ResidualVisitor;
        impl<'de> Visitor<'de> for ResidualVisitor {
            type Value = ResidualFile;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter
                    .write_str("a stress, two of them [along x, along y], or rows [[depth, stress], ...]")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<ResidualFile, E> {
                Ok(ResidualFile(vec![(0.0, [value; 2])]))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<ResidualFile, E> {
                self.visit_f64(value as f64)
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<ResidualFile, E> {
                self.visit_f64(value as f64)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<ResidualFile, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = list.next_element::<Entry>()? {
                    entries.push(entry);
                }
                if let [Entry::Number(x), Entry::Number(y)] = entries[..] {
                    return Ok(ResidualFile(vec![(0.0, [x, y])]));
                }
                let row = |entry: &Entry| match entry {
                    Entry::Row(row) => match row[..] {
                        [depth, stress] => Some((depth, [stress; 2])),
                        [depth, x, y] => Some((depth, [x, y])),
                        _ => None,
                    },
                    Entry::Number(_) => None,
                };
                let rows: Option<Vec<_>> = entries.iter().map(row).collect();
                match rows {
                    Some(rows) if !rows.is_empty() => Ok(ResidualFile(rows)),
                    _ => Err(de::Error::invalid_length(entries.len(), &self)),
                }
            }
        }
        deserializer.deserialize_any(ResidualVisitor)
    }
}
