//! Uncertain inputs and what they make of results: distributions, Sobol' points, quantiles, Sobol' indices. No mechanics.

pub mod distribution;
pub mod first_order;
pub mod sample_design;
pub mod sensitivity;
pub mod statistics;

pub use distribution::{Distribution, DistributionError};
pub use first_order::{FirstOrder, first_order};
pub use sample_design::{DesignError, MOST_SAMPLES, SampleDesign};
pub use sensitivity::{Sensitivity, sensitivity};
pub use statistics::{QUANTILES, Statistics, statistics};
