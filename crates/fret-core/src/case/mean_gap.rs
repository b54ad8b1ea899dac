//! The mean gap between surfaces that repeat: where it can be prescribed, and from where it counts.

use std::ops::Range;

use super::file::CaseFile;
use super::hardness::of_softer;
use super::judge::{Judge, Reason, first};
use super::stage_file::StageFile;
use crate::kernel::uniform_response;
use crate::model::{ContactPair, Profile, SurfaceGrid};
use crate::topography::Cells;

/// Its key, and its column in a table.
pub(super) const MEAN_GAP: &str = "mean_gap";

const WITH_APPROACH: &str = "approach = ...";
const WITH_FORCE: &str = "normal_force = ...";

/// Mean of the undeformed gap [length]. Elastic displacements of a periodic half-space have no mean, so the mean gap between the
/// surfaces is this less the approach.
pub(super) fn mean_plane(
    file: &CaseFile,
    (over, moves): (Option<Cells>, bool),
    bodies: Option<&ContactPair>,
    profile: Option<&Profile>,
) -> Result<f64, Reason> {
    let on_a_rigid_base = bodies.is_some_and(|bodies| uniform_response(bodies).is_some());
    let reason = first([
        (
            !file.grid.periodicity().is_both(),
            "of surfaces that do not repeat: theirs grows with the grid",
            WITH_APPROACH,
        ),
        (on_a_rigid_base, "of layers on a rigid base, which have an approach", WITH_APPROACH),
        (moves, "of surfaces that move against each other: it changes with them", WITH_FORCE),
        (file.wear.is_some(), "of surfaces that wear: it changes with them", WITH_FORCE),
        (of_softer(file).is_some(), "of surfaces that yield: it changes with them", WITH_FORCE),
    ]);
    if let Some(reason) = reason {
        return Err(reason);
    }
    let counts = |stage: &StageFile| stage.table.is_some() || stage.controls.of(MEAN_GAP).is_some();
    if !file.load.value.iter().any(|stage| counts(&stage.value)) {
        return Ok(0.0); // nobody asks for it
    }
    // What was refused before is told there.
    let spaced = over.and_then(|over| {
        let size = over.size?;
        Some((over.count, [0, 1].map(|axis| size[axis] / over.count[axis] as f64)))
    });
    let grid = spaced.and_then(|(count, spacing)| SurfaceGrid::new(count, spacing).ok());
    Ok(grid.zip(profile).and_then(|(grid, profile)| profile.gap(&grid).mean()).unwrap_or_default())
}

/// The plane from which the mean gaps `values` of a stage count [length]; refused where there is none, or where one of them needs a gap
/// below zero.
pub(super) fn counted_from(
    judge: &mut Judge,
    place: &str,
    span: Range<usize>,
    values: impl IntoIterator<Item = f64>,
) -> Option<f64> {
    match judge.mean_plane {
        Err((why, help)) => judge.refuse(span, format!("{place}.{MEAN_GAP} {why}"), help),
        Ok(plane) => {
            let closed = values.into_iter().find(|value| *value <= 0.0);
            if let Some(value) = closed {
                return judge.refuse(
                    span,
                    format!(
                        "{place}.{MEAN_GAP} = {value:?}: must be above 0, where the surfaces touch everywhere"
                    ),
                    "beyond full contact the normal force is prescribed: normal_force = ...",
                );
            }
            Some(plane)
        }
    }
}
