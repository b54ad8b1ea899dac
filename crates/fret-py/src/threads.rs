//! The worker threads: an own pool, remembered with the process it belongs to, since threads do not survive a fork; and memory, which
//! they work in.

use std::process;
use std::sync::{Arc, Mutex, TryLockError};

use fret_core::machine::threads::ThreadsError;
use fret_core::machine::{memory, threads};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyAnyMethods, PyErr, PyResult, Python, pyfunction};
use pyo3::types::PyBool;
use rayon::ThreadPool;

use crate::error::OutOfMemoryError;

struct Remembered {
    process: u32,
    pool: Arc<ThreadPool>,
}

static ALL_CORES: Mutex<Option<Remembered>> = Mutex::new(None);

/// A number of threads as Python gives it; all cores when `None`.
#[derive(Clone, Copy)]
pub struct Threads(Option<usize>);

impl Threads {
    /// The number, where one was given.
    pub fn number(self) -> Option<u16> {
        self.0.and_then(|number| u16::try_from(number).ok())
    }
}

/// All cores of the machine.
pub const ALL: Threads = Threads(None);

impl FromPyObject<'_, '_> for Threads {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        if given.is_none() {
            return Ok(Self(None));
        }
        let words = given.repr()?.to_string();
        let refused = ThreadsError::OutOfRange(words).to_string() + ", or None for all cores";
        // A truth value is a number to Python, and no number of threads to anybody.
        let is_whole = given.hasattr("__index__")? && !given.is_instance_of::<PyBool>();
        if !is_whole {
            return Err(PyTypeError::new_err(refused));
        }
        let number = given.extract().ok().filter(|threads| (1..=threads::MOST_THREADS).contains(threads));
        number.map(|threads| Self(Some(threads))).ok_or_else(|| PyValueError::new_err(refused))
    }
}

/// Refuses a number of threads that nobody can mean.
#[pyfunction]
pub fn check_threads(threads: Threads) {
    let _ = threads;
}

/// Refuses work that needs more memory than can be had [bytes]; `what` it is begins the message.
#[pyfunction]
pub fn check_memory(what: &str, bytes: usize) -> PyResult<()> {
    memory::check(bytes).map_err(|error| OutOfMemoryError::new_err((format!("{what}: {error}"), 0)))
}

/// A pool of so many threads, the caller's own, so that runs beside each other have theirs each; one of all cores, which
/// all callers share, when `None`.
pub fn pool(threads: Threads) -> PyResult<Arc<ThreadPool>> {
    threads.0.map_or_else(all_cores, built)
}

fn all_cores() -> PyResult<Arc<ThreadPool>> {
    let process = process::id();
    let mut remembered = match ALL_CORES.try_lock() {
        Ok(remembered) => remembered,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        // Another thread is at it now, or was when this process was forked, and then for ever: never wait here.
        Err(TryLockError::WouldBlock) => return built(threads::available_threads()),
    };
    if let Some(known) = remembered.as_ref()
        && known.process == process
    {
        return Ok(Arc::clone(&known.pool));
    }
    let pool = built(threads::available_threads())?;
    if let Some(last) = remembered.replace(Remembered { process, pool: Arc::clone(&pool) }) {
        // Its threads stayed in the parent process: nobody is there to be told to end.
        std::mem::forget(last);
    }
    Ok(pool)
}

fn built(number: usize) -> PyResult<Arc<ThreadPool>> {
    threads::pool(number).map(Arc::new).map_err(|error| match &error {
        ThreadsError::NoAddresses(..) => OutOfMemoryError::new_err((error.to_string(), 0)),
        ThreadsError::OutOfRange(_) | ThreadsError::NotStarted(..) => {
            PyRuntimeError::new_err(error.to_string())
        }
    })
}

/// Does `work` on the pool, without the interpreter.
pub fn on_pool<T: Send>(
    py: Python<'_>,
    threads: Threads,
    work: impl FnOnce() -> T + Send,
) -> Result<T, PyErr> {
    let pool = pool(threads)?;
    Ok(py.detach(|| pool.install(work)))
}
