//! Heat and electric current through the contact of a solved history, steady: the temperature rise by friction, and the resistance of
//! the contact. Linear problems on the cells in contact, with the layered response of both bodies.
//!
//! Lower body before upper body in every pair.

pub mod contact_resistance;
pub mod friction_heat;
pub mod potential;
pub mod surface_temperature;

pub use contact_resistance::contact_resistance;
pub use friction_heat::{HeatedSurface, SlipOfCycle, friction_heat, slip_of_cycle};
pub use potential::{ConductionError, Potential};
pub use surface_temperature::{SurfaceTemperature, surface_temperature};
