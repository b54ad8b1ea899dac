//! A run: the core works on its threads, the calling thread listens for Ctrl-C and passes steps on to Python.
//!
//! Signals reach the main thread alone, and the core works on others: so the calling thread waits, and looks up often.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use fret_cli::embedded;
use fret_core::history::{CycleRecord, KeptFields, StepRecord};
use fret_core::model::MirroredState;
use fret_core::plan::{Advance, Plan};
use fret_core::run::{Checkpoint, Iteration, Observer, Simulation};
use fret_core::study::{QuantityReader, StageQuantities};
use fret_results::Wish;
use pyo3::prelude::{Py, PyAny, PyErr, PyResult, Python, pyfunction};

use crate::case::Case;
use crate::error::{failed, refused, stopped};
use crate::history::{History, step_items};
use crate::in_common::InCommon;
use crate::threads::{self, Threads};

/// Python hears about signals at least so often.
const PATIENCE: Duration = Duration::from_millis(50);

/// Time between two looks for other work, while Python hears about a step.
const SHORT_WHILE: Duration = Duration::from_millis(1);

/// What the working thread tells the calling thread: an increment, and the planned increments that are behind the run.
struct Solved(Box<StepRecord>, usize);

/// The observer on the working thread: stops when asked to, and waits while Python hears about a step.
pub struct Reporter<'a> {
    stop: &'a AtomicBool,
    news: SyncSender<Solved>,
    heard: Receiver<()>,
    tells_steps: bool,
    advance: Advance,
    reader: QuantityReader,
    /// Quantities of interest at the ends of the stages so far.
    quantities: Vec<StageQuantities>,
}

/// Stops when asked to, and tells nothing.
pub struct Silently<'a>(&'a AtomicBool);

impl Observer for Silently<'_> {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl<'a> Reporter<'a> {
    /// For work beside the run, whose increments are nobody's news.
    pub fn silently(&self) -> Silently<'a> {
        Silently(self.stop)
    }

    fn verdict(&self) -> ControlFlow<()> {
        if self.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Waits until Python has heard about a step. What it does then may need this very thread (another run, a product), so
    /// the thread lends a hand meanwhile.
    fn wait_until_heard(&self) {
        while let Err(RecvTimeoutError::Timeout) = self.heard.recv_timeout(SHORT_WHILE) {
            rayon::yield_now();
        }
    }
}

impl Observer for Reporter<'_> {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        self.verdict()
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        state: MirroredState<'_>,
        _: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        self.advance.solved(record);
        if self.quantities.last().is_some_and(|end| end.stage == record.stage) {
            self.quantities.pop();
        }
        self.quantities.push(self.reader.read(record, state));
        let passed = self.advance.passed();
        if self.tells_steps && self.news.send(Solved(Box::new(record.clone()), passed)).is_ok() {
            self.wait_until_heard();
        }
        self.verdict()
    }

    fn cycled(&mut self, record: &CycleRecord) {
        self.advance.cycled(record);
    }
}

/// Runs a case on so many threads (all cores when `None`). `on_step(step, increments, passed)` is called after every
/// increment with its numbers, the count of all planned increments and of those that are behind the run; what it raises ends the run.
/// Gives the history so far, and the exception that ended it early, or `None`. `point`: what it has in common with other points of a sweep,
/// and its number; fields and quantities of a common beginning are missing then.
#[pyfunction]
#[pyo3(signature = (case, threads, on_step, estimate_error, point = None))]
pub fn run(
    py: Python<'_>,
    case: &Case,
    threads: Threads,
    on_step: Option<Py<PyAny>>,
    estimate_error: bool,
    point: Option<(Py<InCommon>, usize)>,
) -> PyResult<(History, Option<PyErr>)> {
    let pool = threads::pool(threads)?;
    let text = case.text()?;
    let plan = py.detach(|| pool.install(|| case.planned())).map_err(|error| refused(&error))?;
    let (answer, interruption) = py.detach(|| {
        listen(&plan, on_step.as_ref(), |reporter| {
            pool.install(|| {
                let simulation = Simulation::new(&plan);
                let (history, result) = match &point {
                    Some((in_common, number)) => in_common.get().solve(*number, simulation, reporter),
                    None => simulation.follow(Checkpoint::start(&plan), reporter),
                };
                let bars = (result.is_ok() && estimate_error).then(|| {
                    let quantities = std::mem::take(&mut reporter.quantities);
                    let bars = embedded::error_bars(&plan, &quantities, &mut reporter.silently());
                    reporter.quantities = quantities;
                    bars
                });
                (history, result, bars, std::mem::take(&mut reporter.quantities))
            })
        })
    });
    let (history, result, bars, quantities) = answer;
    let mut ended = interruption.or_else(|| result.err().map(|error| failed(&error)));
    let error_bars = match bars {
        Some(Ok(Ok(bars))) => Some(format!("{bars:#}\n")),
        Some(Ok(Err(why))) => Some(serde_json::json!({ "missing": why }).to_string()),
        Some(Err(error)) => {
            ended = ended.or_else(|| Some(stopped(error)));
            None
        }
        None => None,
    };
    Ok((History { solved: history, plan, case: text, quantities, error_bars }, ended))
}

