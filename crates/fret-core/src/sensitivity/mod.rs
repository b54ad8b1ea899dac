//! Exact sensitivities: derivatives of a history of contact and friction by numbers of its case, without differences of runs.
//!
//! The equations of every increment are linearised on the sets that its solution has (open, stick, slip), and their derivatives carried from
//! increment to increment, forward by each number or backwards from each result (`increment.rs`); local laws are differentiated through the
//! formulas that the solver uses, written for numbers of any kind. Theory: `docs/theory/sensitivities.md`.

mod after;
mod backward;
mod below;
mod beneath;
mod block;
mod bodies;
mod case_number;
mod cell;
mod cell_rows;
mod change;
mod collected;
mod coming;
mod constants;
mod contact;
mod cycle_loop;
mod energies;
mod error;
mod events;
mod evolution;
mod field_weights;
mod fields;
mod forward;
mod friction_change;
mod gradient;
mod increment;
mod krylov;
mod largest;
mod linearised;
mod loads;
mod named_number;
mod objective;
mod operators;
mod parameter;
mod past;
mod refusals;
mod replay;
mod row;
mod ruiz;
mod rule;
mod scene;
mod settling;
mod slip;
mod snapshot;
mod solved;
mod strain;
#[cfg(test)]
mod tests;
mod transposed;
mod work;

pub use error::SensitivityError;
pub use events::NearEvents;
pub use field_weights::FIELDS;
pub use gradient::{
    Direction, Gradient, Request, Sensitivities, Weights, check_asked, gradient, pulled_back,
};
pub use objective::{COLUMNS, check_name};
pub use parameter::Parameter;
pub use work::Work;
