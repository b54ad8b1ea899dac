//! A study of one case, as it is asked for (`question`, references from a file), solved (`studied`, its kept `levels`) and told: its record, tables, words, the picture.

pub mod levels;
pub mod picture;
pub mod question;
pub mod record;
mod reference;
pub mod studied;
pub mod table;
pub mod words;
