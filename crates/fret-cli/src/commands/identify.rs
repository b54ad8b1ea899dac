//! `fret identify`: constants of a model from measured fretting loops.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::arguments::IdentifyArguments;
use crate::case_file::CaseFile;
use crate::failure::Failure;
use crate::identify::{Identification, Request, identify as identified, name_of};
use crate::output::{folder_for_answers, stem, write_whole};
use crate::terminal;
use crate::threads;

/// The answer, which marks its folder.
const IDENTIFIED: &str = "identified.json";
/// Bytes of a log, at the most.
const MOST_BYTES: u64 = 1 << 30;

/// Identifies a log by a case; writes what was found beside it.
pub fn identify(arguments: &IdentifyArguments, as_json: bool) -> Result<(), Failure> {
    let name = name_of(&arguments.log);
    let unreadable = |why: String| Failure::Call(format!("{name}: {why}"), String::new());
    let size = std::fs::metadata(&arguments.log).map_err(|error| unreadable(error.to_string()))?.len();
    if size > MOST_BYTES {
        return Err(unreadable(format!("{size} bytes: more than {MOST_BYTES}")));
    }
    let bytes = std::fs::read(&arguments.log).map_err(|error| unreadable(error.to_string()))?;
    let request = Request {
        columns: pairs("--columns", &arguments.columns)?,
        units: pairs("--units", &arguments.units)?,
        cycle: arguments.cycle,
        key: arguments.fit.clone(),
    };
    let case_file = CaseFile::read(&arguments.case)?;
    let pool = threads::pool(threads::asked(arguments.threads))?;
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.log));
    let folder = folder_for_answers(&folder, &[IDENTIFIED], "an identification")?;
    let answer = pool.install(|| identified((&name, &bytes), case_file, &request))?;
    write(&folder, &answer)?;
    if as_json {
        return terminal::answer_in_json(&answer.json);
    }
    if !arguments.quiet {
        terminal::answer(&format!("{}\nwritten to {}", answer.text, folder.display()))?;
    }
    Ok(())
}

/// The folder for the answer, when none is named.
fn default_folder(log: &Path) -> PathBuf {
    Path::new("results").join(format!("{}-identified", stem(log, "log").display()))
}

/// Writes the answer: numbers, a table of the cycles, a page.
pub fn write(folder: &Path, answer: &Identification) -> Result<(), Failure> {
    write_whole(&folder.join(IDENTIFIED), format!("{:#}\n", answer.json).as_bytes())?;
    write_whole(&folder.join("identified.html"), answer.page.as_bytes())?;
    write_whole(&folder.join("cycles.csv"), table(&answer.json["cycles"]).as_bytes())?;
    Ok(())
}

fn table(cycles: &Value) -> String {
    let rows = cycles.as_array().map(Vec::as_slice).unwrap_or_default();
    let names: Vec<&String> =
        rows.first().and_then(Value::as_object).map(|row| row.keys().collect()).unwrap_or_default();
    let mut text = names.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(",") + "\n";
    for row in rows {
        let cells: Vec<String> = names
            .iter()
            .map(|name| if row[*name].is_null() { String::new() } else { row[*name].to_string() })
            .collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

/// `role=name,role=name`.
fn pairs(option: &str, given: &[String]) -> Result<Vec<(String, String)>, Failure> {
    given
        .iter()
        .map(|pair| {
            pair.split_once('=')
                .map(|(role, name)| (role.trim().to_owned(), name.trim().to_owned()))
                .ok_or_else(|| {
                    Failure::Call(
                        format!("{option} {pair:?}: no equals sign"),
                        format!("{option} \"displacement=...,force=...\""),
                    )
                })
        })
        .collect()
}
