//! A study of one case, as it is asked for and as it is told: references from a file, its record, tables, the picture.

pub mod levels;
pub mod picture;
pub mod record;
pub mod reference;
pub mod table;
pub mod words;
