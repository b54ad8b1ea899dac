//! Whether linear problems may be solved in single precision.

use std::f64::consts::{PI, TAU};

use crate::case::Case;
use crate::kernel::PairResponse;
use crate::model::{Dimension, SurfaceGrid};
use crate::solver::Coupling;

/// Single precision does when long and short waves move the surfaces alike up to this factor: rounding is relative to the waves that move
/// most. Thin coatings thirty times stiffer took a third more steps.
const ALIKE: f64 = 4.0;
/// With hardly any friction, what pressure does to shear in a coupled contact drowns what shear does: at 1e-6 the result suffered,
/// at 0.01 the steps are as many as in double precision.
const LEAST_FRICTION: f64 = 0.01;
/// On fewer cells (32, 48 and 64 per side were measured) nothing is gained.
const LEAST_CELLS: usize = 64 * 64;

/// Whether single precision does in linear problems and approximate inverses: not in line contacts, whose products are too short to
/// gain by it, not in periodic problems, where the inverse is exact and
/// solves full contact at once, not over coatings much stiffer or softer than what lies below, not where pressure and shear are
/// coupled with hardly any friction.
pub fn single_precision_does(
    case: &Case,
    grid: &SurfaceGrid,
    response: &PairResponse,
    coupling: Coupling,
) -> bool {
    let [longest, shortest] = [grid.size(), grid.spacing()].map(|[x, y]| (x.max(y), x.min(y)));
    let at = |k: f64| response.times_k(k).zz;
    let softening = at(TAU / longest.0) / at(PI / shortest.1);
    let mut frictions =
        case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    let has_friction =
        coupling != Coupling::Coupled || frictions.all(|friction| friction.largest() >= LEAST_FRICTION);
    let alike = softening < ALIKE && softening > 1.0 / ALIKE;
    case.periodic.is_none()
        && grid.dimension() == Dimension::Plane
        && grid.len() >= LEAST_CELLS
        && alike
        && has_friction
}
