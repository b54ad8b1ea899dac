//! `fret export`: the results of a run in forms that other programs read.

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::arguments::ExportArguments;
use crate::export::{csv, npz, vtk};
use crate::failure::Failure;
use crate::figures::counted;
use crate::manner::refuse_other_file;
use crate::terminal::Answer;
use fret_results::Results;

type Writing = fn(&Results, &Path) -> Result<Vec<PathBuf>, Failure>;

/// Name of the archive of arrays in a run folder.
const NPZ: &str = "export.npz";

/// Writes what is asked for, and tells which files were written.
pub fn export(arguments: &ExportArguments) -> Result<Answer, Failure> {
    let forms: [(bool, &str, Writing); 3] = [
        (arguments.npz, NPZ, npz::write),
        (arguments.csv, "csv", csv::write),
        (arguments.vtk, "vtk", vtk::write),
    ];
    let asked: Vec<(&str, Writing)> =
        forms.into_iter().filter(|(asked, _, _)| *asked).map(|(_, name, write)| (name, write)).collect();
    if arguments.manner.out.is_some() && asked.len() > 1 {
        return Err(Failure::call(
            "--out names one place, and several forms are asked for",
            "ask for one form at a time, or leave --out away",
        ));
    }
    let results = Results::read(&arguments.results)?;
    let mut files = Vec::new();
    for (name, write) in asked {
        let path = arguments.manner.out.clone().unwrap_or_else(|| arguments.results.join(name));
        if name == NPZ {
            refuse_other_file(&path, &["npz"])?;
        } else if path.exists() && !path.is_dir() {
            return Err(Failure::call(
                format!("{}: a file, where the export is a folder", path.display()),
                "choose another place with --out DIR",
            ));
        }
        files.extend(write(&results, &path)?);
    }
    for file in &files {
        arguments.manner.wrote(file);
    }
    let steps = counted(results.fields.steps.len(), "kept increment");
    let record = json!({
        "status": "exported",
        "files": files,
        "increments": results.table.rows(),
        "kept_increments": results.fields.steps,
        "unfinished": results.unfinished(),
    });
    let first = files.first().map_or(String::new(), |file| file.display().to_string());
    let more = match files.len() {
        0 | 1 => String::new(),
        count => format!(" and {} more", count - 1),
    };
    let rows = counted(results.table.rows(), "increment");
    let unfinished = results.unfinished().map_or(String::new(), |why| format!("\n{why}"));
    Ok(Answer::new(record, format!("{first}{more}: {rows} of history, {steps}{unfinished}")))
}
