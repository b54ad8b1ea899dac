//! From measured fretting loops to the constants of a model: friction coefficient, stiffness of the rig, one number of the case. And from a
//! measured indentation to moduli, thicknesses and other numbers of the case.
//!
//! From the ground: `request` and `error`; `log` (which columns there are); `turns` of a signal,
//! `cycles` (which are whole), `direction`, `drift`; `computed` (a loop between its points), `model` (the loop that the solver computes),
//! `flanks`, `quantities` (what is read from a cycle); `start`, `intervals`, `feet` (of points on a loop), `loops` (exact and coarse), `fit` (least squares), `found`, `repeated` (over
//! the cycles); the answer in `identification`, `conditions` (partial or gross slip, over the cycles). Beside it, for numbers of a case from load over depth, `indentation`: `request`; `load_curve`, `indenter` (the curve that the
//! solver computes), `log` (which rows are fitted), `start`, `fit` with `feet`, `scaling` and `sureness`, `notes`; the answer in `indentation` itself.

mod computed;
mod conditions;
mod cycles;
mod direction;
mod drift;
mod error;
mod feet;
mod fit;
mod flanks;
mod found;
mod identification;
mod indentation;
mod intervals;
mod log;
mod loops;
mod model;
mod quantities;
mod repeated;
mod request;
mod start;
#[cfg(test)]
mod tests;
mod turns;

pub use conditions::Span;
pub use cycles::{Fault, MeasuredCycle};
pub use direction::Direction;
pub use error::IdentifyError;
pub use found::Constant;
pub use identification::{Cycle, Identification, Removed, identify};
pub use indentation::{Indentation, IndentationRequest, Numbers, Part, indentation};
pub use quantities::Quantities;
pub use repeated::RepeatedFit;
pub use request::{Key, Request};
