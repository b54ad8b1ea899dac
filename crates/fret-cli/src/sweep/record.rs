//! `points.json`: which points a sweep has, in their order. What is written is what the page of the sweep reads back.

use fret_core::model::Dimension;
use fret_core::units::Units;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// All of it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SweepRecord {
    /// Title of the base case, where it has one.
    pub title: Option<String>,
    /// The keys that change.
    pub keys: Vec<String>,
    /// Those of them whose values are drawn, the last ones.
    pub drawn: Vec<String>,
    /// Units that the cases declare.
    pub units: Option<Units>,
    /// Whether these are line contacts, with loads per length.
    #[serde(rename = "is_line")]
    pub dimension: Dimension,
    /// The points.
    pub points: Vec<PointOfSweep>,
}

/// A point.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PointOfSweep {
    /// Its values, one a key.
    pub values: Vec<Value>,
    /// The file of its answer, below `points`.
    pub file: String,
}
