//! What a run leaves behind: records of increments and cycles, kept fields, warnings, and the state that another history may start
//! from.

mod columns;
pub mod concern;
mod cycle;
mod cycle_columns;
mod field_names;
mod footprint;
mod records;
mod start;
mod warning;

pub use crate::solver::{Regime, Residual, Work};
pub use columns::{Column, RollingColumn, STEP_COLUMNS, Value, rolling_columns};
pub use concern::{Concern, RING_CELLS, RING_FRACTION, RING_SHEAR, STIFFEST};
pub use cycle::{CycleRecord, CycleRegime, Drive, RunningCondition, SLIDING_ENERGY_RATIO, running_condition};
pub use cycle_columns::CYCLE_COLUMNS;
pub use field_names::{FIELDS, Field, FieldValues, ZONE_WORDS};
pub use footprint::Footprint;
pub(crate) use footprint::faces_between;
pub use records::{
    DebrisRecord, History, KeptFields, PlasticRecord, StepRecord, WornByLayer, WornThrough, WornTo,
};
pub use start::Start;
pub(crate) use start::{setting, way_of_solving};
pub use warning::Warning;
