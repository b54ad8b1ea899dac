//! Files of heights and friction maps that a case names. What their numbers mean is the core's to say.

use std::io::ErrorKind;
use std::path::Path;
use std::{fs, io};

use fret_core::case::{ArraySource, numbers};
use ndarray::Array2;

/// Larger files are no array of a grid: 2^26 cells of 16 letters each.
const MOST_BYTES: u64 = 1 << 30;

/// The array of a file; a relative name starts at `folder`. Only ordinary files are read, so that nothing waits on a pipe.
pub fn array(folder: &Path, source: ArraySource<'_>) -> Result<Array2<f64>, String> {
    let ArraySource::File(name) = source else {
        return Err("a command hands over no arrays: file = \"...\"".to_owned());
    };
    let path = folder.join(name);
    let facts = fs::metadata(&path).map_err(|error| unreadable(&error))?;
    if !facts.is_file() {
        return Err("no ordinary file".to_owned());
    }
    if facts.len() > MOST_BYTES {
        return Err(format!("{} bytes: at most {MOST_BYTES} are read", facts.len()));
    }
    let bytes = fs::read(&path).map_err(|error| unreadable(&error))?;
    numbers(&bytes).map_err(|error| error.to_string())
}

fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "no such file".to_owned(),
        ErrorKind::PermissionDenied => "no permission to read it".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}
