//! A run: the core works on its threads, the calling thread listens for Ctrl-C and passes steps on to Python.
//!
//! Signals reach the main thread alone, and the core works on others: so the calling thread waits, and looks up often.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::Duration;

use fret_core::history::{self, CycleRecord, KeptFields, StepRecord};
use fret_core::model::ContactState;
use fret_core::plan::{Advance, Plan};
use fret_core::run::{Checkpoint, Iteration, Observer, RunError, Simulation};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::{Py, PyAny, PyErr, PyResult, Python, pyfunction};
use rayon::ThreadPool;

use crate::case::Case;
use crate::error::{failed, refused};
use crate::history::{History, step_items};
use crate::threads::{self, Threads};

/// Python hears about signals at least so often.
const PATIENCE: Duration = Duration::from_millis(50);

/// Time between two looks for other work, while Python hears about a step.
const SHORT_WHILE: Duration = Duration::from_millis(1);

/// What the working thread tells the calling thread.
enum News {
    /// An increment, and the planned increments that are behind the run.
    Solved(Box<StepRecord>, usize),
    Ended(Box<(history::History, Result<(), RunError>)>),
}

/// The observer on the working thread: stops when asked to, and waits while Python hears about a step.
struct Reporter<'a> {
    stop: &'a AtomicBool,
    news: SyncSender<News>,
    heard: Receiver<()>,
    tells_steps: bool,
    advance: Advance,
}

impl Reporter<'_> {
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

    fn solved(&mut self, record: &StepRecord, _: &ContactState, _: Option<&KeptFields>) -> ControlFlow<()> {
        self.advance.solved(record);
        let passed = self.advance.passed();
        if self.tells_steps && self.news.send(News::Solved(Box::new(record.clone()), passed)).is_ok() {
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
/// Gives the history so far, and the exception that ended it early, or `None`.
#[pyfunction]
pub fn run(
    py: Python<'_>,
    case: &Case,
    threads: Threads,
    on_step: Option<Py<PyAny>>,
) -> PyResult<(History, Option<PyErr>)> {
    let pool = threads::pool(threads)?;
    let plan = py.detach(|| pool.install(|| case.planned())).map_err(|error| refused(&error))?;
    let (history, ended) = py.detach(|| listen(&pool, &plan, on_step.as_ref()))?;
    Ok((History(history), ended))
}

/// Runs the plan on the pool and listens to it; an error of Python's (Ctrl-C, or raised by `on_step`) stops the run.
fn listen(
    pool: &ThreadPool,
    plan: &Plan,
    on_step: Option<&Py<PyAny>>,
) -> PyResult<(history::History, Option<PyErr>)> {
    let stop = AtomicBool::new(false);
    let (news, inbox) = sync_channel(0);
    let (hear, heard) = sync_channel(1);
    let mut reporter = Reporter {
        stop: &stop,
        news,
        heard,
        tells_steps: on_step.is_some(),
        advance: Advance::new(&plan.case),
    };
    let mut interruption: Option<PyErr> = None;
    let mut interrupt = |reaction: PyResult<()>| {
        if let Err(error) = reaction {
            stop.store(true, Ordering::Relaxed);
            interruption.get_or_insert(error);
        }
    };
    let outcome = pool.in_place_scope(|scope| {
        scope.spawn(move |_| {
            let ended = Simulation::new(plan).follow(Checkpoint::start(plan), &mut reporter);
            let _ = reporter.news.send(News::Ended(Box::new(ended))); // the listener stays until this arrives
        });
        loop {
            match inbox.recv_timeout(PATIENCE) {
                Ok(News::Solved(record, passed)) => {
                    if !stop.load(Ordering::Relaxed) {
                        let counts = [plan.increments, passed];
                        interrupt(consult(on_step.map(|on_step| (on_step, &*record, counts))));
                    }
                    let _ = hear.send(()); // an error means that the working thread panicked: see below
                }
                Ok(News::Ended(result)) => return Some(*result),
                Err(RecvTimeoutError::Timeout) => interrupt(consult(None)),
                Err(RecvTimeoutError::Disconnected) => return None, // a panic: the scope carries it on
            }
        }
    });
    let (history, result) =
        outcome.ok_or_else(|| PyRuntimeError::new_err("the solver's thread ended without a result"))?;
    Ok((history, interruption.or_else(|| result.err().map(|error| failed(&error)))))
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
