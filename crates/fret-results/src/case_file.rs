//! A case file on disk: read whole, with one clear refusal when that is impossible. What the text means is the core's to say.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fret_core::case::{Attachments, Case, CaseError, content, unreadable};
use fret_core::history::Start;
use fret_core::plan::{LeaveOut, Plan};

use crate::instruments;
use crate::place::stem;

/// Bytes read at the most: one more than the core takes, so that an endless stream is refused and not read.
const MOST_BYTES: u64 = (4 << 20) + 1;

/// A case file that could be read.
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// Where it lies, as given.
    pub path: PathBuf,
    /// Its text, verbatim.
    pub text: String,
    /// Of a text that came from no file: where what it names is found.
    pub beside: Option<Beside>,
}

/// What a text names that came from no file.
#[derive(Debug, Clone)]
pub struct Beside {
    /// Folder where relative names start.
    pub folder: PathBuf,
    /// Contents of files that are in memory alone, by name; the folder of results gets them.
    pub contents: Vec<(String, Vec<u8>)>,
}

impl CaseFile {
    /// Reads the case that a command is asked about; `-` is standard input, where relative names start at the current folder.
    ///
    /// # Errors
    /// When it cannot be read, or is no text; when nothing comes from standard input.
    pub fn asked(path: &Path) -> Result<Self, CaseError> {
        if path != Path::new("-") {
            return Self::read(path);
        }
        let text = text(Path::new("stdin"), io::stdin().lock())?;
        if text.trim().is_empty() {
            return Err(CaseError::plain("stdin", "nothing came from standard input"));
        }
        Ok(Self::of_text("stdin", text, Beside { folder: PathBuf::new(), contents: Vec::new() }))
    }

    /// Reads a case file.
    ///
    /// # Errors
    /// When the file cannot be read, or is no text.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let file = File::open(path)
            .map_err(|error| CaseError::plain(&path.display().to_string(), why(path, &error)))?;
        Ok(Self { path: path.to_owned(), text: text(path, file)?, beside: None })
    }

    /// Reads a case file that another file names: an ordinary one, so that nothing waits on a pipe.
    ///
    /// # Errors
    /// As [`CaseFile::read`]; when it is no ordinary file.
    pub fn read_ordinary(path: &Path) -> Result<Self, CaseError> {
        match path.metadata() {
            Ok(facts) if !facts.is_file() && !facts.is_dir() => {
                Err(CaseError::plain(&path.display().to_string(), "no ordinary file"))
            }
            _ => Self::read(path),
        }
    }

    /// A file the case names, looked for beside the case file.
    fn attachment(&self, name: &str) -> Result<Vec<u8>, String> {
        let contents = self.beside.iter().flat_map(|beside| &beside.contents);
        let in_memory = contents.into_iter().find(|(known, _)| known == name);
        in_memory.map_or_else(|| content(&self.place(name)), |(_, content)| Ok(content.clone()))
    }

    /// Where a file lies that the case names.
    fn place(&self, name: &str) -> PathBuf {
        let folder = match &self.beside {
            Some(beside) => beside.folder.as_path(),
            None => self.path.parent().unwrap_or_else(|| Path::new("")),
        };
        folder.join(name)
    }

    /// A text that came from no file; `name` stands for it in messages.
    pub fn of_text(name: &str, text: String, beside: Beside) -> Self {
        Self { path: PathBuf::from(name), text, beside: Some(beside) }
    }

    /// Its name as it stands in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// Its file name without the extension; names the results.
    pub fn stem(&self) -> PathBuf {
        stem(&self.path, "case")
    }

    /// What a case that it holds is called: its title, or the name of the file.
    pub fn title(&self, case: &Case) -> String {
        if case.title.is_empty() { self.stem().display().to_string() } else { case.title.clone() }
    }

    /// The case, read; its history starts from `start`, or from bodies apart.
    ///
    /// # Errors
    /// When the case is refused.
    pub fn case(&self, start: Option<&Arc<Start>>) -> Result<Case, CaseError> {
        let beside = |name: &str| self.attachment(name);
        let reader = instruments::reader();
        let scan = |name: &str, channel: Option<&str>| match reader {
            Some(reader) => reader(&self.place(name), channel),
            None => Err(String::new()), // never asked
        };
        let attachments = Attachments::files(&beside)
            .reading_scans(reader.is_some().then_some(&scan))
            .starting_from(start.map(|start| start.solved.loads));
        Case::from_toml_with(&self.text, &self.name(), attachments)
    }

    /// The case, read and planned.
    ///
    /// # Errors
    /// When the case is refused.
    pub fn planned(&self) -> Result<Plan, CaseError> {
        self.planned_leaving_out(LeaveOut::ALL, None)
    }

    /// The case, read and planned with some shortcuts alone, to start from `start`, or from bodies apart.
    ///
    /// # Errors
    /// When the case is refused.
    pub fn planned_leaving_out(
        &self,
        leave_out: LeaveOut,
        start: Option<&Arc<Start>>,
    ) -> Result<Plan, CaseError> {
        let case = self.case(start)?;
        Plan::starting_from(start.cloned(), case, leave_out)
    }
}

/// The text of a file that is open.
fn text(path: &Path, file: impl Read) -> Result<String, CaseError> {
    let refuse = |message: String| CaseError::plain(&path.display().to_string(), message);
    let mut bytes = Vec::new();
    file.take(MOST_BYTES).read_to_end(&mut bytes).map_err(|error| refuse(why(path, &error)))?;
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        refuse(format!("not a text in UTF-8 (byte {place} is not part of a letter)"))
    })
}

fn why(path: &Path, error: &io::Error) -> String {
    if path.is_dir() { "a folder, not a file".to_owned() } else { unreadable(error) }
}
