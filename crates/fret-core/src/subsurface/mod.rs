//! What happens under the surface: stress and displacement at depth from the tractions of a contact, what engineers judge
//! them by, and how a load cycle wears the material out.
//!
//! Axes: x and y of the contact, z INTO the body in question, from its own surface. Tension is positive. The shear given is
//! what acts on the body: on the lower body the contact's shear, on the upper one minus it.

mod at_depth;
pub mod coating_fracture;
pub mod crack;
pub mod crack_path;
pub mod critical_distance;
pub mod depths;
pub mod edge_crack;
pub mod even;
pub mod fatigue;
pub mod film_stress;
pub mod largest;
pub mod operator;
pub mod rim;
pub mod severity;
mod slopes;
pub mod survey;
pub mod tensor;

pub use depths::{AUTOMATIC, DepthError, DepthPoint, automatic_depths, deeper, depth_points, reach};
pub use even::EvenStress;
pub use largest::{Largest, Measure};
pub use operator::{DepthOperator, Tractions, change_of_stress};
pub use severity::{Judged, MostSevere, Severity};
pub use survey::{LoadedSurface, displacements, survey};
pub use tensor::{Principal, StressField, StressTensor};
