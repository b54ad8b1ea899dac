//! What every command takes that writes or prints results: where to, and how much is told.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use fret_core::history::{KeptFields, StepRecord};
use fret_core::model::MirroredState;
use fret_core::run::{Iteration, Observer};
use serde::Serialize;
use serde_json::json;

use crate::failure::{Failure, Unwritten};
use crate::figures::{duration, figure};
use crate::interrupt::go_on;
use crate::terminal::{self, Answer};
use fret_results::{folder_below, folder_for_answers, write_whole};

/// Where an answer is written, and how much is told. What `out` is, a file or a folder, and where it is without, a command says in its own words.
#[derive(Debug, Clone, Default, Args)]
pub struct Manner {
    /// Where the answer is written
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Print only errors
    #[arg(long, short)]
    pub quiet: bool,
    /// Also tell every step, the files that are written and the time taken
    #[arg(long, short, conflicts_with = "quiet")]
    pub verbose: bool,
}

impl Manner {
    /// That of what nobody watches.
    pub const SILENT: Self = Self { out: None, quiet: true, verbose: false };

    /// Says something beside the answer, unless only errors are wanted.
    pub fn say(&self, text: &str) {
        if !self.quiet {
            terminal::say(text);
        }
    }

    /// Says a step on the way, where all of them are wanted.
    pub fn step(&self, text: impl FnOnce() -> String) {
        if self.verbose {
            terminal::say(&text());
        }
    }

    /// Writes a file of the answer.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, path: &Path, content: &[u8]) -> Result<(), Unwritten> {
        write_whole(path, content)?;
        self.wrote(path);
        Ok(())
    }

    /// The same of one that programs read.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write_json(&self, path: &Path, answer: &impl Serialize) -> Result<(), Unwritten> {
        self.write(path, format!("{:#}\n", json!(answer)).as_bytes())
    }

    /// Tells of a file of the answer, or of its folder, written by others.
    pub fn wrote(&self, path: &Path) {
        self.step(|| format!("written: {}", path.display()));
    }

    /// Tells an answer to who asks; nothing for a person who wants only errors.
    ///
    /// # Errors
    /// When standard output cannot be written.
    pub fn tell(&self, answer: &Answer, as_json: bool, since: Instant) -> Result<(), Failure> {
        if as_json || !self.quiet {
            if as_json { terminal::answer_in_json(&answer.record)? } else { terminal::answer(&answer.text)? }
        }
        self.done(since);
        Ok(())
    }

    /// Tells the time taken, where all steps are wanted.
    pub fn done(&self, since: Instant) {
        self.step(|| format!("done in {}", duration(since.elapsed().as_secs_f64())));
    }
}

/// Whether a file is an answer of this program that another one may replace: of the kinds of `extensions`, and, where that is JSON, with a status;
/// not the record of a run, which names its program.
fn is_earlier_answer(path: &Path, extensions: &[&str]) -> bool {
    let kind = extensions
        .iter()
        .find(|ours| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ours)));
    match kind {
        Some(&"json") => {
            let text = fs::read(path).unwrap_or_default();
            let answer: Option<serde_json::Value> = serde_json::from_slice(&text).ok();
            text.is_empty()
                || answer.is_some_and(|answer| {
                    answer.get("status").is_some_and(serde_json::Value::is_string)
                        && answer.get("program").is_none()
                })
        }
        Some(_) => true,
        None => false,
    }
}

/// Refuses a file for an answer that is standard output, a folder, or an existing file that is no earlier answer.
///
/// # Errors
/// When it is one of them.
pub fn refuse_other_file(path: &Path, extensions: &[&str]) -> Result<(), Failure> {
    let found = if path == Path::new("-") {
        "standard output, where the answer is written to a file".to_owned()
    } else if path.is_dir() {
        "a folder, where the answer is one file".to_owned()
    } else if path.exists() && !is_earlier_answer(path, extensions) {
        format!("a file that is there already and is no .{} file of such an answer", extensions[0])
    } else {
        return Ok(());
    };
    Err(Failure::call(format!("{}: {found}", path.display()), "choose another place with --out FILE"))
}

/// The folder of an answer about a run: the one that is asked for, which an answer of this kind marks by a file, or one below the results.
/// `what` names answers of this kind, as in `stresses of a run`.
///
/// # Errors
/// When it cannot be made, or holds something else.
pub fn place_of_answer(
    manner: &Manner,
    results: &Path,
    [name, mark]: [&str; 2],
    what: &str,
) -> Result<PathBuf, Failure> {
    match &manner.out {
        Some(folder) => Ok(folder_for_answers(folder, &[mark], what)?),
        None => Ok(folder_below(results, Path::new(name))?),
    }
}

/// What is told of a solved increment; `place` says where in the history it is, and its number is so many digits wide.
pub fn increment_line(record: &StepRecord, width: usize, place: &str) -> String {
    format!(
        "increment {:>width$}{place}  force {}  max pressure {}  residual {:.1e}",
        record.increment,
        figure(record.normal_force),
        figure(record.max_pressure),
        record.residual.largest()
    )
}

/// Stops a run when somebody asks to, and tells every increment where all steps are wanted.
pub struct Listener<'a> {
    tells: &'a Manner,
    /// Whether the history is asked for its fields when it is solved.
    keeps: bool,
}

impl<'a> Listener<'a> {
    /// Tells as the manner says.
    pub fn telling(tells: &'a Manner) -> Self {
        Self { tells, keeps: false }
    }
}

impl Listener<'static> {
    /// Tells nothing.
    pub fn silent() -> Self {
        static SILENT: Manner = Manner::SILENT;
        Self::telling(&SILENT)
    }

    /// The same for a history that is asked for its fields.
    pub fn keeping() -> Self {
        Self { keeps: true, ..Self::silent() }
    }
}

impl Observer for Listener<'_> {
    fn iterated(&mut self, _: &Iteration) -> ControlFlow<()> {
        go_on()
    }

    fn solved(
        &mut self,
        record: &StepRecord,
        _: MirroredState<'_>,
        _: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        self.tells.step(|| increment_line(record, 0, ""));
        go_on()
    }

    fn leaves_fields(&self) -> bool {
        self.keeps
    }
}
