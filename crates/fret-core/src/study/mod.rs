//! How well a scene is known for how much time: headline numbers between the cells, error bars from a coarser companion, and
//! ladders of refinement judged by closed forms or by their own limit.
//!
//! A headline number is what a person reads off a run. Three forms of it are compared: as the cells have it (`Plain`), read
//! between the cells (`Between`), and extrapolated with the next coarser grid (`Extrapolated`).

mod advice;
mod climb;
mod closed_form;
mod errors;
mod estimate;
mod expectation;
mod headline;
mod ladder;
mod limit;
mod means;
mod peak;
mod rung;
mod truth;
mod variation;

pub use advice::{Advice, advice, frontier};
pub use climb::{Climb, Judged, Line};
pub use closed_form::ClosedForm;
pub use errors::{Errors, Form, errors, orders};
pub use estimate::{Bar, Bars, companion, error_bars, resolved};
pub use expectation::{Expectation, expectation};
pub use headline::{Headline, Quantity};
pub use ladder::{Kind, Ladder, LadderError, Place};
pub use peak::peak_pressure;
pub use rung::{Rung, climbed};
pub use truth::{Source, Truth};
pub use variation::{Variation, VariationError};
