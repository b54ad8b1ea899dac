//! What was measured, as it comes from a rig or an instrument: columns of numbers below a head, whatever stands above it, each row with its
//! line; and their units, turned into those of a case.
//!
//! From the ground: `error`; `role` (what a column can hold) and `asked` (which columns are which); `head`, `table`, `unit_names`.
//! By themselves, what a case prescribes: tables of loads (`loads`), which skip nothing and refuse what is not understood.

mod asked;
mod error;
mod head;
mod loads;
mod loads_layout;
mod role;
mod table;
mod unit_names;

pub use asked::Asked;
pub use error::{MeasuredError, refused};
pub use loads::{Loads, loads};
pub use role::{Kind, Role};
pub use table::{BadRow, Column, Table, read};
pub use unit_names::scales;
