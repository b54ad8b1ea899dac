//! Closed-form contact solutions, for users to plot and for tests to judge by. Nothing here discretises a surface.
//!
//! Signs: pressure and approach are positive in compression; shear, shift and tangential force are those of the upper body on the
//! lower; stresses are positive in tension. Any consistent unit system. The effective moduli come from [`EffectiveModuli`].

mod catalogue;
mod cattaneo_line;
mod cattaneo_mindlin;
mod cone;
mod elliptic_integrals;
mod error;
mod flat_punch;
mod form;
mod hertz;
mod hertz_ellipse;
mod hertz_line;
mod line_history;
mod mindlin_deresiewicz;
mod moduli;
mod no_slip;
mod parameter;
mod quadrature;
mod root;
mod rounded_punch;
mod sliding_cylinder;
mod spence;
mod stretched_sphere;
mod tangential_history;
mod thick_layer;
mod thin_layer;
mod tilted_punch;
mod torsion;
mod westergaard;

pub use catalogue::FORMS;
pub use cattaneo_line::{CattaneoLine, StretchedLine};
pub use cattaneo_mindlin::CattaneoMindlin;
pub use cone::Cone;
pub use elliptic_integrals::CompleteElliptic;
pub use error::AnalyticError;
pub use flat_punch::FlatPunch;
pub use form::{Contents, Entry, Form, Function, Functions, Numbers, Solved};
pub use hertz::Hertz;
pub use hertz_ellipse::HertzEllipse;
pub use hertz_line::HertzLine;
pub use line_history::LineHistory;
pub use mindlin_deresiewicz::{Branch, LoopPoint, MindlinDeresiewicz};
pub use moduli::EffectiveModuli;
pub use no_slip::{NoSlipPunch, NoSlipSphere};
pub use parameter::{Kind, Parameter};
pub use rounded_punch::RoundedPunch;
pub use sliding_cylinder::SlidingCylinder;
pub use spence::{SPENCE_TABLE, SpencePoint, half_plane_friction, half_plane_stick_ratio};
pub use stretched_sphere::{EquibiaxialSphere, StretchedSphere};
pub use tangential_history::TangentialHistory;
pub use thick_layer::ThickLayer;
pub use thin_layer::ThinLayer;
pub use tilted_punch::{TiltedLinePunch, TiltedPunch};
pub use torsion::Torsion;
pub use westergaard::Westergaard;
