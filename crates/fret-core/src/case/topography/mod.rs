//! Measured heights on their way to the cells of a grid: read from numbers or from an instrument's file (`content`, `scan`), brought to
//! the units of the case (`measured`), then, as the case asks (`keys`), treated (`treated`): holes filled (`fill`), a part cut, the trend
//! removed, filtered (`gaussian`), resampled (`resample`).

mod content;
pub(super) mod keys;
mod measured;
mod question;
mod scan;
mod treated;

pub(super) use content::{Content, FILL, content};
pub(super) use question::{Measured, Question};
pub use scan::Scan;
pub(super) use treated::Treated;
