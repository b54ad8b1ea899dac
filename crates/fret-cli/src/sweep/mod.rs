//! Many cases: the written question of a sweep (`question`), what a key of an axis names (`key`), what a point came to
//! (`answer`), what points begin with alike (`common`), the folder that keeps it (`folder`); samples of uncertain keys (`drawn`) and what they say (`spread`).

mod answer;
mod common;
mod drawn;
mod folder;
pub mod key;
mod question;
mod spread;

pub use answer::Answer;
pub use common::CommonBeginnings;
pub use folder::SweepFolder;
pub use question::{Point, Question};
pub use spread::Spread;
