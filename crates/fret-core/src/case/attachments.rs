//! Files a case names beside itself: tables, heights, maps. The core opens none; whoever hands in the text hands them in too.

use ndarray::Array2;
use toml::Spanned;

use super::judge::Judge;

/// Files and arrays that come with the text of a case.
#[derive(Clone, Copy)]
pub struct Attachments<'a> {
    /// Content of a file by the name the case gives it, or in a few words why it cannot be had.
    pub file: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    /// Arrays handed over, named in the case by their number: `{ array = n }`.
    pub arrays: &'a [Array2<f64>],
}

impl<'a> Attachments<'a> {
    /// For a case that comes alone: every file is missing.
    pub fn none() -> Self {
        Self::files(&|_| Err("this case was read without a place to look for files".to_owned()))
    }

    /// Files only.
    pub fn files(file: &'a dyn Fn(&str) -> Result<Vec<u8>, String>) -> Self {
        Self { file, arrays: &[] }
    }
}

impl Judge<'_> {
    /// Content of a file the case names under `key`; refused, with the reason, when it cannot be had.
    pub(super) fn attached(&mut self, key: &str, name: &Spanned<String>) -> Option<Vec<u8>> {
        match (self.attachments.file)(name.get_ref()) {
            Ok(content) => Some(content),
            Err(reason) => self.refuse(
                name.span(),
                format!("{key} = {:?}: {reason}", name.get_ref()),
                "a file's name is relative to the case file",
            ),
        }
    }

    /// The same as text.
    pub(super) fn attached_text(&mut self, key: &str, name: &Spanned<String>) -> Option<String> {
        let content = self.attached(key, name)?;
        match String::from_utf8(content) {
            Ok(text) => Some(text),
            Err(error) => {
                let place = error.utf8_error().valid_up_to();
                let message = format!(
                    "{key} = {:?}: not a text in UTF-8 (byte {place} is not part of a letter)",
                    name.get_ref()
                );
                self.refuse(name.span(), message, "")
            }
        }
    }
}
