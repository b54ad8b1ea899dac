//! Exact sensitivities: derivatives of a history of contact and friction by numbers of its case, without differences of runs.
//!
//! The equations of every increment are linearised on the sets that its solution has (open, stick, slip), and their derivatives carried from
//! increment to increment; local laws are differentiated by dual numbers through the formulas that the solver uses. Theory:
//! `docs/theory/sensitivities.md`.

mod after;
mod bodies;
mod cell;
mod error;
mod events;
mod gradient;
mod krylov;
mod linearised;
mod loads;
mod objective;
mod parameter;
mod refusals;
mod scene;
mod track;

pub use error::SensitivityError;
pub use events::NearEvents;
pub use gradient::{Gradient, Request, Sensitivities, gradient};
pub use objective::COLUMNS;
pub use parameter::Parameter;
