//! The written question: a case, checked. Read from TOML text (`read`), judged all at once (`check`), refused with places (`refusal`).

mod arrays;
mod attachments;
mod bodies;
pub(crate) mod check;
mod coating;
mod controls;
mod course;
mod definition;
mod file;
mod friction;
mod judge;
mod numbers;
mod output;
mod pair;
mod read;
mod refusal;
mod repeating;
mod shape;
mod stage_file;
mod stages;
mod stress;
mod surface_file;
mod table;
mod wearing;
mod wording;

pub use attachments::{Attachments, content, unreadable};
pub(crate) use course::walk;
pub use course::{Course, Cycles, Path, Stage, StageControl, Waveform};
pub use definition::{Case, GridSize};
pub use file::schema;
pub use numbers::{NumbersError, numbers};
pub use output::{FIELD_NAMES, Output};
pub use refusal::{CaseError, Difference, Mistake};
pub(crate) use stages::apart;
pub use stress::{FatigueRequest, Side, StressRequest};
pub use wording::{in_words, printable};
