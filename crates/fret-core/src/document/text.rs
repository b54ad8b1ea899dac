//! The text of a document, from its letters to its tables; documents in JSON as TOML.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::mistake::Mistake;
use super::reader::Written;
use super::refusal::Refusal;

/// Deeper tables than a case can have are refused before anything walks them.
pub const DEEPEST: usize = 16;

/// Longer texts are not cases.
pub const LONGEST: usize = 4 << 20;

/// Texts with more tables and lists are not cases.
const MOST_BRACKETS: usize = 100_000;

/// Refuses a text that is longer, or has more tables, than `what` in `name` ever has: before it is parsed, which takes long.
///
/// # Errors
/// When it is.
pub fn refuse_too_long(text: &str, name: &str, what: &str) -> Result<(), Refusal> {
    if text.len() > LONGEST {
        let message = format!("{} bytes: {what} has at most {LONGEST}", text.len());
        return Err(Refusal::plain(name, message));
    }
    if text.bytes().filter(|byte| matches!(byte, b'[' | b'{')).count() > MOST_BRACKETS {
        return Err(Refusal::plain(name, format!("more than {MOST_BRACKETS} brackets: not {what}")));
    }
    Ok(())
}

/// The tables of a case.
///
/// # Errors
/// When the text is longer than a case, is no TOML, or has deeper tables than a case.
pub fn written<'d>(text: &'d str, name: &str) -> Result<Written<'d>, Refusal> {
    refuse_too_long(text, name, "a case file")?;
    let root = DeTable::parse(text).map_err(|error| {
        let missing = error.span().and_then(|span| missing_comma(text, error.message(), span));
        let mistake = missing.unwrap_or_else(|| Mistake {
            message: error.message().to_owned(),
            help: None,
            span: error.span(),
        });
        let message = format!("not readable as TOML: {}", mistake.message);
        Refusal::new(name, text, vec![Mistake { message, ..mistake }])
    })?;
    if depth(root.get_ref()) > DEEPEST {
        return Err(Refusal::plain(name, format!("tables nested deeper than {DEEPEST}: not a case")));
    }
    Ok(Spanned::new(root.span(), DeValue::Table(root.into_inner())))
}

/// Numbers with blanks between them, as a list has them: with commas.
fn without_comma(text: &str) -> Option<String> {
    let parts: Vec<&str> = text.split_whitespace().collect();
    let are_numbers = parts.iter().all(|part| part.parse::<f64>().is_ok());
    (parts.len() > 1 && are_numbers).then(|| parts.join(", "))
}

/// What the parser says of a comma that is missing, in the words of a case file: between numbers, entries of a list or keys of a table.
fn missing_comma(text: &str, message: &str, span: Range<usize>) -> Option<Mistake> {
    if let Some(numbers) = text.get(span.clone()).and_then(without_comma) {
        let message = "a comma is missing between numbers".to_owned();
        return Some(Mistake { message, help: Some(numbers), span: Some(span) });
    }
    let before = |what: &str, place: Range<usize>| {
        let message = format!("a comma is missing between {what}");
        let word = text.get(place.clone()).filter(|word| !word.is_empty());
        Some(Mistake { message, help: word.map(|word| format!(", {word}")), span: Some(place) })
    };
    let is_of_key = |letter: char| letter.is_alphanumeric() || "_-.".contains(letter);
    let word_at = |start: usize| {
        let length = text.get(start..).and_then(|rest| rest.find(|letter| !is_of_key(letter)));
        start..start + length.unwrap_or(0)
    };
    if message.starts_with("missing comma between array elements") {
        return before("entries of a list", word_at(span.start));
    }
    if message.starts_with("missing comma between key-value pairs") {
        return before("keys of a table", word_at(span.start));
    }
    // A number and the key behind it are one word to the parser, with a second `=` behind it.
    let value_and_key = text.get(..span.start)?.trim_end().rsplit('=').next()?;
    let (value, key) = value_and_key.rsplit_once(char::is_whitespace)?;
    let is_meant = message.starts_with("extra assignment between key-value pairs")
        && !value.trim().is_empty()
        && key.chars().all(is_of_key);
    let end = text.get(..span.start)?.trim_end().len();
    if is_meant { before("keys of a table", end - key.len()..end) } else { None }
}

fn depth(table: &DeTable<'_>) -> usize {
    fn of_value(value: &DeValue<'_>) -> usize {
        match value {
            DeValue::Array(items) => 1 + items.iter().map(|item| of_value(item.get_ref())).max().unwrap_or(0),
            DeValue::Table(table) => depth(table),
            _ => 0,
        }
    }
    1 + table.iter().map(|(_, value)| of_value(value.get_ref())).max().unwrap_or(0)
}

/// A case given as JSON, as TOML text of the same structure.
///
/// # Errors
/// With a reason, when the value is no table.
pub fn toml_of(value: &serde_json::Value) -> Result<String, String> {
    let table =
        toml::Table::try_from(without_null(value.clone())).map_err(|error| format!("not a case: {error}"))?;
    toml::to_string(&table).map_err(|error| format!("not a case: {error}"))
}

/// JSON's null means "not given"; TOML has no word for it.
fn without_null(value: serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Object(map) => Value::Object(
            map.into_iter().filter(|(_, v)| !v.is_null()).map(|(k, v)| (k, without_null(v))).collect(),
        ),
        Value::Array(items) => Value::Array(items.into_iter().map(without_null).collect()),
        other => other,
    }
}
