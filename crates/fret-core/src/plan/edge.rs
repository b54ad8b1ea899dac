//! What helps a contact that reaches the edge of the grid.

use crate::case::{Case, GridSize};
use crate::model::{CoulombFriction, Frame};

/// What helps a contact that reaches the edge of the grid: heights end there, neither they nor a map grow with it, and an automatic size
/// has been tried where it is written.
pub(crate) fn way_from_the_edge(case: &Case) -> &'static str {
    let has_map = case.friction.is_map()
        || case.stages.iter().filter_map(|stage| stage.friction.as_ref()).any(CoulombFriction::is_map);
    if case.rolls() && case.kinematics.frame == Frame::Contact {
        if has_map || !case.profile.heights.is_empty() {
            "it goes along with the contact, and holds twice the cells of an increment open on either side: enlarge grid.size with maps and heights for it, or roll by fewer cells in an increment"
        } else {
            "it goes along with the contact, and holds twice the cells of an increment open on either side: enlarge grid.size, or roll by fewer cells in an increment"
        }
    } else if !case.profile.heights.is_empty() {
        "the heights end there: grid.beyond = \"no body\" where the body ends there, too; grid.periodic = true lets the surface repeat; or a lower load, heights of a larger area"
    } else if case.periodic.one_axis().is_some() {
        "enlarge grid.size across the axis that repeats; grid.beyond = \"no body\" where a body ends there"
    } else if case.size == GridSize::Auto {
        "write grid.size = [x, y], larger than what \"auto\" found, which fret plan shows"
    } else if has_map {
        "enlarge grid.size, with a friction map for it"
    } else {
        "enlarge grid.size, or write size = \"auto\"; grid.beyond = \"no body\" where a body ends there"
    }
}
