//! The choice between the ways to solve a coupled contact.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How coupled pressure and shear are solved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// Monolithic: pressure and shear in one Newton-type iteration.
    #[default]
    Together,
    /// Staggered: pressure and shear in alternation until they agree (Panagiotopoulos process), the published three-level scheme, for
    /// comparison.
    Alternating,
}
