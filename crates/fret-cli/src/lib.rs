//! The command `fret`: parse, dispatch, exit code. The verbs live in `commands`, the physics in `fret-core`.
//!
//! A library, so that the program `fret` and the one that comes with the Python wheel are the same to the letter.

mod arguments;
mod commands;
mod defect;
pub mod embedded;
mod explore;
mod export;
mod failure;
mod figures;
mod heat;
mod identify;
mod interrupt;
mod log_file;
mod loop_numbers;
mod manner;
mod plan_words;
mod report;
mod run;
mod scatter;
mod stress;
mod study;
mod sweep;
mod table;
mod templates;
mod terminal;
mod threads;
mod way;

use std::ffi::OsString;
use std::time::Instant;

use clap::Parser;
use clap::error::ErrorKind;

use arguments::{Arguments, Verb};
use failure::{Failure, Told};
use manner::Manner;

/// Does what the words of a command line ask for, the first being the program's name; answers go to the process's own
/// streams. Gives the exit code: 0 solved, 1 refused, 2 failed, 130 interrupted.
pub fn command_line(words: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(error) => return asked_for_help_or_mistaken(&error),
    };
    defect::listen();
    interrupt::outlive_full_files();
    match defect::caught(|| dispatch(&arguments)) {
        Ok(()) => 0,
        Err(Told { failure, in_json }) => {
            if arguments.json && !in_json {
                // A reader that cannot be told is told by the exit code.
                let _ = terminal::answer_in_json(&serde_json::json!(failure.record()));
            }
            terminal::say_in_colour(&failure.render(terminal::errors_in_colour()));
            failure.code()
        }
    }
}

fn dispatch(arguments: &Arguments) -> Result<(), Told> {
    let as_json = arguments.json;
    let since = Instant::now();
    let (answer, manner) = match &arguments.verb {
        // these tell more than an answer, or another kind of one
        Verb::Sweep(arguments) => return commands::sweep::sweep(arguments, as_json, since),
        Verb::Run(arguments) => return commands::run::run(arguments, as_json, since),
        Verb::Explore(arguments) => return Ok(commands::explore::explore(arguments, as_json)?),
        Verb::Schema => return Ok(commands::schema::schema()?),
        Verb::Completions { shell } => return Ok(commands::shells::completions(*shell)?),
        Verb::Man { out: None } => return Ok(commands::shells::page_of_all()?),
        Verb::Extremes { .. } => {
            return Err(Failure::call(
                "`fret extremes` is no command any more",
                "run `cargo xtask extremes` in the repository; the page `Stiff and extreme cases` has its table",
            ))?;
        }
        Verb::Man { out: Some(out) } => (commands::shells::pages(out), None),
        Verb::Explain { warning } => (commands::explain::explain(warning.as_deref()), None),
        Verb::Check(arguments) => (commands::check::check(arguments), Some(&arguments.manner)),
        Verb::Plan(arguments) => (commands::plan::plan(arguments), Some(&arguments.manner)),
        Verb::Init(arguments) => (commands::init::init(arguments), Some(&arguments.manner)),
        Verb::Report(arguments) => (commands::report::report(arguments), Some(&arguments.manner)),
        Verb::Export(arguments) => (commands::export::export(arguments), Some(&arguments.manner)),
        Verb::Study(arguments) => (commands::study::study(arguments), Some(&arguments.manner)),
        Verb::Stress(arguments) => (commands::stress::stress(arguments), Some(&arguments.manner)),
        Verb::CompareScar(arguments) => {
            (commands::compare_scar::compare_scar(arguments), Some(&arguments.manner))
        }
        Verb::Heat(arguments) => (commands::heat::heat(arguments), Some(&arguments.manner)),
        Verb::Identify(arguments) => (commands::identify::identify(arguments), Some(&arguments.manner)),
        Verb::Sensitivity(arguments) => {
            (commands::sensitivity::sensitivity(arguments), Some(&arguments.manner))
        }
    };
    Ok(manner.unwrap_or(&Manner::default()).tell(&answer?, as_json, since)?)
}

/// Help and version are answers; anything else clap objects to is a refusal, for which clap's own exit code 2 is taken.
fn asked_for_help_or_mistaken(error: &clap::Error) -> u8 {
    let is_answer = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    if !is_answer && std::env::args_os().any(|argument| argument == "--json") {
        let failure = Failure::call(error.to_string().trim_end(), "");
        let _ = terminal::answer_in_json(&serde_json::json!(failure.record()));
    }
    // A stream that is closed cannot be told so.
    let _ = error.print();
    if is_answer { 0 } else { failure::REFUSED }
}
