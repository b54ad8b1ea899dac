//! What a program that carries the command calls besides it, as the Python package does: the same runs, results and studies, without a
//! terminal.

use std::path::Path;
use std::sync::Arc;

use fret_core::history::{History, Start};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::study::{StageQuantities, companion};
use serde_json::{Value, json};

pub use crate::arguments::StudyRequest;
use crate::defect;
pub use crate::failure::Failure;
pub use crate::identify::{IndentationAsked, Question as IdentifyQuestion, Request as IdentifyRequest};
use crate::manner::Manner;
pub use crate::run::Guest;
use crate::run::{self, Estimate, NoBars, Wanted};
use crate::study::question::Question;
use crate::study::studied::studied;
pub use crate::sweep::kinds::kind_of as kind_of_key;
use crate::terminal;
use crate::threads;
use fret_results::{
    CaseFile, ERROR_BARS, Ending, Origin, ResultFolder, RunRecord, Standing, Tally, Wish, resolved_path,
    write_whole,
};
pub use fret_results::{ReadInstrument, read_instruments_by};

fn origin_in_memory(start: Option<Arc<Start>>) -> Option<Origin> {
    start.map(|start| Origin { start, results: "a state in memory".to_owned(), increment: 0 })
}

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

/// A history in memory with what it was solved by.
#[derive(Debug, Clone, Copy)]
pub struct Solved<'a> {
    /// Its plan.
    pub plan: &'a Plan,
    /// The history.
    pub history: &'a History,
    /// Quantities of interest at the ends of its stages.
    pub quantities: &'a [StageQuantities],
    /// One word and the reason, where it ended early.
    pub early: Option<(&'a str, &'a str)>,
    /// Its error bars, where they were asked for.
    pub error_bars: Option<&'a str>,
}

/// Writes a history into a folder, as the run itself would have done.
///
/// # Errors
/// When the folder holds something else, or cannot be written.
pub fn save(solved: Solved<'_>, case_file: &CaseFile, folder: &Path, wish: Wish) -> Result<(), Failure> {
    let Solved { plan, history, quantities, early, error_bars } = solved;
    let folder = &resolved_path(folder);
    match ResultFolder::standing(folder, case_file, plan, wish)? {
        Standing::Free | Standing::SameCase | Standing::Forced => {}
        Standing::Unfinished | Standing::Solved(_) => {
            let what = format!("{}: holds results already", folder.display());
            return Err(Failure::call(what, "choose another folder with --out DIR"));
        }
    }
    let origin = origin_in_memory(plan.start.clone());
    let record =
        RunRecord::new(case_file, plan, threads::asked(None), origin.as_ref().map(Origin::told).as_ref());
    let mut results = ResultFolder::open(folder, case_file, plan, record)?;
    let mut tally = Tally::new(plan);
    for step in &history.steps {
        results.keep(step, history.fields_of(step.increment))?;
        tally.add(step);
        for cycle in history.cycles.iter().filter(|cycle| cycle.last_increment == step.increment) {
            results.keep_cycle(cycle)?;
            tally.add_cycle(cycle);
        }
    }
    tally.stage_quantities = quantities.to_vec();
    tally.worn_through.clone_from(&history.worn_through);
    tally.worn_by_layer.clone_from(&history.worn_by_layer);
    let wall_s = history.steps.iter().map(|step| step.wall_s).sum();
    let ending =
        early.map(|(status, message)| Ending { status: status.to_owned(), message: message.to_owned() });
    results.close((&tally, &history.warnings), wall_s, ending.as_ref())?;
    if let Some(text) = error_bars {
        write_whole(&folder.join(ERROR_BARS), text.as_bytes())?;
    }
    Ok(())
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
