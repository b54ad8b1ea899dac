//! The judgement of what lies beyond the edge of the grid.

use super::file::GridFile;
use super::judge::Judge;
use crate::model::{Beyond, GridSize};

/// What lies beyond the edge; refuses a body that ends at an edge that is not known, or that there is none of.
pub(super) fn beyond(judge: &mut Judge, grid: &GridFile, size: Option<GridSize>) -> Beyond {
    let Some(given) = grid.beyond.as_ref().filter(|given| !given.value.is_body()) else {
        return Beyond::Body;
    };
    if grid.periodicity().is_both() {
        judge.refuse::<()>(
            given.span(),
            "grid.beyond = \"no body\" in a periodic case: the surfaces repeat, and end nowhere",
            "leave one of the two out",
        );
    } else if size == Some(GridSize::Auto) {
        judge.refuse::<()>(
            grid.size.span(),
            "grid.size = \"auto\" with beyond = \"no body\": the body ends where the grid does",
            "size = [x, y], that of the body",
        );
    }
    given.value
}

#[cfg(test)]
mod tests {
    use crate::case::check::tests::{ROLLER, read, refused};
    use crate::model::Beyond;

    #[test]
    fn a_body_ends_only_where_a_grid_of_known_size_does() {
        assert_eq!(read(ROLLER, &[]).beyond, Beyond::Body);
        let ends = |size: &str| format!("size = {size}\nbeyond = \"no body\"");
        assert_eq!(read(ROLLER, &[("size = 3.0", &ends("3.0"))]).beyond, Beyond::NoBody);
        refused(
            ROLLER,
            &[("size = 3.0", &ends("\"auto\""))],
            "the body ends where the grid does",
            "\"auto\"",
        );
    }
}
