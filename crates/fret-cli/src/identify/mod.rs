//! A measured log, identified by a case: what the core finds (`fret_core::identify`), as a record, a text, a table and a page; of fretting loops
//! (`loops`), and of an indentation.

mod constant;
mod identified;
mod indentation;
mod keys;
mod loops;
mod over_cycles;
mod page;
mod record;
mod repeated;
mod summary;
mod table;
#[cfg(test)]
mod tests;

use crate::failure::Failure;
use fret_results::CaseFile;
pub use identified::Identified;
pub use indentation::IndentationAsked;
pub use loops::Request;

/// What a log is asked.
#[derive(Debug, Clone)]
pub enum Question {
    /// About its fretting loops.
    Loops(Request),
    /// About load over depth.
    Indentation(IndentationAsked),
}

/// Identifies a log by a case.
///
/// # Errors
/// When the log cannot be read as what is asked about, or the case cannot be solved.
pub fn identify(
    log: (&str, &[u8]),
    case_file: &CaseFile,
    question: &Question,
) -> Result<Identified, Failure> {
    match question {
        Question::Loops(request) => loops::loops(log, case_file, request),
        Question::Indentation(asked) => indentation::indentation(log, case_file, asked),
    }
}
