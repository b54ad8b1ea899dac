//! From text to a case: read in one pass (`document`), then judged (`check`).

use toml::de::DeValue;

use super::attachments::Attachments;
use super::check;
use super::definition::Case;
use super::file::CaseFile;
use crate::document::{Mistake, Read, Reader, Refusal as CaseError, Written, toml_of, written};

/// More mistakes than this are not looked for.
const MOST_MISTAKES: usize = 30;

pub(super) fn case(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Case, CaseError> {
    let root = written(text, name)?;
    if let Some(mistake) = of_another_kind(&root) {
        return Err(CaseError::new(name, text, vec![mistake]));
    }
    let mut reader = Reader::default();
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

/// A sweep is no case: one mistake, not one of each key.
fn of_another_kind(root: &Written<'_>) -> Option<Mistake> {
    let DeValue::Table(keys) = root.get_ref() else { return None };
    let (base, _) = keys.iter().find(|(key, _)| key.get_ref() == "base")?;
    let has_none = ["grid", "load"].iter().all(|&key| !keys.contains_key(key));
    has_none.then(|| {
        Mistake::new("a sweep over cases, not a case: it has a `base`", "`fret sweep FILE` solves its points")
            .at(base.span())
    })
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

#[cfg(test)]
mod tests;
