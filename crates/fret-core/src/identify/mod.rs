//! From measured fretting loops to the constants of a model: friction coefficient, stiffness of the rig, one number of the case. And from a
//! measured indentation to moduli, thicknesses and other numbers of the case.
//!
//! From the ground: `request` and `error`; `log` (which columns there are); `turns` of a signal,
//! `cycles` (which are whole), `direction`, `drift`; `computed` (a loop between its points), `model` (the loop that the solver computes),
//! `flanks`, `quantities` (what is read from a cycle); `start`, `intervals`, `fit` (least squares), `found`; the answer in
//! `identification`. Beside it, for numbers of a case from load over depth: `indentation_request`; `load_curve`, `indenter` (the curve that the solver computes),
//! `indentation_log` (which rows are fitted), `indentation_fit`; the answer in `indentation`.

mod computed;
mod cycles;
mod direction;
mod drift;
mod error;
mod fit;
mod flanks;
mod found;
mod identification;
mod indentation;
mod indentation_fit;
mod indentation_log;
mod indentation_request;
mod indenter;
mod intervals;
mod load_curve;
mod log;
mod model;
mod quantities;
mod request;
mod start;
#[cfg(test)]
mod tests;
mod turns;

pub use cycles::{Fault, MeasuredCycle};
pub use direction::Direction;
pub use error::IdentifyError;
pub use found::Constant;
pub use identification::{Cycle, Identification, Removed, identify};
pub use indentation::{Indentation, indentation};
pub use indentation_request::{IndentationRequest, Numbers, Part};
pub use quantities::Quantities;
pub use request::{Key, Request};
