//! Files a case names beside itself: tables, heights, maps. The core opens none; whoever hands in the text hands them in too.

use toml::Spanned;

use super::judge::Judge;

/// Hands in the content of a file by the name the case gives it, or says in a few words why it cannot.
pub type Attachments<'a> = dyn Fn(&str) -> Result<Vec<u8>, String> + 'a;

/// For cases that come alone: every file is missing.
///
/// # Errors
/// Always.
pub fn none(_: &str) -> Result<Vec<u8>, String> {
    Err("this case was read without a place to look for files".to_owned())
}

impl Judge<'_> {
    /// Content of a file the case names under `key`; refused, with the reason, when it cannot be had.
    pub(super) fn attached(&mut self, key: &str, name: &Spanned<String>) -> Option<Vec<u8>> {
        match (self.attachments)(name.get_ref()) {
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
