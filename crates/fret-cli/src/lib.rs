//! The command `fret`: parse, dispatch, exit code. The verbs live in `commands`, the physics in `fret-core`.
//!
//! A library, so that the program `fret` and the one that comes with the Python wheel are the same to the letter.

mod arguments;
mod case_file;
mod commands;
mod failure;
mod figures;
mod interrupt;
mod output;
mod progress;
mod summary;
mod sweep;
mod tally;
mod terminal;

use std::ffi::OsString;

use clap::Parser;
use clap::error::ErrorKind;

use arguments::{Arguments, Verb};
use failure::Failure;

/// Does what the words of a command line ask for, the first being the program's name; answers go to the process's own
/// streams. Gives the exit code: 0 solved, 1 refused, 2 failed, 130 interrupted.
pub fn command_line(words: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) => return asked_for_help_or_mistaken(&error),
    };
    match dispatch(&arguments.verb) {
        Ok(()) => 0,
        Err(failure) => {
            terminal::say(&failure.render(terminal::errors_in_colour()));
            failure.code()
        }
    }
}

fn dispatch(verb: &Verb) -> Result<(), Failure> {
    match verb {
        Verb::Run(arguments) => commands::run::run(arguments),
        Verb::Check { case } => commands::check::check(case),
        Verb::Plan { case, json } => commands::plan::plan(case, *json),
        Verb::Schema => commands::schema::schema(),
        Verb::Study(_) => Err(Failure::not_built("fret study")),
        Verb::Extremes(_) => Err(Failure::not_built("fret extremes")),
        Verb::Stress(_) => Err(Failure::not_built("fret stress")),
        Verb::Report(_) => Err(Failure::not_built("fret report")),
        Verb::Export(_) => Err(Failure::not_built("fret export")),
        Verb::Sweep(arguments) => commands::sweep::sweep(arguments),
    }
}

/// Help and version are answers; anything else clap objects to is a refusal, for which clap's own exit code 2 is taken.
fn asked_for_help_or_mistaken(error: &clap::Error) -> u8 {
    // A stream that is closed cannot be told so.
    let _ = error.print();
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => 0,
        _ => failure::REFUSED,
    }
}
