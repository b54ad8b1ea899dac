//! What a program that carries the command calls besides it, as the Python package does: the same runs, results and studies, without a
//! terminal.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fret_core::history::History;
use fret_core::history::Start;
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::RunError;
use fret_core::study::{StageQuantities, companion};
use ndarray::Array2;
use serde_json::Value;

use crate::arguments::StudyArguments;
use crate::case_file::{Beside, CaseFile};
use crate::commands::preparation::Wanted;
use crate::commands::run;
use crate::commands::study::{Question, studied};
use crate::defect;
use crate::estimate::{Estimate, NoBars};
use crate::failure::{Failure, Unwritten};
pub use crate::identify::Request as IdentifyRequest;
pub use crate::instruments::{ReadInstrument, read_instruments_by};
use crate::origin::Origin;
use crate::output::{
    ERROR_BARS, Ending, ResultFolder, RunRecord, Standing, Wish, resolved_path, write_whole,
};
use crate::results::{Field, Results};
use crate::tally::Tally;
use crate::terminal;
use crate::threads;

pub use crate::commands::run_observer::Guest;

/// Why a call ended without its answer.
#[derive(Debug)]
pub enum Stopped {
    /// The case is refused.
    Case(fret_core::case::CaseError),
    /// The call cannot be followed: what, and what to do instead.
    Call(String, String),
    /// There is not the memory for it.
    Memory(String),
    /// An increment was not solved.
    Unsolved(RunError),
    /// The guest stopped it.
    Interrupted(String),
    /// A file could not be written.
    Unwritten(PathBuf, String),
    /// A mistake in the program itself.
    Defect(String),
}

impl From<Failure> for Stopped {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Case(error) => Self::Case(error),
            Failure::Call(what, help) => Self::Call(what, help),
            Failure::Unsolved(error) => Self::Unsolved(error),
            Failure::Interrupted(what) => Self::Interrupted(what),
            Failure::Unwritten(Unwritten { ref path, .. }) => {
                Self::Unwritten(path.clone(), failure.message())
            }
            Failure::Memory(_) => Self::Memory(failure.message()),
            Failure::Points { .. } | Failure::Defect(_) => Self::Defect(failure.message()),
        }
    }
}

/// A case as text.
#[derive(Debug, Clone)]
pub struct CaseText {
    /// TOML.
    pub text: String,
    /// What stands for it in messages: the path of its file, where it has one.
    pub name: String,
    /// Whether it was read from the file of that name.
    pub is_file: bool,
    /// Folder where relative names in it start.
    pub folder: PathBuf,
    /// Contents of files that are in memory alone, by name.
    pub contents: Vec<(String, Vec<u8>)>,
}

impl From<CaseText> for CaseFile {
    fn from(case: CaseText) -> Self {
        let CaseText { text, name, is_file, folder, contents } = case;
        if is_file {
            return Self { path: PathBuf::from(name), text, beside: None };
        }
        Self::of_text(&name, text, Beside { folder, contents })
    }
}

/// What to do with results that are in a folder already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Earlier {
    /// Keep those of another case; replace those of this one.
    Keep,
    /// Replace them.
    Replace,
    /// Continue an interrupted run; start where there is none.
    Resume,
}

impl Earlier {
    /// What to do, by two answers: whether to go on with what is there, and whether to replace it.
    pub fn of(resume: bool, replace: bool) -> Self {
        match (resume, replace) {
            (true, _) => Self::Resume,
            (false, true) => Self::Replace,
            (false, false) => Self::Keep,
        }
    }
}

impl From<Earlier> for Wish {
    fn from(earlier: Earlier) -> Self {
        match earlier {
            Earlier::Keep => Self::Start,
            Earlier::Replace => Self::Force,
            Earlier::Resume => Self::Resume,
        }
    }
}

/// The state at the end of an increment (of the last one when none is given) of the results that `fret run` wrote into a folder,
/// for another history to start from.
///
/// # Errors
/// With the words of a refusal, where there is no such state.
pub fn start_from(results: &Path, increment: Option<usize>) -> Result<Arc<Start>, String> {
    Origin::of(results, increment).map(|origin| origin.start).map_err(|failure| failure.render(false))
}

/// A folder of results that was found whole.
#[derive(Debug)]
pub struct StoredRun(Results);

/// The run in a folder of results, finished or not, judged as the command judges it.
///
/// # Errors
/// With the words of a refusal, where it holds no results, or not those that were written.
pub fn stored_run(folder: &Path) -> Result<StoredRun, String> {
    Results::read(folder).map(StoredRun).map_err(|failure| failure.render(false))
}

impl StoredRun {
    /// Cell centres along x (0) or y (1) [length].
    pub fn centres(&self, axis: usize) -> &[f64] {
        if axis == 0 { &self.0.fields.x } else { &self.0.fields.y }
    }

    /// Numbers of the increments whose fields are kept.
    pub fn kept_increments(&self) -> &[usize] {
        &self.0.fields.steps
    }

    /// Names of the kept fields.
    pub fn names(&self) -> &[&'static str] {
        &self.0.fields.names
    }

    /// A field of the increment at a place among the kept ones, shape `(nx, ny)`; a zone is 0 open, 1 stick, 2 slip.
    ///
    /// # Errors
    /// With the words of a refusal, where its file is missing, or not as it was written.
    pub fn field(&self, name: &str, place: usize) -> Result<Array2<f64>, String> {
        let Field { cells: [nx, ny], values } =
            self.0.fields.field(name, place).map_err(|failure| failure.render(false))?;
        Array2::from_shape_vec((nx, ny), values).map_err(|error| error.to_string())
    }
}

