//! Many cases: the written question of a sweep (`question`), what a key of an axis names (`key`) and the kind of its quantity (`kinds`), what a point came to
//! (`answer`) and its numbers by name (`columns`), the open ones planned, with what they have in common (`planned`), the folder that keeps
//! it (`folder`, its `record`), what the workers share (`board`), what a case asks for besides its numbers (`besides`), the units that its numbers are told in (`setting`); samples of uncertain keys (`drawn`) and what they say (`spread`).

mod answer;
mod besides;
mod board;
pub mod columns;
mod drawn;
mod folder;
pub mod key;
pub mod kinds;
mod planned;
mod question;
pub mod record;
pub mod setting;
mod spread;

pub use answer::{Answer, Counts, Path, last_cycle};
pub use board::Board;
pub use folder::{Kept, POINTS, RECORD, SweepFolder, UNCERTAINTY};
pub use question::{Point, Question};
pub use record::SweepRecord;
pub use spread::{Quantities, QuantityRecord, Spread, SpreadRecord};