/// As [`run`], into a folder, which then holds the history. `how`: resume, replace, estimate the error.
#[pyfunction]
pub fn run_into(
    py: Python<'_>,
    case: &Case,
    folder: PathBuf,
    how: (bool, bool, bool),
    threads: Threads,
    on_step: Option<Py<PyAny>>,
) -> PyResult<Option<PyErr>> {
    let (resume, replace, estimate_error) = how;
    let (text, start) = (case.text()?, case.start());
    let plan = py.detach(|| case.planned()).map_err(|error| refused(&error))?;
    let how = (Wish::of(resume, replace), estimate_error, threads.number());
    let (result, interruption) = py.detach(|| {
        listen(&plan, on_step.as_ref(), |reporter| embedded::run_into(text, start, &folder, how, reporter))
    });
    Ok(interruption.or_else(|| result.err().map(stopped)))
}

/// Does some work on another thread and listens to it; an error of Python's (Ctrl-C, or raised by `on_step`) stops the work and comes
/// back beside its answer.
pub fn listen<T: Send>(
    plan: &Plan,
    on_step: Option<&Py<PyAny>>,
    work: impl FnOnce(&mut Reporter<'_>) -> T + Send,
) -> (T, Option<PyErr>) {
    let stop = AtomicBool::new(false);
    let (news, inbox) = sync_channel(0);
    let (hear, heard) = sync_channel(1);
    let mut reporter = Reporter {
        stop: &stop,
        news,
        heard,
        tells_steps: on_step.is_some(),
        advance: Advance::new(&plan.case),
        reader: QuantityReader::of(plan),
        quantities: Vec::new(),
    };
    let mut interruption: Option<PyErr> = None;
    let mut interrupt = |reaction: PyResult<()>| {
        if let Err(error) = reaction {
            stop.store(true, Ordering::Relaxed);
            interruption.get_or_insert(error);
        }
    };
    let answer = thread::scope(|scope| {
        let worker = scope.spawn(move || work(&mut reporter));
        loop {
            match inbox.recv_timeout(PATIENCE) {
                Ok(Solved(record, passed)) => {
                    if !stop.load(Ordering::Relaxed) {
                        let counts = [plan.increments, passed];
                        interrupt(consult(on_step.map(|on_step| (on_step, &*record, counts))));
                    }
                    let _ = hear.send(()); // an error means that the working thread has ended: see below
                }
                Err(RecvTimeoutError::Timeout) => interrupt(consult(None)),
                Err(RecvTimeoutError::Disconnected) => return worker.join(), // the work is over
            }
        }
    });
    let answer = answer.unwrap_or_else(|panic| resume_unwind(panic));
    (answer, interruption)
}

/// Tells Python about a step, and asks it whether Ctrl-C was pressed.
fn consult(step: Option<(&Py<PyAny>, &StepRecord, [usize; 2])>) -> PyResult<()> {
    Python::attach(|py| {
        if let Some((on_step, record, [increments, passed])) = step {
            on_step.call1(py, (step_items(py, record)?, increments, passed))?;
        }
        py.check_signals()
    })
}
