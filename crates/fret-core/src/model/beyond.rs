//! What lies beyond the edge of the grid.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What lies beyond the edge of the grid.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Beyond {
    /// The bodies go on: contact at the edge of the grid would go on, too, and is refused.
    #[default]
    #[serde(rename = "body")]
    Body,
    /// A body ends there, as a punch ends: contact may reach the edge.
    #[serde(rename = "no body")]
    NoBody,
}

impl Beyond {
    /// Whether the bodies go on.
    pub fn is_body(&self) -> bool {
        *self == Self::Body
    }
}
