//! Wear scars beside measured ones: lines of a profilometer, levelled and laid over the computed wear depth, all in the open.
//!
//! From the ground: `line` (heights along a line, as an instrument writes them), `hollow` (depth, width, area of a scar), `levelled` (tilt and
//! offset of the instrument taken off by what lies beside the scar); the answer in `comparison`.

mod comparison;
mod hollow;
mod levelled;
mod line;

pub use comparison::{Comparison, Pair, compare};
pub use hollow::Hollow;
pub use line::{Asked, Line, Measured, read};
