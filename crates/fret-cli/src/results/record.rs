//! `run.json`, read back: the one place where it is judged whether a folder holds results that this program can read, and whether they are
//! those that were written.

use std::fs;
use std::io;
use std::path::Path;

use serde_json::Value;

use super::unusable;
use crate::failure::Failure;
use crate::output::{CASE, FORMAT, RECORD, checksums, recorded_question};

/// The record of the results in a folder.
///
/// # Errors
/// When there are none, or none that this program can read, or they were changed since.
pub fn read_record(folder: &Path) -> Result<Value, Failure> {
    if !folder.is_dir() {
        let what = if folder.exists() { "a file, not a folder of results" } else { "no such folder" };
        return Err(unusable(folder, what));
    }
    let path = folder.join(RECORD);
    let text = match fs::read(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(unusable(folder, "no results of fret: it has no run.json"));
        }
        read => read.map_err(|error| unusable(&path, &format!("cannot be read: {error}")))?,
    };
    let record: Value = serde_json::from_slice(&text)
        .map_err(|error| unusable(&path, &format!("not what a run writes: {error}")))?;
    if record["program"] != "fretting" || record["format"] != FORMAT {
        return Err(unusable(folder, "results of another program, or of another version of the format"));
    }
    if record["question_fnv1a64"].is_string() && record["question_fnv1a64"] != recorded_question(&record) {
        return Err(unusable(&path, "its plan was changed since it was written"));
    }
    if is_solved(&record) {
        refuse_changed(&record, folder, CASE, &fs::read(folder.join(CASE)).unwrap_or_default())?;
    }
    Ok(record)
}

/// Whether a record is that of a solved run.
pub fn is_solved(record: &Value) -> bool {
    record["status"] == "solved"
}

/// Refuses a file of a solved run that is not as it was written. Records of earlier builds do not tell.
///
/// # Errors
/// When it is not.
pub fn refuse_changed(record: &Value, folder: &Path, name: &str, content: &[u8]) -> Result<(), Failure> {
    let is_other = |(of, found): (String, Value)| {
        let written = &record["checksums"][of];
        written.is_u64() && *written != found
    };
    if is_solved(record) && checksums([(name, content)]).into_iter().any(is_other) {
        return Err(unusable(&folder.join(name), "missing, or changed since the run was solved"));
    }
    Ok(())
}
