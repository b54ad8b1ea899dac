//! Ctrl-C and a scheduler's request to end: the first stops the run after the iteration at work, a second one at once. Where what is
//! at work takes longer (large fields on their way to the disk), that is said.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::MirroredState;
use fret_core::run::{Iteration, Observer};

use crate::failure::INTERRUPTED;
use crate::terminal;

/// A run that has not ended so long after it was asked to says that it is going to.
const PATIENCE: Duration = Duration::from_millis(700);

static ASKED: AtomicBool = AtomicBool::new(false);

/// Listens from now on. Where listening is impossible, the system's own way of ending a program remains.
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(INTERRUPTED));
        }
        let _ = std::thread::Builder::new().spawn(|| {
            std::thread::sleep(PATIENCE);
            terminal::say(
                "stopping: what is being computed or written is finished first; Ctrl-C again ends at once",
            );
        });
    });
}

/// Whether somebody asked to stop.
pub fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Stops a run when somebody asks to, and hears nothing else.
pub struct Listener;

impl Observer for Listener {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        go_on()
    }

    fn solved(&mut self, _: &StepRecord, _: MirroredState<'_>, _: Option<&KeptFields>) -> ControlFlow<()> {
        go_on()
    }

    fn leaves_fields(&self) -> bool {
        false
    }
}

/// Whether to go on.
pub fn go_on() -> ControlFlow<()> {
    if is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}
