//! How well a scene is known for how much time: quantities of interest between the cells, error bars from a coarser companion, and
//! refinement studies judged by closed forms or by their own limit.
//!
//! A quantity of interest is what a person reads off a run. Three forms of it are compared: as the cells have it (`Plain`), read
//! between the cells (`Between`), and extrapolated with the next coarser grid (`Extrapolated`).

mod advice;
mod closed_form;
mod errors;
mod estimate;
mod expectation;
mod level;
mod limit;
mod means;
mod normal_form;
mod partial_slip;
mod peak;
mod quantities;
mod radial_table;
mod reference;
mod refinement_study;
mod resolutions;
mod unbounded;
mod variation;

pub use advice::{Advice, advice, frontier};
pub use closed_form::ClosedForm;
pub use errors::{Errors, Form, errors, orders};
pub use estimate::{Bar, Bars, companion, error_bars, resolved};
pub use expectation::{Expectation, expectation};
pub use level::{Ends, Level, solved_ends, solved_level};
pub use normal_form::{NormalForm, Pressed};
pub use partial_slip::{Loaded, PartialSlip, TangentialForm};
pub use peak::peak_pressure;
pub use quantities::{PerQuantity, Quantity, QuantityReader, StageQuantities};
pub use reference::{Convergence, Reference, Source};
pub use refinement_study::{Judged, Line, RefinementStudy};
pub use resolutions::{Kind, Place, ResolutionError, Resolutions};
pub use unbounded::{pressure_is_unbounded, pressure_of_run_is_unbounded};
pub use variation::{Variation, VariationError};
