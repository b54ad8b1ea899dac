//! Results in forms that other programs read. Each is a copy of the result folder; the folder itself stays as it is.

pub mod csv;
pub mod npz;
pub mod volume;
pub mod vtk;

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::{Failure, Unwritten};
use fret_results::{new_file, part_of, refuse_link, resolved_path};

/// Writes a file in one go beside its place and renames it there: a reader never finds a part.
fn written(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let part = part_of(path);
    let outcome = new_file(&part).map_err(|error| Unwritten::at(path)(error).into()).and_then(|file| {
        let mut writer = BufWriter::new(file);
        fill(&mut writer)?;
        writer.flush().map_err(Unwritten::at(path))?;
        fs::rename(&part, path).map_err(|error| Unwritten::at(path)(error).into())
    });
    if outcome.is_err() {
        // What is left of a failed attempt is of no use; if even that cannot be removed, the first error says why.
        let _ = fs::remove_file(&part);
    }
    outcome
}

/// Makes a folder for several files.
fn folder(path: &Path) -> Result<(), Failure> {
    let path = resolved_path(path);
    refuse_link(&path)?;
    fs::create_dir_all(&path).map_err(|error| Unwritten::at(&path)(error).into())
}
