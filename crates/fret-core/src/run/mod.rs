//! A run: the planned history solved increment by increment, with an observer that may stop it and checkpoints from which it goes on.

mod beginning;
mod checkpoint;
mod fretting_loop;
pub mod plausibility;
mod recording;
mod refinement;
mod run_error;
mod simulation;
mod stepping;
mod wear;

pub use beginning::{Beginning, beginnings};
pub use checkpoint::{Checkpoint, CheckpointError, Waypoint};
pub use run_error::RunError;
pub use simulation::{Iteration, Observer, Silent, Simulation};
