//! The command `fret`: parse, dispatch, exit code. The verbs live in `commands`, the physics in `fret-core`.

mod arguments;
mod case_file;
mod commands;
mod failure;
mod figures;
mod interrupt;
mod output;
mod progress;
mod summary;
mod tally;
mod terminal;

use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use arguments::{Arguments, Verb};
use failure::Failure;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return asked_for_help_or_mistaken(&error),
    };
    match dispatch(&arguments.verb) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            terminal::say(&failure.render(terminal::errors_in_colour()));
            ExitCode::from(failure.code())
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
        Verb::Stress(arguments) => commands::stress::stress(arguments),
        Verb::Report(_) => Err(Failure::not_built("fret report")),
        Verb::Export(_) => Err(Failure::not_built("fret export")),
        Verb::Sweep(_) => Err(Failure::not_built("fret sweep")),
    }
}

/// Help and version are answers; anything else clap objects to is a refusal, for which clap's own exit code 2 is taken.
fn asked_for_help_or_mistaken(error: &clap::Error) -> ExitCode {
    // A stream that is closed cannot be told so.
    let _ = error.print();
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => ExitCode::SUCCESS,
        _ => ExitCode::from(failure::REFUSED),
    }
}
