//! The result folder: the only place of the command that writes files.
//!
//! `case.toml` (verbatim copy), `run.json` (how it was computed and how it ended), `history.csv` (a line an increment), `cycles.csv` (a line a cycle),
//! `fields.zarr` (kept fields). An increment's line is written after its fields: whatever has a line is complete.

mod field_store;
mod history_table;
mod run_record;
mod whole_file;

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::cycle::CycleRecord;
use fret_core::history::{KeptFields, StepRecord};
use fret_core::plan::Plan;

use crate::case_file::CaseFile;
use crate::failure::{Failure, Unwritten};
use crate::tally::Tally;
use field_store::FieldStore;
use history_table::HistoryTable;
pub use run_record::{RunRecord, resolved};
use whole_file::write_whole;

const CASE: &str = "case.toml";
const RECORD: &str = "run.json";
const HISTORY: &str = "history.csv";
const CYCLES: &str = "cycles.csv";
const FIELDS: &str = "fields.zarr";

/// What lies where the results shall go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Nothing that matters.
    Free,
    /// Earlier results of the same case.
    SameCase,
    /// Something else, which the user wants written into.
    Forced,
}

/// A folder a run writes into while it goes.
#[derive(Debug)]
pub struct ResultFolder {
    path: PathBuf,
    record: RunRecord,
    history: HistoryTable,
    cycles: HistoryTable,
    fields: FieldStore,
}

impl ResultFolder {
    /// What lies at `path`, and whether results of this case may go there. Writes nothing.
    pub fn standing(path: &Path, case_file: &CaseFile, force: bool) -> Result<Standing, Failure> {
        let shown = path.display();
        let other_folder = "choose another folder with --out DIR";
        if path.exists() && !path.is_dir() {
            return Err(Failure::Call(
                format!("{shown}: a file, not a folder for results"),
                other_folder.to_owned(),
            ));
        }
        let holds_nothing = match fs::read_dir(path) {
            Ok(mut entries) => entries.next().is_none(),
            // Not there, or not to be looked into: the attempt to write will tell.
            Err(_) => true,
        };
        if holds_nothing {
            return Ok(Standing::Free);
        }
        let earlier = fs::read(path.join(RECORD)).ok();
        let same_text = || fs::read(path.join(CASE)).is_ok_and(|text| text == case_file.text.as_bytes());
        match earlier {
            Some(record) if run_record::is_of_case(&record, case_file) || same_text() => {
                Ok(Standing::SameCase)
            }
            _ if force => Ok(Standing::Forced),
            Some(_) => Err(Failure::Call(
                format!("{shown}: holds the results of another case"),
                format!("{other_folder}, or replace them with --force"),
            )),
            None => Err(Failure::Call(
                format!("{shown}: holds files that are no results of fret"),
                format!("{other_folder}, or write beside them with --force"),
            )),
        }
    }

    /// Makes the folder ready for a run: earlier results are gone afterwards, other files are left alone.
    pub fn open(
        path: &Path,
        case_file: &CaseFile,
        plan: &Plan,
        record: RunRecord,
    ) -> Result<Self, Unwritten> {
        fs::create_dir_all(path).map_err(Unwritten::at(path))?;
        // First the record, so that a kill in between never leaves an old record beside new numbers.
        write_whole(&path.join(RECORD), &record.running())?;
        remove_earlier_fields(&path.join(FIELDS))?;
        write_whole(&path.join(CASE), case_file.text.as_bytes())?;
        Ok(Self {
            history: HistoryTable::create(&path.join(HISTORY))?,
            cycles: HistoryTable::create_for_cycles(&path.join(CYCLES))?,
            fields: FieldStore::create(&path.join(FIELDS), plan)?,
            path: path.to_owned(),
            record,
        })
    }

    /// Writes down a solved increment: first its kept fields, then its line.
    pub fn keep(&mut self, record: &StepRecord, kept: Option<&KeptFields>) -> Result<(), Unwritten> {
        if let Some(kept) = kept {
            self.fields.keep(kept)?;
        }
        self.history.add(record)
    }

    /// Writes down a cycle that is over.
    pub fn keep_cycle(&mut self, record: &CycleRecord) -> Result<(), Unwritten> {
        self.cycles.add_cycle(record)
    }

    /// Writes down how the run ended.
    pub fn close(self, tally: &Tally, wall_s: f64, failure: Option<&Failure>) -> Result<(), Unwritten> {
        self.history.close()?;
        self.cycles.close()?;
        write_whole(&self.path.join(RECORD), &self.record.ended(tally, wall_s, failure))
    }
}

fn remove_earlier_fields(path: &Path) -> Result<(), Unwritten> {
    match fs::remove_dir_all(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Unwritten::at(path)(error)),
        _ => Ok(()),
    }
}
