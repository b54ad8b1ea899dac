//! Units: those that a case declares (`system`), those that heads of tables and logs name (`heading`), and how many of the one are one of the
//! other (`conversion`); prefixes of both (`prefixes`), and names written out (`spelled`).

mod conversion;
mod heading;
mod prefixes;
mod spelled;
mod system;

pub use conversion::{Conversion, UnitError, conversion, is_of_another, is_unit, known_units};
pub use heading::Heading;
pub use spelled::symbol_of;
pub use system::Units;
