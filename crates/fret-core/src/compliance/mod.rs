//! The elastic response of the pair: tractions in, relative surface displacements out.
//! The one place where kernels meet components and signs: z into the lower body, displacements lower minus upper.

mod cell_response;
#[cfg(test)]
mod conformance;
mod cross_spectra;
mod direct;
mod operator;
pub(crate) mod product;
mod spectral;
mod surface_response;

pub use cell_response::CellResponse;
pub use cross_spectra::CrossSpectra;
pub use direct::DirectCompliance;
pub use operator::{OperatorSet, SelfInfluence, SinglePrecisionOperator, SurfaceCompliance};
pub use product::SharedWorkspace;
pub use spectral::SpectralCompliance;
pub(crate) use spectral::{NORMAL_BLOCKS, TANGENTIAL_BLOCKS};
pub use surface_response::SurfaceResponse;
pub(crate) use surface_response::mirrors;
