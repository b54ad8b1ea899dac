//! Many cases: the written question of a sweep (`question`), what a key of an axis names (`key`), what a point came to
//! (`answer`), the open ones planned, with what they have in common (`planned`), the folder that keeps it (`folder`); samples of uncertain
//! keys (`drawn`) and what they say (`spread`).

mod answer;
mod drawn;
mod folder;
pub mod key;
mod planned;
mod question;
mod spread;

pub use answer::Answer;
pub use folder::SweepFolder;
pub use planned::Planned;
pub use question::{Point, Question};
pub use spread::Spread;
