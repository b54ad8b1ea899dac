//! A run, from what is wanted to what it found.
//!
//! From the ground: `methods` (a paragraph for a paper), `estimate` (error bars), `summary` (what it found), `preparation` (what is judged
//! before), `progress` (its face), `observer` (what happens while it is solved), `course` (all of it); `saved` (a history in memory, written
//! down afterwards).

mod course;
mod estimate;
mod methods;
mod observer;
mod preparation;
mod progress;
mod saved;
mod summary;

pub use course::{Beginning, run_into};
pub use estimate::{BarRow, BarsRecord, Cell, Estimate, NoBars};
pub use methods::paragraph;
pub use observer::Guest;
pub use preparation::Wanted;
pub use saved::{Solved, origin_in_memory, save};
pub use summary::volumes_by_layer;
