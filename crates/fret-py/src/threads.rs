//! The worker threads: an own pool, remembered with the process it belongs to, since threads do not survive a fork.

use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::{PyErr, PyResult, Python};
use rayon::{ThreadPool, ThreadPoolBuilder};

struct Remembered {
    process: u32,
    threads: usize,
    pool: Arc<ThreadPool>,
}

static POOL: Mutex<Option<Remembered>> = Mutex::new(None);

/// A pool of so many threads; of all cores when `None`.
pub fn pool(threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    if threads == Some(0) {
        return Err(PyValueError::new_err("threads = 0: must be at least 1, or None for all cores"));
    }
    let threads = threads.unwrap_or(0); // rayon's word for all cores
    let process = process::id();
    let mut remembered = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = remembered.as_ref()
        && known.process == process
        && known.threads == threads
    {
        return Ok(Arc::clone(&known.pool));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|index| format!("fretting-{index}"))
        .build()
        .map_err(|error| PyRuntimeError::new_err(format!("no worker threads: {error}")))?;
    let pool = Arc::new(pool);
    let last = remembered.replace(Remembered { process, threads, pool: Arc::clone(&pool) });
    if let Some(last) = last
        && last.process != process
    {
        // Its threads stayed in the parent process: nobody is there to be told to end.
        std::mem::forget(last);
    }
    Ok(pool)
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
