//! The choice between the ways to solve a coupled contact.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How pressure and shear that act on each other are brought to agree.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// One Newton-type iteration on pressure and shear together.
    #[default]
    Together,
    /// Pressure and shear in turn until they agree: the published three-level scheme, for comparison.
    Alternating,
}
