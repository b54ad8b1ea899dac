//! A study of one case, as it is asked for and as it is told: references from a file, tables, the picture.

pub mod levels;
pub mod picture;
pub mod reference;
pub mod table;
pub mod words;
