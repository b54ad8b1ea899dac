//! Results of a run, read back from their folder: finished ones, and what there is of others. Nothing is written here.

mod fields;
mod record;
mod table;

use std::path::{Path, PathBuf};

use fret_core::case::Units;
use fret_core::history::{CycleRecord, FIELDS};
use fret_core::machine::memory;
use serde_json::Value;

use crate::failure::Failure;
use crate::output::{CYCLES, FIELDS as FIELDS_FOLDER, HistoryTable};
pub use fields::{Field, Fields};
pub use record::{is_solved, read_record, refuse_changed};
pub use table::Table;

/// Bytes a cell of a field while it passes through.
const FIELD: usize = 4 * 8;

/// A result folder that could be read.
#[derive(Debug)]
pub struct Results {
    /// Where it lies.
    pub path: PathBuf,
    /// `run.json`.
    pub record: Value,
    /// `history.csv`: a row an increment.
    pub table: Table,
    /// `cycles.csv`: the cycles that are over.
    pub cycles: Vec<CycleRecord>,
    /// `fields.zarr`.
    pub fields: Fields,
}

impl Results {
    /// Reads a result folder: record and table whole, fields when they are asked for.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let record = read_record(path)?;
        let table = Table::of(path, &record)?;
        let cycles = cycles_of(path, &record)?;
        let fields = Fields::read(&path.join(FIELDS_FOLDER), &record, table.rows())?;
        // Fields are read one at a time: its bytes, its numbers, what is written of it.
        let [nx, ny] = fields.cells();
        memory::check(FIELD * nx * ny)?;
        Ok(Self { path: path.to_owned(), record, table, cycles, fields })
    }

    /// The title of the case, or the name of the folder.
    pub fn title(&self) -> String {
        match self.record["plan"]["case"]["title"].as_str() {
            Some(title) if !title.is_empty() => title.to_owned(),
            _ => self
                .path
                .file_name()
                .map_or_else(|| self.path.display().to_string(), |name| name.to_string_lossy().into_owned()),
        }
    }

    /// Why the run is not finished, in a sentence; none of a finished one.
    pub fn unfinished(&self) -> Option<String> {
        unfinished(&self.record, self.table.rows())
    }

    /// A part of the plan, when it is there and has the form that is asked for.
    pub fn planned<T: serde::de::DeserializeOwned>(&self, pointer: &str) -> Option<T> {
        self.record["plan"].pointer(pointer).and_then(|value| T::deserialize(value).ok())
    }

    /// Units that the case declares.
    pub fn units(&self) -> Option<Units> {
        self.planned("/case/units")
    }

    /// The head of a column of a field, with its unit where the case declares units.
    pub fn field_heading(&self, name: &str) -> String {
        Units::heading(self.units().as_ref(), name, kind_of_field(name), false)
    }

    /// Names of the stages.
    pub fn stages(&self) -> Vec<String> {
        let stages = self.record["plan"]["case"]["stages"].as_array();
        let name = |stage: &Value| stage["name"].as_str().unwrap_or_default().to_owned();
        stages.map_or_else(Vec::new, |stages| stages.iter().map(name).collect())
    }
}

/// The cycles of a run that are over.
///
/// # Errors
/// When the table of a solved run is not as it was written.
pub fn cycles_of(folder: &Path, record: &Value) -> Result<Vec<CycleRecord>, Failure> {
    let path = folder.join(CYCLES);
    refuse_changed(record, folder, CYCLES, &std::fs::read(&path).unwrap_or_default())?;
    Ok(HistoryTable::all_cycles(&path))
}

/// The kind of a field, or of a coordinate, for its unit.
pub fn kind_of_field(name: &str) -> &'static str {
    FIELDS.iter().find(|field| field.name == name).map_or("length", |field| field.unit)
}

/// Why the run of a record is not finished, in a sentence; none of a finished one. `solved`: increments it has solved.
pub fn unfinished(record: &Value, solved: usize) -> Option<String> {
    let status = record["status"].as_str().unwrap_or("unknown");
    let all = record["plan"]["increments"].as_u64().unwrap_or_default();
    let why = match (status, record["message"].as_str()) {
        ("solved", _) => return None,
        ("running", _) => "it is still going, or it was killed",
        (_, Some(message)) => message,
        (_, None) => "nobody knows why",
    };
    Some(format!("not the whole history, {solved} of {all} increments: {status}, {why}"))
}

/// Something that is no result of a run, or not a whole one.
fn unusable(path: &Path, what: &str) -> Failure {
    let help = "name the folder that `fret run CASE --out DIR` wrote";
    Failure::Call(format!("{}: {what}", path.display()), help.to_owned())
}
