//! Units: those that a case declares (`system`), those that heads of tables and logs name (`heading`), and how many of the one are one of the
//! other (`conversion`); prefixes of both (`prefixes`).

mod conversion;
mod heading;
mod prefixes;
mod system;

pub use conversion::{Conversion, UnitError, conversion, is_unit, known_units};
pub use heading::Heading;
pub use system::Units;
