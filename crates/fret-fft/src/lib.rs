//! Discrete Fourier work: products of fields with translation-invariant kernels. Knows no mechanics.
//!
//! [`Convolution`] is the free-space (zero-padded) product, [`PeriodicProduct`] the periodic one. Both are planned once,
//! immutable and shared; the memory they work in is a [`Workspace`], made once and passed in.

mod block;
mod convolution;
mod cross_spectra;
mod engine;
mod fork;
mod fourier;
mod inverse_table;
mod lanes;
mod lengths;
mod line_product;
mod mirrors;
mod parity;
mod periodic_product;
#[cfg(test)]
#[path = "../../../tests/random.rs"]
#[expect(dead_code, reason = "the tests of the whole use all of it")]
mod random;
mod single_product;
mod terms;
#[cfg(test)]
mod tests;
mod workspace;

pub use block::{Block, ConvolutionError, Kernel, Symbol};
pub use convolution::Convolution;
pub use cross_spectra::CrossSpectra;
pub use engine::Engine;
pub use fork::join;
pub use inverse_table::inverse_table;
pub use lengths::good_length;
pub use mirrors::Mirrors;
pub use parity::Parity;
pub use periodic_product::PeriodicProduct;
pub use single_product::SingleProduct;
pub use workspace::Workspace;
