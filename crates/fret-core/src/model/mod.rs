//! The nouns of a contact: grid, bodies, profile, friction, loads, state. No numerics live here.

pub mod bulk;
pub mod conduction;
pub mod friction;
pub mod graded;
pub mod grid;
pub mod half_space;
pub mod heights;
pub mod interface;
pub mod load;
pub mod profile;
pub mod residual;
pub mod rig;
pub mod scheme;
pub mod shape;
pub mod state;
pub mod symmetry;
pub mod wear;

pub use crate::fields::TangentialField;
pub use bulk::{BulkCompliance, bulk_stress_in_layer};
pub use conduction::{ConductingLayer, Conduction, Conductor, ConductorError};
pub use friction::{CellValues, CoulombFriction, FrictionError};
pub use graded::{GradedCoating, GradientError, Layer, YoungGradient};
pub use grid::{GridError, SurfaceGrid};
pub use half_space::{Base, Body, Coating, ContactPair, ElasticMaterial, HalfSpace, MaterialError};
pub use heights::{Detrend, Heights};
pub use interface::{Interface, InterfaceError};
pub use load::{Control, LoadStep};
pub use profile::{BEYOND_THE_BODY, Profile};
pub use residual::{ResidualLayer, ResidualStress};
pub use rig::Rig;
pub use scheme::{Integration, Scheme};
pub use shape::{Axis, ProfileError, Shape};
pub use state::{ContactState, SolvedState, Zone};
pub use symmetry::Symmetry;
pub use wear::{WearLaw, WearRule};
