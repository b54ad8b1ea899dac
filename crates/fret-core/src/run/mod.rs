//! A run: the planned history solved increment by increment, with an observer that may stop it and checkpoints from which it goes on.

mod beginning;
mod checkpoint;
mod debris;
mod evolving;
mod fretting_loop;
mod in_common;
mod journey;
mod loop_reading;
mod moving;
mod observer;
mod pair_compliance;
mod plastic;
pub mod plausibility;
mod recording;
mod records;
mod refinement;
mod rim;
mod rings;
mod rolling;
mod run_error;
mod simulation;
mod slip_increment;
mod steady;
mod stepping;
mod stiffest_wave;
mod strides;
mod surfaces;
mod thinning;
mod wear;

pub use checkpoint::{Checkpoint, CheckpointError, Waypoint};
pub use in_common::{InCommon, beginnings};
pub use observer::{Iteration, Observer, Silent};
pub(crate) use pair_compliance::PairCompliance;
pub use run_error::RunError;
pub use simulation::Simulation;
