//! A case file on disk: read whole, with one clear refusal when that is impossible. What the text means is the core's to say.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use fret_core::case::{Attachments, Case, CaseError};
use fret_core::plan::{LeaveOut, Plan};

use crate::failure::Failure;
use crate::origin::Origin;

/// Bytes read at the most: one more than the core takes, so that an endless stream is refused and not read.
const MOST_BYTES: u64 = (4 << 20) + 1;

/// Bytes of a file that a case names, at the most.
const MOST_ATTACHED: u64 = 2 << 30;

/// A case file that could be read.
#[derive(Debug)]
pub struct CaseFile {
    /// Where it lies, as given.
    pub path: PathBuf,
    /// Its text, verbatim.
    pub text: String,
}

impl CaseFile {
    /// Reads a case file.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let refuse = |message: String| CaseError::plain(&path.display().to_string(), message);
        let mut bytes = Vec::new();
        File::open(path)
            .and_then(|file| file.take(MOST_BYTES).read_to_end(&mut bytes))
            .map_err(|error| refuse(unreadable(path, &error)))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let place = error.utf8_error().valid_up_to();
            refuse(format!("not a text in UTF-8 (byte {place} is not part of a letter)"))
        })?;
        Ok(Self { path: path.to_owned(), text })
    }

    /// A file the case names, looked for beside the case file.
    fn attachment(&self, name: &str) -> Result<Vec<u8>, String> {
        let folder = self.path.parent().unwrap_or_else(|| Path::new(""));
        let path = folder.join(name);
        // Only ordinary files are read, so that nothing waits on a pipe.
        if std::fs::metadata(&path).is_ok_and(|facts| !facts.is_file()) {
            return Err("no ordinary file".to_owned());
        }
        let mut content = Vec::new();
        File::open(&path)
            .and_then(|file| file.take(MOST_ATTACHED + 1).read_to_end(&mut content))
            .map_err(|error| unreadable(&path, &error))?;
        if content.len() as u64 > MOST_ATTACHED {
            return Err(format!("longer than {} MB", MOST_ATTACHED >> 20));
        }
        Ok(content)
    }

    /// Its name as it stands in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// Its file name without the extension; names the results.
    pub fn stem(&self) -> PathBuf {
        self.path.file_stem().map_or_else(|| PathBuf::from("case"), PathBuf::from)
    }

    /// The case, read and planned.
    pub fn planned(&self) -> Result<Plan, CaseError> {
        self.planned_leaving_out(LeaveOut::ALL, None)
    }

    /// The case, read and planned to start from the state that is named `from`, if one is.
    pub fn planned_from(&self, from: Option<&str>) -> Result<Plan, Failure> {
        let origin = from.map(Origin::read).transpose()?;
        Ok(self.planned_leaving_out(LeaveOut::ALL, origin.as_ref())?)
    }

    /// The case, read and planned with some shortcuts alone, to start from `origin`, or from bodies apart.
    pub fn planned_leaving_out(
        &self,
        leave_out: LeaveOut,
        origin: Option<&Origin>,
    ) -> Result<Plan, CaseError> {
        let beside = |name: &str| self.attachment(name);
        let attachments = Attachments::files(&beside).starting_from(origin.map(Origin::loads));
        let case = Case::from_toml_with(&self.text, &self.name(), attachments)?;
        Plan::starting_from(origin.map(|origin| origin.start.clone()), case, leave_out)
    }
}

fn unreadable(path: &Path, error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        _ if path.is_dir() => "a folder, not a file".to_owned(),
        io::ErrorKind::PermissionDenied => "no permission to read it".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}
