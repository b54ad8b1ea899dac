//! Measured heights on their way to the cells of a grid: read from numbers or from an instrument's file (`content`, `scan`), brought to
//! the units of the case (`measured`), then, as the case asks (`keys`), treated (`treated`): holes filled (`fill`), a part cut, the trend
//! removed, filtered (`gaussian`), resampled (`resample`); or numbers that are those of the cells as they come (`cells`). What is wrong
//! is told by `wrong`.

mod cells;
mod content;
mod keys;
mod measured;
mod question;
mod scan;
mod treated;
mod wrong;

pub use cells::{Cells, Layout, fitting};
pub use content::{Content, FILL, content};
pub use keys::TreatmentFile;
pub use question::Question;
pub use scan::{ReadScan, Scan};
pub use treated::Treated;
