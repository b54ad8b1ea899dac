//! The table `friction.evolution` as it is written: unchecked. The doc comments are the schema's descriptions.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::pair::Pair;

/// Friction that evolves: the coefficient of each cell follows what slip has done to it, from `coefficient` or `map` on. It changes after
/// each simulated cycle, and at the end of a stage without cycles.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct EvolutionFile {
    /// What the coefficient follows: the energy dissipated in the cell by area [pressure x length], the slip distance of the cell
    /// [length], or the number of cycles.
    pub by: DriverFile,
    /// Coefficient it tends to, positive: coefficient = last + (first - last) exp(-driver / scale).
    #[schemars(with = "Option<f64>")]
    pub last: Option<Spanned<f64>>,
    /// Scale of the exponential, positive, in the unit of what the coefficient follows.
    #[schemars(with = "Option<f64>")]
    pub scale: Option<Spanned<f64>>,
    /// Instead of `last` and `scale`: rows of driver and coefficient, the first at 0 with `friction.coefficient`; linear between them,
    /// constant beyond the last.
    #[schemars(with = "Option<Vec<[f64; 2]>>")]
    pub table: Option<Spanned<Vec<Pair<f64>>>>,
    /// Maximum cycle jump: number of cycles one simulated cycle may represent. Default: 1.
    #[schemars(with = "Option<usize>")]
    pub every: Option<Spanned<usize>>,
    /// Maximum change of the coefficient of a cell per cycle jump. Default: 0.01.
    #[schemars(with = "Option<f64>")]
    pub tolerance: Option<Spanned<f64>>,
}

/// What the friction coefficient follows.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum DriverFile {
    /// Energy dissipated in the cell, by area.
    Energy,
    /// Slip distance of the cell.
    SlipDistance,
    /// Number of cycles.
    Cycles,
}
