//! `run.json`, read back: the one place where it is judged whether a folder holds results that this program can read, and whether they are
//! those that were written.

use std::fs;
use std::io;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use crate::checksums::checksums;
use crate::error::ResultsError;
use crate::names::{CASE, RECORD};
use crate::run_record::{End, Glance, Record, recorded_question};

/// The record of the results in a folder.
///
/// # Errors
/// When there are none, or none that this program can read, or they were changed since.
pub fn read_record(folder: &Path) -> Result<Record, ResultsError> {
    if !folder.is_dir() {
        let what = if folder.exists() { "a file, not a folder of results" } else { "no such folder" };
        return Err(ResultsError::unusable(folder, what));
    }
    let path = folder.join(RECORD);
    let text = match fs::read(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(ResultsError::unusable(folder, "no results of fret: it has no run.json"));
        }
        read => read.map_err(|error| ResultsError::damaged(&path, &format!("cannot be read: {error}")))?,
    };
    let foreign = |why: String| ResultsError::damaged(&path, &format!("not what a run writes: {why}"));
    let value: Value = serde_json::from_slice(&text).map_err(|error| foreign(error.to_string()))?;
    if !Glance::at(&text).is_known() {
        return Err(ResultsError::unusable(
            folder,
            "results of another program, or of another version of the format",
        ));
    }
    let mut record = Record::deserialize(&value).map_err(|error| foreign(error.to_string()))?;
    if record.status != "running" {
        record.end = Some(End::deserialize(&value).map_err(|error| foreign(error.to_string()))?);
    }
    let asked = recorded_question(&value, record.start.as_ref());
    if record.question_fnv1a64.is_some() && record.question_fnv1a64 != asked {
        return Err(ResultsError::damaged(&path, "its plan was changed since it was written"));
    }
    if record.is_solved() {
        record.refuse_changed(folder, CASE, &fs::read(folder.join(CASE)).unwrap_or_default())?;
    }
    Ok(record)
}

impl Record {
    /// Whether it is that of a solved run.
    pub fn is_solved(&self) -> bool {
        self.status == "solved"
    }

    /// Refuses a file of a solved run that is not as it was written. Records of earlier builds do not tell.
    ///
    /// # Errors
    /// When it is not.
    pub fn refuse_changed(&self, folder: &Path, name: &str, content: &[u8]) -> Result<(), ResultsError> {
        let Some(end) = self.end.as_ref().filter(|_| self.is_solved()) else { return Ok(()) };
        let is_other =
            |(of, found): (String, u32)| end.checksums.get(&of).is_some_and(|written| *written != found);
        if checksums([(name, content)]).into_iter().any(is_other) {
            return Err(ResultsError::damaged(
                &folder.join(name),
                "missing, or changed since the run was solved",
            ));
        }
        Ok(())
    }

    /// Why the run is not finished, in a sentence; none of a finished one. `solved`: increments it has solved.
    pub fn unfinished(&self, solved: usize) -> Option<String> {
        let (status, all) = (&self.status, self.plan.increments);
        let why = match (status.as_str(), self.end.as_ref().and_then(|end| end.message.as_deref())) {
            ("solved", _) => return None,
            ("running", _) => "it is still going, or it was killed",
            (_, Some(message)) => message,
            (_, None) => "nobody knows why",
        };
        Some(format!("not the whole history, {solved} of {all} increments: {status}, {why}"))
    }
}
