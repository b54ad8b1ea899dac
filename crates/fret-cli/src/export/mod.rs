//! Results in forms that other programs read. Each is a copy of the result folder; the folder itself stays as it is.

pub mod csv;
pub mod npz;
pub mod volume;
pub mod vtk;

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::{Failure, Unwritten};
use fret_results::{is_named, new_file, part_of, refuse_link, resolved_path};

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

/// Makes a folder for the file named after the history, and those of the fields of an increment, in whose names `#` is a number. Earlier ones are gone
/// then. A folder of other files, or of results, is none of an export.
fn folder(path: &Path, names: [&str; 2]) -> Result<(), Failure> {
    let path = resolved_path(path);
    refuse_link(&path)?;
    let [history, _] = names;
    let (mut ours, mut others) = (Vec::new(), Vec::new());
    for entry in fs::read_dir(&path).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_str().unwrap_or_default();
        let is_ours =
            names.iter().any(|pattern| is_named(name.strip_suffix(".part").unwrap_or(name), pattern));
        if is_ours { ours.push(entry.path()) } else { others.push(name.to_owned()) }
    }
    let is_earlier = path.join(history).exists() && !path.join("run.json").exists();
    if let Some(other) = others.first().filter(|_| !is_earlier) {
        return Err(Failure::call(
            format!("{}: holds {other}, and no earlier export of this kind", path.display()),
            "choose another folder with --out DIR",
        ));
    }
    for file in ours {
        fs::remove_file(&file).map_err(Unwritten::at(&file))?;
    }
    fs::create_dir_all(&path).map_err(|error| Unwritten::at(&path)(error).into())
}
