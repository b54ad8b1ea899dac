//! The worker threads: an own pool, remembered with the process it belongs to, since threads do not survive a fork.

use std::process;
use std::sync::{Arc, Mutex, TryLockError};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::{PyErr, PyResult, Python};
use rayon::{ThreadPool, ThreadPoolBuilder};

struct Remembered {
    process: u32,
    pool: Arc<ThreadPool>,
}

static ALL_CORES: Mutex<Option<Remembered>> = Mutex::new(None);

/// A pool of so many threads, the caller's own, so that runs beside each other have theirs each; one of all cores, which
/// all callers share, when `None`.
pub fn pool(threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    match threads {
        Some(0) => Err(PyValueError::new_err("threads = 0: must be at least 1, or None for all cores")),
        Some(threads) => built(threads),
        None => all_cores(),
    }
}

fn all_cores() -> PyResult<Arc<ThreadPool>> {
    let process = process::id();
    let mut remembered = match ALL_CORES.try_lock() {
        Ok(remembered) => remembered,
        Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        // Another thread is at it now, or was when this process was forked, and then for ever: never wait here.
        Err(TryLockError::WouldBlock) => return built(0),
    };
    if let Some(known) = remembered.as_ref()
        && known.process == process
    {
        return Ok(Arc::clone(&known.pool));
    }
    let pool = built(0)?; // rayon's word for all cores
    if let Some(last) = remembered.replace(Remembered { process, pool: Arc::clone(&pool) }) {
        // Its threads stayed in the parent process: nobody is there to be told to end.
        std::mem::forget(last);
    }
    Ok(pool)
}

fn built(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|index| format!("fretting-{index}"))
        .build()
        .map_err(|error| PyRuntimeError::new_err(format!("no worker threads: {error}")))?;
    Ok(Arc::new(pool))
}

/// Does `work` on the pool, without the interpreter.
pub fn on_pool<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, PyErr> {
    let pool = pool(threads)?;
    Ok(py.detach(|| pool.install(work)))
}
