//! The choice between the ways to solve a coupled contact, and between those to integrate its history.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::document::Table;

/// How coupled pressure and shear are solved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// One Newton method for pressure and shear together.
    #[default]
    Monolithic,
    /// Pressure at given shear, shear at given pressure, until they agree (Panagiotopoulos process): the published three-level scheme,
    /// for comparison.
    Staggered,
}

/// How slip is integrated over an increment.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integration {
    /// Of second order in the increments: the friction law at the end of an increment by the direction of slip there; dissipated energy,
    /// slip distance and wear along the arc of slip that turns.
    #[default]
    SecondOrder,
    /// Of first order, for comparison: by the direction of the whole slip increment (backward Euler).
    EndPoint,
}
