//! How a surface answers a unit traction: on one cell of a grid, or in one wave.

pub mod collocation;
pub mod frequency_response;
pub mod influence;
pub mod line_influence;
pub mod pair_response;
pub mod periodic;
pub mod repeated_influence;
pub mod response_table;
pub mod sampled;
pub mod sublayers;

pub(crate) mod complex;
pub(crate) mod compliance_below;
pub(crate) mod depth_cells;
pub(crate) mod depth_periodic;
pub(crate) mod depth_response;
pub(crate) mod layer;
pub(crate) mod layer_constants;
pub(crate) mod line_depth;
pub(crate) mod matrix;
pub(crate) mod stack_layer;

mod aliases;
mod axis_waves;
mod bessel;
mod cell_integrals;
mod cell_rules;
mod cells;
#[cfg(test)]
mod closed_form;
mod constant_kernels;
mod datum;
mod far_cells;
mod hankel_lattice;
mod homogeneous;
mod interpolation;
mod lattice_samples;
mod line_kernels;
mod panels;
pub(crate) mod quadrature;
mod quartets;
mod radial;
mod repeated;
#[cfg(test)]
pub(crate) mod samples;
#[cfg(test)]
mod third_party;
mod with_change;

pub use collocation::cells_too_coarse_for_incompressible_film;
pub use frequency_response::{FrequencyResponse, Response};
pub use influence::{
    Components, InfluenceCoefficients, coefficients_by, coefficients_of, influence_coefficients,
};
pub use lattice_samples::ResponseChange;
pub(crate) use lattice_samples::{BelowSurface, DepthChange};
pub use line_influence::{line_coefficients, line_coefficients_by, line_coefficients_of};
pub use pair_response::PairResponse;
pub use periodic::{PeriodicSymbols, periodic_symbols, symbols_by, symbols_of, uniform_response};
pub use repeated_influence::repeated_coefficients;
pub use response_table::ResponseTable;
pub use sampled::sampled_coefficients;
pub use stack_layer::LayerChanges;
pub use sublayers::{SublayerError, layered_half_space};
