//! The verbs of `fret`, one room each.

pub mod check;
mod fatigue;
pub mod plan;
pub mod run;
pub mod schema;
pub mod stress;
