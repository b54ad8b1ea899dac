//! The choice between the ways to solve a coupled contact.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How coupled pressure and shear are solved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// One Newton method for pressure and shear together.
    #[default]
    Monolithic,
    /// Pressure at given shear, shear at given pressure, until they agree (Panagiotopoulos process): the published three-level scheme,
    /// for comparison.
    Staggered,
}
