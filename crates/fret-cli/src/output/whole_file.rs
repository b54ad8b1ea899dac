//! Files that are there whole or not at all: written beside, renamed into place.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::failure::Unwritten;

/// Writes a file and waits until it is on the disk. A reader, a kill and a power failure find the old content or the new one.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Unwritten> {
    write(path, content, File::sync_all)
}

/// Writes a file without waiting for the disk: whole for a reader and after a kill, not after a power failure.
pub fn write_swiftly(path: &Path, content: &[u8]) -> Result<(), Unwritten> {
    write(path, content, |_| Ok(()))
}

fn write(path: &Path, content: &[u8], settle: fn(&File) -> std::io::Result<()>) -> Result<(), Unwritten> {
    let part = part_of(path);
    File::create(&part)
        .and_then(|mut file| {
            file.write_all(content)?;
            settle(&file)
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
