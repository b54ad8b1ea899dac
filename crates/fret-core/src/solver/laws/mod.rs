//! The laws of contact and friction, each in one place: complementarity of gap and pressure, Coulomb's law of friction, the rigid
//! motions of the bodies, and the projection of tractions onto what the laws allow.

pub mod active_sets;
pub mod complementarity;
pub mod friction;
pub mod limit;
mod motion_by_force;
pub mod projection;
pub mod rigid_motions;
pub mod slip;
pub mod slip_path;
pub mod tilt_motions;
