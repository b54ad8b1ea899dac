//! From text to a case: read in one pass (`document`), then judged (`check`).

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::attachments::Attachments;
use super::check;
use super::definition::Case;
use super::file::CaseFile;
use super::refusal::CaseError;
use crate::document::{Mistake, Read, Reader};

/// More mistakes than this are not looked for.
const MOST_MISTAKES: usize = 30;

/// Deeper tables than a case can have are refused before anything walks them.
const DEEPEST: usize = 16;

/// Longer texts are not cases.
const LONGEST: usize = 4 << 20;

/// Texts with more tables and lists are not cases.
const MOST_BRACKETS: usize = 100_000;

/// Refuses a text that is longer, or has more tables, than `what` in `name` ever has: before it is parsed, which takes long.
///
/// # Errors
/// When it is.
pub fn refuse_too_long(text: &str, name: &str, what: &str) -> Result<(), CaseError> {
    if text.len() > LONGEST {
        let message = format!("{} bytes: {what} has at most {LONGEST}", text.len());
        return Err(CaseError::plain(name, message));
    }
    if text.bytes().filter(|byte| matches!(byte, b'[' | b'{')).count() > MOST_BRACKETS {
        return Err(CaseError::plain(name, format!("more than {MOST_BRACKETS} brackets: not {what}")));
    }
    Ok(())
}

pub(super) fn case(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Case, CaseError> {
    refuse_too_long(text, name, "a case file")?;
    let root = DeTable::parse(text).map_err(|error| {
        let span = error.span();
        let found = span.clone().and_then(|span| text.get(span)).and_then(without_comma);
        let why = if found.is_some() { "a comma is missing between numbers" } else { error.message() };
        let message = format!("not readable as TOML: {why}");
        CaseError::new(name, text, vec![Mistake { message, help: found, span }])
    })?;
    if depth(root.get_ref()) > DEEPEST {
        return Err(CaseError::plain(name, format!("tables nested deeper than {DEEPEST}: not a case")));
    }
    let mut reader = Reader::default();
    let root = Spanned::new(root.span(), DeValue::Table(root.into_inner()));
    let file = CaseFile::read(&root, &mut reader);
    let (mut mistakes, places) = reader.end();
    mistakes.truncate(MOST_MISTAKES);
    // Without one of the tables that every case has, the rest is not judged.
    let file = match file {
        Ok(file) if mistakes.len() < MOST_MISTAKES => file,
        _ => return Err(CaseError::new(name, text, mistakes)),
    };
    match check::case(file, (name, text), attachments, &places) {
        Ok(case) if mistakes.is_empty() => Ok(case),
        Ok(_) => Err(CaseError::new(name, text, mistakes)),
        Err(found) => {
            let follows = |mistake: &Mistake| mistake.span.as_ref().is_some_and(|span| places.follows(span));
            mistakes.extend(found.into_iter().filter(|mistake| !follows(mistake)));
            Err(CaseError::new(name, text, mistakes))
        }
    }
}

/// Numbers with blanks between them, as a list has them: with commas.
fn without_comma(text: &str) -> Option<String> {
    let parts: Vec<&str> = text.split_whitespace().collect();
    let are_numbers = parts.iter().all(|part| part.parse::<f64>().is_ok());
    (parts.len() > 1 && are_numbers).then(|| parts.join(", "))
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

impl Case {
    /// Reads and checks a case from TOML text that names no other files. `name` stands in messages (a file name).
    ///
    /// # Errors
    /// With every mistake found, each with its place and a way out.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_toml_with(text, name, Attachments::none())
    }

    /// As [`Case::from_toml`]; `attachments` hands in the files and arrays the case names.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_toml_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        case(text, name, attachments)
    }

    /// Reads and checks a case given as JSON text of the same structure; messages show it as TOML.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when the text is not a JSON object.
    pub fn from_json(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_json_with(text, name, Attachments::none())
    }

    /// As [`Case::from_json`]; `attachments` hands in the files and arrays the case names. The n-th array stands in the case as
    /// `{ "array": n }`.
    ///
    /// # Errors
    /// As [`Case::from_json`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_json_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        let refuse = |message: String| CaseError::plain(name, message);
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| refuse(format!("not readable as JSON: {error}")))?;
        let text = toml_of(&value).map_err(refuse)?;
        Self::from_toml_with(&text, name, attachments)
    }
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

#[cfg(test)]
mod tests;
