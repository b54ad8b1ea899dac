//! Worker threads: how many may be asked for, and a pool of them.

use std::num::NonZero;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::process::{ADDRESSES_OF_A_THREAD, addresses_left};

/// Threads that may be asked for, at the most: more than any machine has cores for one contact, and few enough to start.
pub const MOST_THREADS: usize = 1024;

/// Why there is no pool.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ThreadsError {
    /// A number that nobody can mean.
    #[error("threads = {0}: must be a whole number from 1 to {MOST_THREADS}")]
    OutOfRange(String),
    /// More than the limit on the address space lets start: so many were asked for, so many fit.
    #[error(
        "threads = {0}: the limit on the address space (ulimit -v) leaves room for {1}; fewer threads give the same numbers, \
         or ulimit -v unlimited"
    )]
    NoAddresses(usize, usize),
    /// The system does not start them.
    #[error(
        "threads = {0}: not started: {1}; a limit on the address space (ulimit -v) or on processes (ulimit -u) may be why; fewer \
         threads give the same numbers"
    )]
    NotStarted(usize, String),
}

/// Cores of this machine that the process may use; no more than threads for which its limit on the address space has room.
pub fn available_threads() -> usize {
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
    room_for().map_or(cores, |most| cores.min(most))
}

/// Threads for which the address space has room when half of it is left to their work; `None` without a limit.
fn room_for() -> Option<usize> {
    let most = addresses_left()? / (2 * ADDRESSES_OF_A_THREAD);
    Some(usize::try_from(most).unwrap_or(usize::MAX).max(1))
}

/// Whether so many threads can be started beside those that run. One always may try.
///
/// # Errors
/// When the limit on the address space has no room for them: a process that runs out of it while threads start is ended by the system.
pub fn check(threads: usize) -> Result<(), ThreadsError> {
    match room_for() {
        Some(most) if threads > most => Err(ThreadsError::NoAddresses(threads, most)),
        _ => Ok(()),
    }
}

/// A pool of so many threads.
///
/// # Errors
/// When the number is not from 1 to [`MOST_THREADS`], the address space has no room for them, or the system does not start them.
pub fn pool(threads: usize) -> Result<ThreadPool, ThreadsError> {
    if !(1..=MOST_THREADS).contains(&threads) {
        return Err(ThreadsError::OutOfRange(threads.to_string()));
    }
    check(threads)?;
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|index| format!("fretting-{index}"))
        .build()
        .map_err(|error| ThreadsError::NotStarted(threads, error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_threads_that_nobody_can_mean_are_refused_before_any_is_started() {
        for count in [0, MOST_THREADS + 1, usize::MAX] {
            let refused = pool(count).map(|_| ()).unwrap_err();
            assert_eq!(refused, ThreadsError::OutOfRange(count.to_string()));
        }
        assert_eq!(pool(2).unwrap().current_num_threads(), 2);
    }
}
