//! Pressure that has no largest value.

use crate::case::{Case, CaseRecord};
use crate::model::Shape;

/// Whether the exact pressure of a case grows without bound somewhere: at the sharp edge of a flat punch or of a cylinder that
/// ends as a power of the distance (the inverse root without friction), at the tip of a cone or a pyramid and at the rim of a worn sphere,
/// where the slope jumps, as its logarithm; so do the creases of a measured surface, which is straight between its points, on `cells` that are finer
/// than these. The largest pressure of the cells then grows with their number.
pub fn pressure_is_unbounded(case: &Case, cells: [usize; 2]) -> bool {
    let profile = &case.profile;
    has_edges(&profile.shapes) || profile.heights.iter().any(|heights| heights.are_coarser_than(cells))
}

/// The same of the case of a run, on its cells, as its record holds it.
pub fn pressure_of_run_is_unbounded(case: &CaseRecord) -> bool {
    let profile = &case.profile;
    has_edges(&profile.shapes) || profile.heights.iter().any(|heights| heights.has_creases)
}

/// Whether it is that of one of these shapes.
fn has_edges(shapes: &[Shape]) -> bool {
    let has_a_kink = |shape: &Shape| {
        matches!(shape, Shape::Cone { .. } | Shape::Pyramid { .. } | Shape::WornSphere { .. })
    };
    shapes.iter().any(|shape| ends(shape) || has_a_kink(shape))
}

/// Whether a body of this shape ends at a sharp edge.
pub(super) fn ends(shape: &Shape) -> bool {
    matches!(
        shape,
        Shape::FlatPunch { .. }
            | Shape::Cylinder { length: Some(_), .. }
            | Shape::RectangularPunch { edge_radius: None, .. }
    )
}
