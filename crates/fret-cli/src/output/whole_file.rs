//! Files that are there whole or not at all: written beside, synchronised, renamed into place.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::failure::Unwritten;

/// Writes a file. A reader, a kill and a power failure at any moment find the old content or the new one, never a part.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Unwritten> {
    write_whole_by(path, |file| file.write_all(content))
}

/// The same, piece by piece.
pub fn write_whole_by(
    path: &Path,
    content: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), Unwritten> {
    let part = part_of(path);
    File::create(&part)
        .and_then(|mut file| {
            content(&mut file)?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&part, path))
        .map_err(|error| {
            // What is left of a failed attempt is of no use; if even that cannot be removed, the first error says why.
            let _ = fs::remove_file(&part);
            Unwritten::at(path)(error)
        })
}

fn part_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    PathBuf::from(name)
}
