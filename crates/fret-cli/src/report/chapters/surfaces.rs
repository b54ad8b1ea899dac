//! The surfaces over the section as they move: undeformed shapes and what is worn off them, the upper one at its shift.

use fret_core::model::{Profile, Shape};
use ndarray::Array2;

use crate::failure::Failure;
use crate::report::{Overview, Section};

/// Fields of the wear depth of the lower and of the upper body.
pub const OWN_DEPTHS: [&str; 2] = ["lower_worn_depth", "upper_worn_depth"];

/// Whether the record and the kept fields say all of surfaces that move: shapes by formula of each body, which shift and neither turn, tilt nor
/// roll, and their scars.
pub fn are_known(view: &Overview<'_>) -> bool {
    let (results, case) = (view.results, view.results.case());
    let is_nothing = |name: &str| results.table.column(name).iter().all(|value| *value == 0.0);
    let scars_are_known =
        OWN_DEPTHS.iter().all(|name| results.fields.has(name)) || is_nothing("max_worn_depth");
    case.kinematics.is_finite()
        && results.record.shapes_of_upper.is_some()
        && case.profile.heights.is_empty()
        && case.periodic.in_words().is_empty()
        && ["twist", "tilt_x", "tilt_y", "roll_x", "roll_y"].into_iter().all(is_nothing)
        && scars_are_known
}

/// Heights of the lower and of the upper surface along a section [length], upwards, at the kept increment at a position: brought together until
/// they touch there. Not a number where a body has ended.
pub fn along(view: &Overview<'_>, section: &Section, position: usize) -> Result<[Vec<f64>; 2], Failure> {
    let (results, case) = (view.results, view.results.case());
    let (fields, table) = (&results.fields, &results.table);
    let shapes = &case.profile.shapes;
    let of_upper = results.record.shapes_of_upper.unwrap_or(0).min(shapes.len());
    let surface = |shapes: &[Shape]| Profile { shapes: shapes.to_vec(), ..Profile::default() };
    let profiles = [surface(&shapes[of_upper..]), surface(&shapes[..of_upper])];
    let mut scars = [None, None];
    for (scar, name) in scars.iter_mut().zip(OWN_DEPTHS) {
        *scar = fields.has(name).then(|| fields.field(name, position)).transpose()?;
    }
    let shift = ["shift_x", "shift_y"].map(|name| table.at(name, fields.steps[position]));
    let axes = [fields.x.as_slice(), fields.y.as_slice()];
    let open = |body: usize, moved: [f64; 2]| -> Vec<f64> {
        let at = |s: &f64| {
            let [x, y] = section.point(*s);
            let place = [x - moved[0], y - moved[1]];
            let worn = scars[body].as_ref().map_or(0.0, |scar| between(scar, axes, place));
            let height = profiles[body].gap_of_shapes_at(place[0], place[1]) + worn;
            if height.is_finite() { height } else { f64::NAN }
        };
        section.along.iter().map(at).collect()
    };
    let (below, above) = (open(0, [0.0; 2]), open(1, shift));
    let gap = below.iter().zip(&above).map(|(below, above)| below + above).fold(f64::INFINITY, f64::min);
    let gap = if gap.is_finite() { gap } else { 0.0 };
    Ok([
        below.into_iter().map(|depth| -depth).collect(),
        above.into_iter().map(|height| height - gap).collect(),
    ])
}

/// Value of a field at a place between its cell centres, linear along each axis; zero outside of them.
fn between(field: &Array2<f64>, axes: [&[f64]; 2], place: [f64; 2]) -> f64 {
    let beside = [0, 1].map(|axis| {
        let centres = axes[axis];
        if centres.len() == 1 {
            return Some((0, 0, 0.0)); // a line contact is the same all along
        }
        let next = centres.partition_point(|centre| *centre <= place[axis]);
        let before = next.checked_sub(1)?;
        if next == centres.len() {
            return (centres[before] == place[axis]).then_some((before, before, 0.0));
        }
        Some((before, next, (place[axis] - centres[before]) / (centres[next] - centres[before])))
    });
    let [Some((left, right, x)), Some((low, high, y))] = beside else { return 0.0 };
    let across = |j: usize| (1.0 - x) * field[[left, j]] + x * field[[right, j]];
    (1.0 - y) * across(low) + y * across(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_itself_between_the_cells_and_nothing_beyond() {
        let axes: [&[f64]; 2] = [&[0.0, 2.0, 4.0], &[1.0, 2.0]];
        let field = Array2::from_shape_fn((3, 2), |(i, j)| 3.0 * axes[0][i] - axes[1][j]);
        for [x, y] in [[0.5, 1.25], [3.0, 2.0], [4.0, 1.0]] {
            assert!((between(&field, axes, [x, y]) - (3.0 * x - y)).abs() < 1e-12);
        }
        assert_eq!(between(&field, axes, [4.1, 1.5]), 0.0);
        assert_eq!(between(&field, [axes[0], &[0.0]], [2.0, 7.0]), 5.0, "the same all along");
    }
}
