//! Files of instruments: read by whoever carries the command and can; the program alone cannot.

use std::path::Path;
use std::sync::OnceLock;

use fret_core::case::Scan;

/// Reads the heights of an instrument's file, of a channel by its name or of the first with heights.
///
/// # Errors
/// In words, why it cannot.
pub type ReadInstrument = fn(&Path, Option<&str>) -> Result<Scan, String>;

/// One for the whole process, as an extension of Python is: every verb, also those that read many cases, has the same.
static READER: OnceLock<ReadInstrument> = OnceLock::new();

/// Files of instruments are read by `reader` from now on; a second one changes nothing.
pub fn read_instruments_by(reader: ReadInstrument) {
    let _ = READER.set(reader);
}

/// The reader, where there is one.
pub fn reader() -> Option<ReadInstrument> {
    READER.get().copied()
}
