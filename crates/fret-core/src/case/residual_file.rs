//! Residual stress of a layer, as it is written: a number, one along each axis, or a table over its depth.

use schemars::JsonSchema;
use toml::de::DeValue;

use crate::document::{Read, Reader, Reading, Table, Written};

/// A stress, the same along x and y; one along each; or rows of depth and of one or two stresses.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged, rename = "ResidualSchema", description = "")]
pub(super) enum ResidualFile {
    Even(f64),
    Axes([f64; 2]),
    Table(Vec<Vec<f64>>),
}

impl ResidualFile {
    /// Rows of depth and stress along x and y; one row at depth 0 where it does not change with depth.
    pub fn rows(&self) -> Vec<(f64, [f64; 2])> {
        match self {
            Self::Even(stress) => vec![(0.0, [*stress; 2])],
            Self::Axes(stress) => vec![(0.0, *stress)],
            Self::Table(rows) => rows.iter().map(|row| (row[0], [row[1], row[row.len() - 1]])).collect(),
        }
    }
}

/// A number, or a row of them.
#[derive(Table)]
#[expected("a number, or a row [depth, stress] or [depth, stress along x, along y]")]
enum Entry {
    Number(f64),
    Row(Vec<f64>),
}

impl Read for ResidualFile {
    const EXPECTED: &'static str = "a stress, two of them [along x, along y], or rows [[depth, stress], ...]";

    fn fits(value: &Written<'_>) -> bool {
        f64::fits(value) || Vec::<Entry>::fits(value)
    }

    fn read(value: &Written<'_>, reader: &mut Reader) -> Reading<Self> {
        if f64::fits(value) {
            return f64::read(value, reader).map(Self::Even).map_err(|_| None);
        }
        let DeValue::Array(list) = value.get_ref() else { return reader.wrong(value, Self::EXPECTED, None) };
        let entries: Vec<Entry> = reader.entries(list).map_err(|_: Option<Vec<Entry>>| None)?;
        if let [Entry::Number(x), Entry::Number(y)] = entries[..] {
            return Ok(Self::Axes([x, y]));
        }
        let row = |entry| match entry {
            Entry::Row(row) if (2..=3).contains(&row.len()) => Some(row),
            _ => None,
        };
        let rows: Vec<Vec<f64>> = entries.into_iter().filter_map(row).collect();
        if rows.is_empty() || rows.len() < list.len() {
            return reader.wrong_length(value, list.len(), Self::EXPECTED, None);
        }
        Ok(Self::Table(rows))
    }
}
