//! A written document, read once into typed values: every value knows its place, all mistakes of structure and range are collected.
//! `#[derive(Table)]` (`crates/fret-table`) makes a struct a table, an enum of bare variants a word, and one whose variants hold a value a
//! choice. No mechanics, and no relations between keys.

mod at;
mod expression;
mod mistake;
mod parser_words;
mod range;
mod reader;
mod refusal;
mod text;
mod values;
mod words;

pub use at::At;
pub use expression::{Expression, ExpressionError, is_free_name};
pub use fret_table::Table;
pub use mistake::Mistake;
pub use parser_words::in_words;
pub use range::Range;
pub use reader::{Keys, Places, Read, Reader, Reading, TableReader, Written, fault, is_word};
pub use refusal::Refusal;
#[cfg(test)]
pub(crate) use text::{DEEPEST, LONGEST};
pub use text::{refuse_too_long, toml_of, written};
pub use values::Named;
pub use words::{apart, printable, steers};
