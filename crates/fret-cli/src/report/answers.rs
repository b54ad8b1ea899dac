//! Answers of other commands, read back.

use std::fs;
use std::path::Path;

use serde::de::DeserializeOwned;

use crate::failure::Failure;

/// What another command has told of these results; `None` where it was not asked. One that cannot be read is a sentence for the page.
pub fn answer_beside<T: DeserializeOwned>(
    results: &Path,
    [folder, record]: [&str; 2],
) -> Option<Result<T, String>> {
    let path = results.join(folder).join(record);
    path.exists().then(|| {
        let again = format!("run fret {folder} again");
        read_answer(&path, &again).map_err(|failure| format!("{}: {again}.", failure.message()))
    })
}

/// An answer of another command, as it was written; `again` says what to do where it cannot be read.
pub fn read_answer<T: DeserializeOwned>(path: &Path, again: &str) -> Result<T, Failure> {
    let refuse = |why: String| Failure::call(format!("{}: {why}", path.display()), again);
    let text = fs::read(path).map_err(|error| refuse(error.to_string()))?;
    serde_json::from_slice(&text).map_err(|error| refuse(format!("cannot be read: {error}")))
}
