//! `fret identify`: constants of a model from measured fretting loops.

use std::io::Read;
use std::path::{Path, PathBuf};

use fret_core::identify;
use fret_core::measured::Asked;

use super::columns_asked::pairs;
use crate::arguments::IdentifyArguments;
use crate::failure::Failure;
use crate::identify::{Answer, Request, identify as identified, name_of};
use crate::terminal;
use crate::threads;
use fret_results::CaseFile;
use fret_results::{folder_for_answers, stem, write_whole};

/// The answer, which marks its folder.
const IDENTIFIED: &str = "identified.json";
/// How columns and units are chosen.
const EXAMPLE: &str = "displacement=...,force=...";
/// Bytes of a log, at the most.
const MOST_BYTES: u64 = 1 << 30;

/// Identifies a log by a case; writes what was found beside it.
pub fn identify(arguments: &IdentifyArguments, as_json: bool) -> Result<(), Failure> {
    let name = name_of(&arguments.log);
    let bytes = content(&arguments.log)?;
    let log = identify::Request {
        asked: Asked {
            columns: pairs("--columns", &arguments.columns, EXAMPLE)?,
            units: pairs("--units", &arguments.units, EXAMPLE)?,
        },
        cycle: arguments.cycle,
        strict: arguments.strict,
    };
    let request = Request { log, key: arguments.fit.clone() };
    let case_file = CaseFile::read(&arguments.case)?;
    let pool = threads::pool(threads::asked(arguments.threads))?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.log));
    let folder = folder_for_answers(&folder, &[IDENTIFIED], "an identification")?;
    let answer = pool.install(|| identified((&name, &bytes), &case_file, &request))?;
    write(&folder, &answer)?;
    if as_json {
        return terminal::answer_in_json(&answer.json());
    }
    if !arguments.quiet {
        terminal::answer(&format!("{}\nwritten to {}", answer.text(), folder.display()))?;
    }
    Ok(())
}

/// The bytes of a log: an ordinary file, measured before it is read.
///
/// # Errors
/// When it is none, or too long, or cannot be read.
pub fn content(log: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |why: String| {
        Failure::Call(format!("{}: {why}", name_of(log)), "a log is a text file with columns".to_owned())
    };
    let found = std::fs::metadata(log).map_err(|error| unreadable(error.to_string()))?;
    if !found.is_file() {
        return Err(unreadable("no ordinary file".to_owned()));
    }
    if found.len() > MOST_BYTES {
        return Err(unreadable(format!("{} bytes: more than {MOST_BYTES}", found.len())));
    }
    if found.len() == 0 {
        // Not read: some files of the kernel say so too, and wait for ever.
        return Ok(Vec::new());
    }
    // A file may grow while it is read.
    let mut bytes = Vec::new();
    let file = std::fs::File::open(log).map_err(|error| unreadable(error.to_string()))?;
    file.take(MOST_BYTES).read_to_end(&mut bytes).map_err(|error| unreadable(error.to_string()))?;
    Ok(bytes)
}

/// The folder for the answer, when none is named.
fn default_folder(log: &Path) -> PathBuf {
    Path::new("results").join(format!("{}-identified", stem(log, "log").display()))
}

/// Writes the answer: numbers, a table of the cycles, a page.
pub fn write(folder: &Path, answer: &Answer) -> Result<(), Failure> {
    write_whole(&folder.join(IDENTIFIED), format!("{:#}\n", answer.json()).as_bytes())?;
    write_whole(&folder.join("identified.html"), answer.page().as_bytes())?;
    write_whole(&folder.join("cycles.csv"), answer.table().as_bytes())?;
    Ok(())
}
