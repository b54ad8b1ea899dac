//! How near a cycle of stress brings a point to fatigue: parameters by invariants (Crossland, Dang Van), on the critical plane
//! (Smith-Watson-Topper, Fatemi-Socie), and of the surface (Ruiz); cycles to initiation from them; elastic shakedown.
//!
//! A cycle is the list of stresses at its increments; its order matters to none of the parameters.

mod ball;
mod constants;
mod critical_plane;
mod invariants;
mod life;
mod parameter;
mod plane_search;
mod shakedown;
mod slopes;
mod surface;

pub use constants::{CrackConstants, FatigueConstants, LayerConstants, StrainLife};
pub use critical_plane::{CriticalPlane, fatemi_socie, smith_watson_topper};
pub use invariants::{Endurance, crossland, dang_van};
pub use life::{cycles_by_fatemi_socie, cycles_by_smith_watson_topper};
pub use parameter::{Bounds, Evaluated, Parameter};
pub use shakedown::{first_yield_strength, shakedown_strength};
pub use slopes::ParameterSlopes;
pub use surface::{Ruiz, RuizParts, SurfacePoint, ruiz};
