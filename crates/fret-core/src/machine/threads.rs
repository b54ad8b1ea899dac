//! Worker threads: how many may be asked for, and a pool of them.

use std::num::NonZero;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Threads that may be asked for, at the most: more than any machine has cores for one contact, and few enough to start.
pub const MOST_THREADS: usize = 1024;

/// Why there is no pool.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ThreadsError {
    /// A number that nobody can mean.
    #[error("threads = {0}: must be a whole number from 1 to {MOST_THREADS}")]
    OutOfRange(String),
    /// The system does not start them.
    #[error("threads = {0}: not started: {1}")]
    NotStarted(usize, String),
}

/// Cores of this machine that the process may use.
pub fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// A pool of so many threads.
///
/// # Errors
/// When the number is not from 1 to [`MOST_THREADS`], or the system does not start them.
pub fn pool(threads: usize) -> Result<ThreadPool, ThreadsError> {
    if !(1..=MOST_THREADS).contains(&threads) {
        return Err(ThreadsError::OutOfRange(threads.to_string()));
    }
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
