//! The verbs of `fret`, one file each.

pub mod check;
pub mod compare_scar;
pub mod explain;
pub mod explore;
pub mod export;
pub mod heat;
pub mod identify;
pub mod init;
pub mod plan;
pub mod report;
pub mod run;
pub mod schema;
pub mod sensitivity;
pub mod shells;
pub mod stress;
pub mod study;
pub mod sweep;
