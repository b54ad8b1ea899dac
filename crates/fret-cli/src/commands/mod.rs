//! The verbs of `fret`, one file each, with what they need beside.

pub mod check;
mod crack;
pub mod explain;
pub mod export;
mod fatigue;
pub mod heat;
pub mod heat_record;
pub mod identify;
pub mod init;
mod loaded_surfaces;
pub mod plan;
pub mod preparation;
pub mod report;
pub mod run;
pub mod run_observer;
pub mod schema;
pub mod sensitivity;
pub mod shells;
pub mod stress;
pub mod stress_kinds;
pub mod stress_record;
mod stress_tables;
pub mod study;
pub mod sweep;
