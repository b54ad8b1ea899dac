//! Stresses below the surfaces of a run, as they are told.
//!
//! From the ground: `kinds` (the quantities by name), `record` (`stress.json`), `below` (what all of it is told of), `surfaces` (the kept
//! tractions), `section` (a picture over x and depth), `crack` and `fatigue` (over the last cycle), `tables` (what is collected depth by
//! depth), `answer` (the survey).

mod answer;
mod below;
mod crack;
mod fatigue;
mod kinds;
pub mod record;
mod section;
mod surfaces;
mod tables;

pub use answer::{answered, computed};
pub use kinds::{kind_of_stress, stress_called};
pub use record::{Bounded, CrackRecord, FilmRecord, LargestRecord, ParameterRecord, StressRecord};
pub use section::Section;
