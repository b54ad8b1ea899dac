//! Fretting contact of coated elastic bodies: pressure, shear, stick and slip through the whole loading history.

pub mod analytic;
pub mod case;
pub mod checkpoint;
pub mod compliance;
pub mod cycle;
mod edge;
pub mod footprint;
mod fretting_loop;
pub mod history;
pub mod kernel;
pub mod machine;
pub mod model;
pub mod plan;
pub mod plausibility;
#[cfg(test)]
#[path = "../../../tests/random.rs"]
#[expect(dead_code, reason = "the tests of the whole use all of it")]
mod random;
mod recording;
mod refinement;
mod run_error;
pub mod simulation;
pub mod solver;
pub mod start;
mod stepping;
pub mod study;
pub mod subsurface;
pub mod warning;
pub mod wear;
