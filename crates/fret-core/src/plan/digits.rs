//! How many digits frozen problems need.

use std::f64::consts::{PI, TAU};

use crate::case::Case;
use crate::kernel::PairResponse;
use crate::model::SurfaceGrid;

/// Six digits do when long and short waves move the surfaces alike up to this factor: rounding, which is relative to the waves
/// that move most, then leaves four to those that move least.
const ALIKE: f64 = 100.0;

/// Whether six digits do on frozen zones and in approximate inverses: not in scenes that repeat, where the inverse is exact and
/// solves full contact at once, and not over coatings much stiffer or softer than what lies below.
pub fn six_digits_do(case: &Case, grid: &SurfaceGrid, response: &PairResponse) -> bool {
    let [longest, shortest] = [grid.size(), grid.spacing()].map(|[x, y]| (x.max(y), x.min(y)));
    let at = |k: f64| response.times_k(k).zz;
    let softening = at(TAU / longest.0) / at(PI / shortest.1);
    !case.periodic && softening < ALIKE && softening > 1.0 / ALIKE
}
