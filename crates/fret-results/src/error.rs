//! Why a folder of results, or a case, could not be had or written.

use std::io;
use std::path::{Path, PathBuf};

use fret_core::case::CaseError;
use fret_core::machine::memory::MemoryError;

/// Why a folder of results could not be read or written.
#[derive(Debug)]
pub enum ResultsError {
    /// The case is not one that can be computed.
    Case(CaseError),
    /// The folder is not one that can be taken: what is wrong, and what to do instead.
    Refused(String, String),
    /// There is not the memory for it.
    Memory(MemoryError),
    /// A file could not be written.
    Unwritten(Unwritten),
    /// A mistake in the program itself.
    Defect(String),
}

/// A file or stream that could not be written.
#[derive(Debug)]
pub struct Unwritten {
    /// Which one.
    pub path: PathBuf,
    /// Why not.
    pub cause: io::Error,
}

impl Unwritten {
    /// The writing of `path` failed by `cause`.
    pub fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        |cause| Self { path, cause }
    }
}

impl std::fmt::Display for Unwritten {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let cause = match self.cause.kind() {
            io::ErrorKind::PermissionDenied => "no permission".to_owned(),
            io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".to_owned(),
            io::ErrorKind::StorageFull => "the disk is full".to_owned(),
            io::ErrorKind::FileTooLarge => "longer than a file may be here (ulimit -f)".to_owned(),
            io::ErrorKind::QuotaExceeded => "the disk quota is used up".to_owned(),
            _ => self.cause.to_string(),
        };
        write!(formatter, "{}: cannot be written: {cause}", self.path.display())
    }
}

impl ResultsError {
    /// Results that are not what the run wrote.
    pub fn damaged(path: &Path, what: &str) -> Self {
        let help = "run the case again: nothing is read from a damaged folder";
        Self::Refused(format!("{}: {what}", path.display()), help.to_owned())
    }

    /// Something that is no result of a run.
    pub fn unusable(path: &Path, what: &str) -> Self {
        let help = "name the folder that `fret run CASE --out DIR` wrote";
        Self::Refused(format!("{}: {what}", path.display()), help.to_owned())
    }
}

impl From<CaseError> for ResultsError {
    fn from(error: CaseError) -> Self {
        Self::Case(error)
    }
}

impl From<MemoryError> for ResultsError {
    fn from(error: MemoryError) -> Self {
        Self::Memory(error)
    }
}

impl From<Unwritten> for ResultsError {
    fn from(unwritten: Unwritten) -> Self {
        Self::Unwritten(unwritten)
    }
}
