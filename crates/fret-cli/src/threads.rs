//! Threads of a command.

use std::num::NonZero;

/// Threads of this machine.
pub fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}
