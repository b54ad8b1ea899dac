//! A file that somebody has measured: its name in messages, its bytes.

use std::io::Read;
use std::path::Path;

use crate::failure::Failure;

/// Bytes of a log, at the most.
const MOST_BYTES: u64 = 1 << 30;

/// The name of a log in messages and results.
pub fn name_of(path: &Path) -> String {
    path.display().to_string()
}

/// The bytes of a log: an ordinary file, measured before it is read.
///
/// # Errors
/// When it is none, or too long, or cannot be read.
pub fn content(log: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable =
        |why: String| Failure::call(format!("{}: {why}", name_of(log)), "a log is a text file with columns");
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
