//! Threads of a command: as many as asked for, or all that the machine has.

use std::sync::{Mutex, MutexGuard, PoisonError};

use clap::Args;
use fret_core::machine::threads::{self, ThreadsError};
use rayon::ThreadPool;

use crate::failure::Failure;

/// How many threads a call asks for.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct Threads {
    /// Number of threads [default: all cores]
    #[arg(long = "threads", value_name = "N", value_parser = number)]
    pub number: Option<u16>,
}

impl Threads {
    /// A pool of them.
    pub fn pool(self) -> Result<ThreadPool, Failure> {
        pool(asked(self.number))
    }
}

/// How many threads a command works with.
pub fn asked(number: Option<u16>) -> usize {
    number.map_or_else(threads::available_threads, usize::from)
}

/// A pool of so many threads.
pub fn pool(number: usize) -> Result<ThreadPool, Failure> {
    threads::pool(number).map_err(refused)
}

/// Refuses more threads, in pools yet to come, than can be started.
pub fn check(number: usize) -> Result<(), Failure> {
    threads::check(number).map_err(refused)
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn refused(error: ThreadsError) -> Failure {
    Failure::call(error.to_string(), "--threads with a smaller number")
}

/// What threads share, also where one of them has ended in a panic.
pub fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A number of threads on the command line.
pub fn number(word: &str) -> Result<u16, String> {
    let most = threads::MOST_THREADS;
    let number = word.parse().ok().filter(|threads: &u16| (1..=most).contains(&usize::from(*threads)));
    number.ok_or_else(|| format!("must be a whole number from 1 to {most}"))
}
