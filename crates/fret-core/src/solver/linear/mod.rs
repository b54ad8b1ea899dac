//! The linearised problem on fixed active sets, and its solution: a Krylov method with an approximate inverse in Fourier space.
//! Single precision begins and ends in [`solver`].

mod edge_correction;
mod gmres;
pub mod inverse;
pub mod preconditioner;
pub mod problem;
mod rigid_projector;
pub mod solver;

pub use gmres::Gmres;
