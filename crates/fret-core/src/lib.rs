//! Fretting contact of coated elastic bodies: pressure, shear, stick and slip through the whole loading history.

pub mod analytic;
pub mod case;
pub mod compliance;
mod fields;
pub mod history;
pub mod kernel;
pub mod machine;
pub mod model;
pub mod plan;
#[cfg(test)]
#[path = "../../../tests/random.rs"]
#[expect(dead_code, reason = "the tests of the whole use all of it")]
mod random;
pub mod run;
pub mod solver;
pub mod study;
pub mod subsurface;
