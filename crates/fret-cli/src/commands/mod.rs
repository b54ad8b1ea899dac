//! The verbs of `fret`, one room each.

pub mod check;
pub mod export;
pub mod extremes;
pub mod fatigue;
pub mod plan;
pub mod report;
pub mod run;
pub mod schema;
pub mod stress;
pub mod study;
pub mod sweep;
