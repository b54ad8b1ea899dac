//! The verbs of `fret`, one file each, with what they need beside.

mod besides;
pub mod check;
mod columns_asked;
pub mod compare_scar;
mod crack;
pub mod explain;
pub mod explore;
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
pub mod shells;
pub mod stress;
pub mod stress_kinds;
pub mod stress_record;
mod stress_tables;
pub mod study;
pub mod sweep;
