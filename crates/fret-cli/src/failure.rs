//! Why a call ended without its answer, in words and as an exit code.

use fret_core::case::{CaseError, Mistake, printable};
use fret_core::machine::memory::MemoryError;
use fret_core::run::RunError;
use fret_drawing::EncodingError;
pub use fret_results::Unwritten;
use fret_results::{Ending, ResultsError};
use serde::{Deserialize, Serialize};

use crate::figures::shortened;

/// Exit code of a refused case or call, also where only the run finds out: a contact that grows to the edge of the grid.
pub const REFUSED: u8 = 1;
/// Exit code of a numerical failure, and of a file that could not be written.
pub const FAILED: u8 = 2;
/// Exit code of an interrupted run.
pub const INTERRUPTED: u8 = 130;

/// Letters of a message to a person, at the most.
const LONGEST_MESSAGE: usize = 4000;

/// Why a call ended without its answer.
#[derive(Debug)]
pub enum Failure {
    /// The case is not one that can be computed.
    Case(CaseError),
    /// The call is not one that can be followed: what, and what to do instead.
    Call(String, String),
    /// There is not the memory for it.
    Memory(MemoryError),
    /// The case could not be solved.
    Unsolved(RunError),
    /// Somebody stopped the run.
    Interrupted(String),
    /// A file could not be written.
    Unwritten(Unwritten),
    /// Points of a sweep that have no answer: how many were refused, and how many could not be solved.
    Points {
        /// Refused.
        refused: usize,
        /// Not solved.
        failed: usize,
    },
    /// A mistake in the program itself.
    Defect(String),
}

/// A failure, for programs.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FailureRecord {
    /// One word.
    pub status: String,
    /// Why.
    pub message: String,
    /// A way out, of a call that is refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
    /// The mistakes of a case, where it is one that is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mistakes: Option<Vec<MistakeRecord>>,
}

/// A mistake in a case, for programs.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct MistakeRecord {
    /// What was found, and what is allowed.
    pub message: String,
    /// A way out.
    pub help: Option<String>,
    /// Its line, from 1.
    pub line: Option<usize>,
    /// Its column, from 1.
    pub column: Option<usize>,
}

/// A failure on its way to the user.
#[derive(Debug)]
pub struct Told {
    /// What went wrong.
    pub failure: Failure,
    /// Whether an answer in JSON, with more than the failure, has told it already.
    pub in_json: bool,
}

impl<F: Into<Failure>> From<F> for Told {
    fn from(failure: F) -> Self {
        Self { failure: failure.into(), in_json: false }
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Interrupted { .. } => Self::Interrupted(String::new()),
            error => Self::Unsolved(error),
        }
    }
}

impl Failure {
    /// A call that cannot be followed: what, and what to do instead.
    pub fn call(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Call(what.into(), help.into())
    }

    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::Case(_)
            | Self::Call(..)
            | Self::Points { failed: 0, .. }
            | Self::Memory(MemoryError::TooLittle { .. }) => REFUSED,
            Self::Unsolved(error) if asks_for_another_case(error) => REFUSED,
            Self::Memory(_)
            | Self::Unsolved(_)
            | Self::Unwritten(_)
            | Self::Points { .. }
            | Self::Defect(_) => FAILED,
            Self::Interrupted(_) => INTERRUPTED,
        }
    }

    /// One word for records.
    pub fn status(&self) -> &'static str {
        match self.code() {
            REFUSED => "refused",
            FAILED => "failed",
            _ => "interrupted",
        }
    }

    /// The end of a run by it.
    pub fn ending(&self) -> Ending {
        Ending { status: self.status().to_owned(), message: self.message() }
    }

    /// What went wrong, without colour, for records.
    pub fn message(&self) -> String {
        match self {
            Self::Case(error) => error.render(false),
            Self::Call(what, _) | Self::Interrupted(what) => what.clone(),
            Self::Memory(error) => format!("this {error}"),
            Self::Unsolved(error) => error.to_string(),
            Self::Unwritten(unwritten) => unwritten.to_string(),
            Self::Points { refused, failed } => {
                format!(
                    "points without a result: {refused} refused, {failed} failed; the others are solved and kept"
                )
            }
            Self::Defect(what) => format!("a defect in fret itself, please report it: {what}"),
        }
    }

    /// What went wrong, as a person reads it.
    pub fn render(&self, colour: bool) -> String {
        let head = |word: &str, code: &str| {
            if colour { format!("\x1b[1m\x1b[{code}m{word}\x1b[0m") } else { word.to_owned() }
        };
        match self {
            Self::Case(error) => error.render(colour),
            Self::Call(what, help) => {
                format!("{}: {}\n  = help: {}", head("error", "31"), told(what), told(help))
            }
            Self::Interrupted(what) => format!("{}: {}", head("interrupted", "33"), told(what)),
            _ => format!("{}: {}", head("error", "31"), told(&self.message())),
        }
    }

    /// What went wrong, for programs.
    pub fn record(&self) -> FailureRecord {
        let (message, mistakes) = match self {
            Self::Case(error) => {
                let of = |mistake: &Mistake| {
                    let (line, column) = error.place(mistake).unzip();
                    let Mistake { message, help, .. } = mistake.clone();
                    MistakeRecord { message, help, line, column }
                };
                (format!("{}: refused", error.name()), Some(error.mistakes().iter().map(of).collect()))
            }
            _ => (self.message(), None),
        };
        let help = if let Self::Call(_, help) = self { Some(help.clone()) } else { None };
        FailureRecord { status: self.status().to_owned(), message, help, mistakes }
    }
}

/// Words with names from files in them, as a terminal may have them.
fn told(words: &str) -> String {
    shortened(&printable(words), LONGEST_MESSAGE)
}

/// Whether the equations went well but the case leaves what can be computed: a plan that had known would have refused it.
fn asks_for_another_case(error: &RunError) -> bool {
    matches!(
        error,
        RunError::ContactAtEdge { .. }
            | RunError::AboveSliding { .. }
            | RunError::AboveFullSlip { .. }
            | RunError::AboveHardness { .. }
            | RunError::GapClosed { .. }
            | RunError::OutOfMemory { error: MemoryError::TooLittle { .. }, .. }
    )
}

impl From<CaseError> for Failure {
    fn from(error: CaseError) -> Self {
        Self::Case(error)
    }
}

impl From<MemoryError> for Failure {
    fn from(error: MemoryError) -> Self {
        Self::Memory(error)
    }
}

impl From<ResultsError> for Failure {
    fn from(error: ResultsError) -> Self {
        match error {
            ResultsError::Case(error) => Self::Case(error),
            ResultsError::Refused(what, help) => Self::call(what, help),
            ResultsError::Memory(error) => Self::Memory(error),
            ResultsError::Unwritten(unwritten) => Self::Unwritten(unwritten),
            ResultsError::Defect(what) => Self::Defect(what),
        }
    }
}

impl From<EncodingError> for Failure {
    fn from(error: EncodingError) -> Self {
        Self::Defect(format!("an image of the page: {error}"))
    }
}

impl From<Unwritten> for Failure {
    fn from(unwritten: Unwritten) -> Self {
        Self::Unwritten(unwritten)
    }
}
