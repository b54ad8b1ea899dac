//! Ctrl-C and a scheduler's request to end: the first stops the run after the iteration at work, a second one at once. Where what is
//! at work takes longer (large fields on their way to the disk), that is said.

use std::ops::ControlFlow;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::failure::INTERRUPTED;
use crate::terminal;

/// A run that has not ended so long after it was asked to says that it is going to.
const PATIENCE: Duration = Duration::from_millis(700);

static ASKED: AtomicBool = AtomicBool::new(false);
static LISTENING: Once = Once::new();

/// Listens from now on, but to no signal that whoever started the program has it ignore: under `nohup` a run outlives its terminal. Where
/// listening is impossible, the system's own way of ending a program remains.
pub fn listen() {
    LISTENING.call_once(|| system::listen(asked));
}

/// A file that grows beyond the largest that is allowed (`ulimit -f`) is a failure to write, not the end of the process.
pub fn outlive_full_files() {
    system::outlive_full_files();
}

/// Somebody asks the program to end.
fn asked() {
    if ASKED.swap(true, Ordering::Relaxed) {
        std::process::exit(i32::from(INTERRUPTED));
    }
    let _ = std::thread::Builder::new().spawn(|| {
        std::thread::sleep(PATIENCE);
        terminal::say(
            "stopping: what is being computed or written is finished first; Ctrl-C again ends at once",
        );
    });
}

#[cfg(unix)]
mod system {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    pub fn listen(asked: fn()) {
        let heard: Vec<i32> =
            [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal)).collect();
        if let Ok(mut signals) = Signals::new(&heard) {
            let _ = std::thread::Builder::new().spawn(move || signals.forever().for_each(|_| asked()));
        }
    }

    /// Whether the process ignores a signal; not where the system does not tell without unsafe code (it does on Linux).
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
            .is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
    }

    pub fn outlive_full_files() {
        // What is written then fails with "file too large".
        let heard = std::sync::Arc::default();
        let _ = signal_hook::flag::register(rustix::process::Signal::XFSZ.as_raw(), heard);
    }
}

#[cfg(not(unix))]
mod system {
    pub fn listen(asked: fn()) {
        let _ = ctrlc::set_handler(asked);
    }

    pub fn outlive_full_files() {}
}

/// Whether somebody asked to stop.
pub fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Whether to go on.
pub fn go_on() -> ControlFlow<()> {
    if is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
