//! `fret schema`: the JSON Schema of the case file, for editors.

use crate::failure::Failure;
use crate::terminal;

/// Prints the schema.
pub fn schema() -> Result<(), Failure> {
    terminal::answer_in_json(&fret_core::case::schema())
}
