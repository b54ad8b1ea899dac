//! Heat and current of a run, as they are told: the record (`heat.json`), and how it is computed.

mod answer;
mod record;

pub use answer::{CONDUCTORS, answered, both, computed};
pub use record::{HeatRecord, Resistance};