fn origin_in_memory(start: Option<Arc<Start>>) -> Option<Origin> {
    start.map(|start| Origin { start, results: "a state in memory".to_owned(), increment: 0 })
}

/// Solves a case into a folder, as `fret run --out` does; `guest` hears of every increment and may stop the run.
///
/// # Errors
/// What ended the run early; what was solved is in the folder.
pub fn run_into(
    case: CaseText,
    start: Option<Arc<Start>>,
    folder: &Path,
    (earlier, estimate_error, threads): (Earlier, bool, Option<u16>),
    guest: &mut Guest<'_>,
) -> Result<(), Stopped> {
    let wanted = Wanted {
        case_file: case.into(),
        folder: folder.to_owned(),
        origin: origin_in_memory(start),
        wish: earlier.into(),
        leave_out: LeaveOut::ALL,
        estimate_error,
        threads,
        quiet: true,
        verbose: false,
    };
    Ok(run::run_into(wanted, guest)?)
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
) -> Result<Result<Value, String>, Stopped> {
    let coarse = match companion(plan) {
        Ok(coarse) => coarse,
        Err(error) => return Ok(Err(error.to_string())),
    };
    match Estimate::new(plan, &coarse, quantities, guest) {
        Ok(estimate) => Ok(Ok(estimate.to_json(|stage| plan.case.stages[stage].name.clone()))),
        Err(NoBars::Because(why)) => Ok(Err(why)),
        Err(NoBars::Interrupted) => {
            Err(Stopped::Interrupted("stopped while the error bars were computed".to_owned()))
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
pub fn save(solved: Solved<'_>, case: CaseText, folder: &Path, earlier: Earlier) -> Result<(), Stopped> {
    let Solved { plan, history, quantities, early, error_bars } = solved;
    let case_file = CaseFile::from(case);
    let folder = &resolved_path(folder);
    match ResultFolder::standing(folder, &case_file, plan, earlier.into())? {
        Standing::Free | Standing::SameCase | Standing::Forced => {}
        Standing::Unfinished | Standing::Solved(_) => {
            let what = format!("{}: holds results already", folder.display());
            return Err(Stopped::Call(what, "choose another folder with --out DIR".to_owned()));
        }
    }
    let origin = origin_in_memory(plan.start.clone());
    let record = RunRecord::new(&case_file, plan, threads::asked(None), origin.as_ref());
    let mut results = ResultFolder::open(folder, &case_file, plan, record)?;
    let mut tally = Tally::new(plan);
    for step in &history.steps {
        results.keep(step, history.fields_of(step.increment))?;
        tally.add(step);
        for cycle in history.cycles.iter().filter(|cycle| cycle.last_increment == step.increment) {
            results.keep_cycle(cycle).map_err(Failure::from)?;
            tally.add_cycle(cycle);
        }
    }
    tally.stage_quantities = quantities.to_vec();
    tally.worn_through.clone_from(&history.worn_through);
    tally.worn_by_layer.clone_from(&history.worn_by_layer);
    let wall_s = history.steps.iter().map(|step| step.wall_s).sum();
    let ending =
        early.map(|(status, message)| Ending { status: status.to_owned(), message: message.to_owned() });
    results.close((&tally, &history.warnings), wall_s, ending.as_ref()).map_err(Failure::from)?;
    if let Some(text) = error_bars {
        write_whole(&folder.join(ERROR_BARS), text.as_bytes()).map_err(Failure::from)?;
    }
    Ok(())
}

/// Resolutions of a refinement study; empty lists as in `fret study`.
#[derive(Debug, Clone, Default)]
pub struct StudyRequest {
    /// Numbers of cells along x.
    pub cells: Vec<usize>,
    /// Numbers of increments per stage or cycle.
    pub increments: Vec<usize>,
    /// Tolerances of the solver.
    pub tolerances: Vec<f64>,
    /// `analytic`, `finest` or a file of numbers.
    pub against: Option<String>,
}

/// Studies a case as `fret study` does; the answer is that of `study.json`. With `progress` every level is told on standard error.
///
/// # Errors
/// When a number of the request cannot be had, or the finest level cannot be solved.
pub fn study(
    plan: &Plan,
    request: StudyRequest,
    progress: bool,
    guest: &mut Guest<'_>,
) -> Result<Value, Stopped> {
    let StudyRequest { cells, increments, tolerances, against } = request;
    let arguments = StudyArguments {
        case: PathBuf::new(),
        cells,
        increments,
        tolerances,
        against,
        out: None,
        threads: None,
        quiet: true,
    };
    let question = Question::new(&arguments, plan)?;
    let say = |text: &str| {
        if progress {
            terminal::say(text);
        }
    };
    Ok(studied((&plan.case.title, plan), question, None, &say, guest)?.record)
}

/// Constants of a model from a measured log, as `identified.json` has them, and the page with its pictures.
///
/// # Errors
/// When the log cannot be read as fretting loops of such a case, or the case cannot be solved.
pub fn identify(
    log: (&str, &[u8]),
    case: CaseText,
    request: &IdentifyRequest,
) -> Result<(Value, String), Stopped> {
    let asked = || crate::identify::identify(log, &case.into(), request);
    // A mistake in the program is an error of the call, not the end of the caller.
    let answer = catch_unwind(AssertUnwindSafe(asked))
        .unwrap_or_else(|panic| Err(Failure::Defect(defect::words_of(panic.as_ref()))))?;
    Ok((answer.json(), answer.page()))
}
