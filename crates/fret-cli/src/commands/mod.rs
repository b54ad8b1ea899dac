//! The verbs of `fret`, one room each.

pub mod check;
pub mod plan;
pub mod run;
pub mod schema;
pub mod sweep;
