//! One of the two bodies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::half_space::{Body, ContactPair};
use crate::document::Table;

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "SideFile")]
pub enum Side {
    /// The body above.
    Upper,
    /// The body below.
    Lower,
}

impl Side {
    /// The body of a pair.
    pub fn of(self, pair: &ContactPair) -> &Body {
        match self {
            Self::Upper => pair.upper(),
            Self::Lower => pair.lower(),
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Upper => "upper",
            Self::Lower => "lower",
        }
    }
}
