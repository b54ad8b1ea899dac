//! Fields on the cells of a grid: arithmetic with the vector instructions of the machine, and how fields are stored. No mechanics.

mod arithmetic;
mod dual;
mod each_cell;
mod in_plane;
mod moved;
mod portions;
mod registers;
mod room;
mod scalar;
mod slopes;
mod small_system;
pub(crate) mod stored;
mod tangential;
mod zeros;

pub use arithmetic::{add_scaled, dot, largest, lower, norm, scale, sum, unit_of};
pub use dual::Dual;
pub use each_cell::{CellRule, CellSize, convert, each_cell, largest_of};
pub use in_plane::InPlane;
pub use moved::{Outside, carried, carried_by_whole_cells};
pub use portions::{in_portions, pieces};
pub use registers::{Number, Reals};
pub use room::reset;
pub use scalar::{Scalar, length_of};
pub use slopes::Slopes;
pub(crate) use small_system::solved;
pub use tangential::{TangentialField, length};
pub use zeros::{copied, is_zero};
