//! Whether a scene and its loads are their own mirror image, so that a half or a quarter of the grid stands for the whole.

use crate::case::{Case, Path, StageControl};
use crate::model::{CoulombFriction, SurfaceGrid, Symmetry};
use crate::solver::Coupling;

/// Along fewer cells a mirror saves nothing.
const FEWEST_CELLS: usize = 16;

/// The mirrors of a scene.
///
/// Under a load along x the pressure and the shear along x are even across y, the shear across is odd. Across x the same holds
/// where pressure and shear do not act on each other: the mirror image is pulled the other way, and all shears changed in sign
/// answer that. Without a tangential load shear points away from the middle or towards it.
pub fn symmetry(case: &Case, grid: &SurfaceGrid, coupling: Coupling) -> Symmetry {
    if case.stages.iter().any(|stage| stage.twist.is_some()) {
        return Symmetry::NONE;
    }
    let coupled = coupling == Coupling::Coupled;
    let odd_shear = match (coupling, [is_loaded(case, 0), is_loaded(case, 1)]) {
        (Coupling::Frictionless, _) | (_, [false, false]) => [Some(0), Some(1)],
        (_, [true, false]) => [(!coupled).then_some(1), Some(1)],
        (_, [false, true]) => [Some(0), (!coupled).then_some(0)],
        (_, [true, true]) => return Symmetry::NONE,
    };
    let gap = case.profile.gap(grid);
    let frictions = case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    let maps: Vec<_> = frictions
        .filter_map(|friction| match friction {
            CoulombFriction::Uniform(_) => None,
            CoulombFriction::Map(map) => Some(map.view()),
        })
        .chain([gap.view()])
        .collect();
    let kept = |axis: usize| {
        let mut odd = [None, None];
        odd[axis] = odd_shear[axis];
        let mirror = Symmetry { odd_shear: odd };
        let keeps = grid.cells()[axis] >= FEWEST_CELLS && maps.iter().all(|field| mirror.is_kept_by(field));
        odd[axis].filter(|_| keeps)
    };
    Symmetry { odd_shear: [kept(0), kept(1)] }
}

/// Whether any stage asks for a tangential force or motion along an axis (0: x, 1: y) other than none.
pub fn is_loaded(case: &Case, axis: usize) -> bool {
    case.stages.iter().filter_map(|stage| stage.tangential[axis].as_ref()).any(|control| {
        let (StageControl::Force(path) | StageControl::Motion(path)) = control;
        match path {
            Path::To(value) | Path::Wave { amplitude: value, .. } => *value != 0.0,
            Path::Through(values) => values.iter().any(|value| *value != 0.0),
        }
    })
}
