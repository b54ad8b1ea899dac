//! Whether a scene and its loads are their own mirror image, so that a half or a quarter of the grid stands for the whole.

use super::loaded::{is_loaded, is_twisted};
use super::moving::{moves_along, rolls_along};
use crate::case::Case;
use crate::model::{BulkCompliance, ContactState, Dimension, SurfaceGrid, Symmetry};
use crate::solver::Coupling;

/// Along fewer cells a mirror saves nothing.
const FEWEST_CELLS: usize = 16;

/// The mirrors of a scene whose history starts from bodies apart, or from `start`.
///
/// Under a load along x the pressure and the shear along x are even across y, the shear across is odd. Across x the same holds
/// where pressure and shear do not act on each other: the mirror image is pulled the other way, and all shears changed in sign
/// answer that. Without a tangential load shear points away from the middle or towards it, also under bulk stresses; these, with a
/// tangential load, leave no mirror across it. Surfaces that move leave none across their way, a tilt none along its own axis.
pub fn symmetry(
    case: &Case,
    grid: &SurfaceGrid,
    coupling: Coupling,
    start: Option<&ContactState>,
) -> Symmetry {
    // The products of a line contact are too short for a mirror to save anything.
    if grid.dimension() == Dimension::Line || is_twisted(case, start) {
        return Symmetry::NONE;
    }
    let stretched = (0..2).any(|axis| is_stretched(case, axis, start));
    let moves = [0, 1].map(|axis| moves_along(case, grid, axis, start) || rolls_along(case, axis));
    let coupled = coupling == Coupling::Coupled || stretched || moves != [false; 2];
    let mut odd_shear = match (coupling, [is_loaded(case, 0, start), is_loaded(case, 1, start)]) {
        (Coupling::Frictionless, _) | (_, [false, false]) => [Some(0), Some(1)],
        (_, [true, false]) => [(!coupled).then_some(1), Some(1)],
        (_, [false, true]) => [Some(0), (!coupled).then_some(0)],
        (_, [true, true]) => return Symmetry::NONE,
    };
    for (odd, moves) in odd_shear.iter_mut().zip(moves) {
        *odd = odd.filter(|_| !moves);
    }
    let gap = case.profile.gap(grid);
    // Where bodies move against each other each of them has to be its own mirror image.
    let upper = (moves != [false; 2]).then(|| case.profile.of_upper_body().gap(grid));
    let frictions = case.stages.iter().filter_map(|stage| stage.friction.as_ref()).chain([&case.friction]);
    let gaps = upper.iter().chain([&gap]).map(|gap| gap.view());
    let maps: Vec<_> =
        frictions.flat_map(|friction| friction.maps().map(|map| map.view())).chain(gaps).collect();
    let kept = |axis: usize| {
        let mut odd = [None, None];
        odd[axis] = odd_shear[axis];
        let mirror = Symmetry { odd_shear: odd };
        let keeps = grid.cells()[axis] >= FEWEST_CELLS
            && !case.tilts(axis)
            && maps.iter().all(|field| mirror.is_kept_by(field))
            && start.is_none_or(|state| mirror.keeps_state(state));
        odd[axis].filter(|_| keeps)
    };
    Symmetry { odd_shear: [kept(0), kept(1)] }
}

/// Whether bulk stresses move the surfaces along an axis (0: x, 1: y) against each other.
pub fn is_stretched(case: &Case, axis: usize, start: Option<&ContactState>) -> bool {
    let strains = BulkCompliance::of(&case.bodies, case.dimension());
    (0..2).flat_map(|body| (0..2).map(move |along| (body, along))).any(|(body, along)| {
        let starts = start.is_some_and(|state| state.bulk_stress[body][along] != 0.0);
        let mut controls = case.stages.iter().filter_map(|stage| stage.bulk_stress[body][along].as_ref());
        strains.strains(body, along, axis) && controls.any(|control| starts || !control.path().is_zero())
    })
}
