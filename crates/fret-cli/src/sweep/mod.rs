//! Many cases: the written question of a sweep (`question`), what a key of an axis names (`key`), what a point came to
//! (`answer`), the folder that keeps it (`folder`).

mod answer;
mod folder;
pub mod key;
mod question;

pub use answer::Answer;
pub use folder::SweepFolder;
pub use question::{Point, Question};
