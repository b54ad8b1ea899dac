//! Pressure that has no largest value.

use crate::model::Shape;

/// Whether the exact pressure below these shapes grows without bound somewhere: at the sharp edge of a flat punch or of a cylinder that
/// ends as a
/// power of the distance (the inverse root without friction), at the tip of a cone as its logarithm. The largest pressure of the cells
/// then grows with their number.
pub fn pressure_is_unbounded(shapes: &[Shape]) -> bool {
    shapes.iter().any(|shape| ends(shape) || matches!(shape, Shape::Cone { .. }))
}

/// Whether a body of this shape ends at a sharp edge.
pub(super) fn ends(shape: &Shape) -> bool {
    matches!(shape, Shape::FlatPunch { .. } | Shape::Cylinder { length: Some(_), .. })
}
