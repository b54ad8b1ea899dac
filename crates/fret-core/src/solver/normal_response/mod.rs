//! The response to pressure as the frictionless problem asks for it (`operator`), and that of some cells of a region alone (`of_some_cells`): of
//! near ones (`near`) as it is, of those far away from a coarser grid (`far`).

mod far;
mod near;
mod of_some_cells;
mod operator;

pub use of_some_cells::SparseResponse;
pub use operator::NormalResponse;
