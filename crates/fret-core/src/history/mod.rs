//! What a run leaves behind: records of increments and cycles, kept fields, warnings, and the state that another history may start
//! from.

mod cycle;
mod footprint;
mod records;
mod start;
pub mod warning;

pub use crate::solver::{Regime, Residual, Work};
pub use cycle::{CycleRecord, CycleRegime, Drive, RunningCondition, SLIDING_ENERGY_RATIO, running_condition};
pub use footprint::Footprint;
pub use records::{History, KeptFields, StepRecord, WornThrough};
pub use start::Start;
pub use warning::{Concern, Warning};
