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

/// Makes a folder for the `fields_*` of an increment with this ending and for the file named after the history. What it holds has to be an earlier
/// export, which is then gone.
fn folder(path: &Path, history: &str, ending: &str) -> Result<(), Failure> {
    let path = resolved_path(path);
    refuse_link(&path)?;
    let is_ours = |name: &str| {
        let number = name.strip_prefix("fields_").and_then(|rest| rest.strip_suffix(ending));
        name == history || number.is_some_and(|number| number.bytes().all(|digit| digit.is_ascii_digit()))
    };
    let entries: Vec<_> = fs::read_dir(&path).into_iter().flatten().flatten().collect();
    if let Some(other) = entries.iter().find(|entry| !entry.file_name().to_str().is_some_and(is_ours)) {
        return Err(Failure::call(
            format!(
                "{}: holds {}, which is no file of an export",
                path.display(),
                other.file_name().display()
            ),
            "choose another folder with --out DIR",
        ));
    }
    for entry in entries {
        fs::remove_file(entry.path()).map_err(Unwritten::at(&entry.path()))?;
    }
    fs::create_dir_all(&path).map_err(|error| Unwritten::at(&path)(error).into())
}
