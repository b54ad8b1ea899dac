//! What a program that carries the command calls besides it, as the Python package does: the same runs, results and studies, without a
//! terminal.

use std::path::Path;
use std::sync::Arc;

use fret_core::history::Start;
use fret_core::plan::{LeaveOut, Plan};
use fret_core::study::{StageQuantities, companion};
use serde_json::{Value, json};

pub use crate::arguments::StudyRequest;
use crate::defect;
pub use crate::failure::Failure;
pub use crate::identify::{IndentationAsked, Question as IdentifyQuestion, Request as IdentifyRequest};
use crate::manner::Manner;
use crate::run::{self, Estimate, NoBars, Wanted, origin_in_memory};
pub use crate::run::{Guest, Solved, save};
use crate::study::question::Question;
use crate::study::studied::studied;
pub use crate::sweep::kinds::kind_of as kind_of_key;
use crate::terminal;
use fret_results::{CaseFile, Wish};
pub use fret_results::{ReadInstrument, read_instruments_by};

/// Solves a case into a folder, as `fret run --out` does; `guest` hears of every increment and may stop the run.
///
/// # Errors
/// What ended the run early; what was solved is in the folder.
pub fn run_into(
    case_file: CaseFile,
    start: Option<Arc<Start>>,
    folder: &Path,
    (wish, estimate_error, threads): (Wish, bool, Option<u16>),
    guest: &mut Guest<'_>,
) -> Result<(), Failure> {
    let wanted = Wanted {
        case_file,
        folder: folder.to_owned(),
        origin: origin_in_memory(start),
        wish,
        leave_out: LeaveOut::ALL,
        estimate_error,
        threads,
        manner: Manner::SILENT,
    };
    run::run_into(wanted, guest)
}

/// Error bars of a solved plan, as `error_bars.json` has them; `quantities` are those at the ends of its stages. The reason where
/// there are none.
///
/// # Errors
/// When `guest` stops the auxiliary coarse solution.
pub fn error_bars(
    plan: &Plan,
    quantities: &[StageQuantities],
    guest: &mut Guest<'_>,
) -> Result<Result<Value, String>, Failure> {
    let coarse = match companion(plan) {
        Ok(coarse) => coarse,
        Err(error) => return Ok(Err(error.to_string())),
    };
    match Estimate::new(plan, &coarse, quantities, guest) {
        Ok(estimate) => Ok(Ok(json!(estimate.record))),
        Err(NoBars::Because(why)) => Ok(Err(why)),
        Err(NoBars::Interrupted) => {
            Err(Failure::Interrupted("stopped while the error bars were computed".to_owned()))
        }
    }
}

/// Studies a case as `fret study` does; the answer is that of `study.json`. With `progress` every level is told on standard error.
///
/// # Errors
/// When a number of the request cannot be had, or the finest level cannot be solved.
pub fn study(
    plan: &Plan,
    request: &StudyRequest,
    progress: bool,
    guest: &mut Guest<'_>,
) -> Result<Value, Failure> {
    let question = Question::new(request, plan)?;
    let say = |text: &str| {
        if progress {
            terminal::say(text);
        }
    };
    Ok(json!(studied((&plan.case.title, plan), question, None, &say, guest)?.record))
}

/// Constants of a model from measured fretting loops, or numbers of a case from an indentation, as `identified.json` has them, and the page with its
/// pictures.
///
/// # Errors
/// When the log cannot be read as what is asked about, or the case cannot be solved.
pub fn identify(
    log: (&str, &[u8]),
    case_file: &CaseFile,
    question: &IdentifyQuestion,
) -> Result<(Value, String), Failure> {
    let answer = defect::caught(|| crate::identify::identify(log, case_file, question))?;
    Ok((answer.record, answer.page))
}
