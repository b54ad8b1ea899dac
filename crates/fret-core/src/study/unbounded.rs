//! Pressure that has no largest value.

use crate::model::Shape;

/// Whether the exact pressure below these shapes grows without bound somewhere: at the sharp edge of a flat punch or of a cylinder that
/// ends as a power of the distance (the inverse root without friction), at the tip of a cone or a pyramid and at the rim of a worn sphere,
/// where the slope jumps, as its logarithm. The largest pressure of the cells
/// then grows with their number.
pub fn pressure_is_unbounded(shapes: &[Shape]) -> bool {
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
