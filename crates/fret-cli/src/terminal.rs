//! The two streams: answers on standard output, everything else on standard error; when there is colour and when there is a person.

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use fret_core::case::{printable, steers};
use serde_json::Value;

use crate::failure::{Failure, Unwritten};
use crate::figures::shortened;

/// Letters of a line that is said, at the most: names and titles come from files, and may be as long as these.
const LONGEST_LINE: usize = 2000;

/// What a verb answers: a record for programs, and words for a person.
#[derive(Debug)]
pub struct Answer {
    /// For programs.
    pub record: Value,
    /// For a person.
    pub text: String,
}

impl Answer {
    /// Both.
    pub fn new(record: Value, text: impl Into<String>) -> Self {
        Self { record, text: text.into() }
    }
}

/// Writes an answer; what would steer a terminal is shown, not sent. A reader that has gone away (`fret plan case.toml | head -1`) is no failure.
pub fn answer(text: &str) -> Result<(), Failure> {
    to_standard_output(format!("{}\n", printable(text)).as_bytes())
}

/// Writes bytes as they are: for programs, which must not have them changed.
pub fn to_standard_output(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Unwritten::at(Path::new("standard output"))(error).into())
        }
        _ => Ok(()),
    }
}

/// Writes an answer for programs: in JSON, which shows what would steer a terminal in its own way.
pub fn answer_in_json(value: &impl Display) -> Result<(), Failure> {
    // Only texts hold such letters, and none of them lies beyond the sixteen bits that JSON's way of writing letters has.
    let escaped =
        |letter| if steers(letter) { format!("\\u{:04x}", u32::from(letter)) } else { String::from(letter) };
    answer(&format!("{value:#}").chars().map(escaped).collect::<String>())
}

/// Says something beside the answer, printable and in lines of bounded length. When standard error is closed, there is nobody to
/// tell.
pub fn say(text: &str) {
    let lines: Vec<String> = text.lines().map(|line| shortened(line, LONGEST_LINE)).collect();
    say_in_colour(&printable(&lines.join("\n")));
}

/// Says what is printable already, and may be in colour.
pub fn say_in_colour(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Whether a person watches standard error.
pub fn is_watched() -> bool {
    io::stderr().is_terminal()
}

/// Whether standard error takes colour.
pub fn errors_in_colour() -> bool {
    is_watched() && colour_is_welcome()
}

fn colour_is_welcome() -> bool {
    let unwelcome = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    !unwelcome && !dumb
}
