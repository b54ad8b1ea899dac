//! `history.csv`, read back: columns of numbers by name.

use std::fs;
use std::path::Path;

use fret_core::history::{STEP_COLUMNS, Value};
use fret_core::units::Units;

use crate::error::ResultsError;
use crate::names::HISTORY;
use crate::run_record::Record;

/// The one column of words.
const REGIME: &str = "regime";

/// Whether some increments have no number in this column.
fn may_lack(name: &str) -> bool {
    STEP_COLUMNS.iter().any(|column| column.name == name && matches!(column.value, Value::RealOrNone(_)))
}

/// A table of numbers, a row an increment; not a number where an increment has none.
#[derive(Debug)]
pub struct Table {
    /// The table as it was written, whole lines only.
    pub text: String,
    columns: Vec<(String, Vec<f64>)>,
    regimes: Vec<String>,
    rows: usize,
}

impl Table {
    /// The history of a run in a folder, whose record is known.
    ///
    /// # Errors
    /// When there is none, or that of a solved run is not as it was written.
    pub fn of(folder: &Path, record: &Record) -> Result<Self, ResultsError> {
        let path = folder.join(HISTORY);
        let table = Self::read(&path)?;
        record.refuse_changed(folder, HISTORY, &fs::read(&path).unwrap_or_default())?;
        match record.end.as_ref().map(|end| end.totals.increments) {
            Some(all) if record.is_solved() && all != table.rows => Err(ResultsError::damaged(
                &path,
                &format!("{} increments of {all} that were solved", table.rows),
            )),
            _ => Ok(table),
        }
    }

    /// Reads a table. A last line that a kill has torn is left away.
    ///
    /// # Errors
    /// When it cannot be read, or is not the table of a run.
    pub fn read(path: &Path) -> Result<Self, ResultsError> {
        let text = fs::read_to_string(path)
            .map_err(|error| ResultsError::damaged(path, &format!("cannot be read: {error}")))?;
        let text = text.rsplit_once('\n').map_or("", |(whole, _)| whole).to_owned() + "\n";
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().unwrap_or_default().split(',').map(Units::name_of).collect();
        let mut table = Self { text: String::new(), columns: Vec::new(), regimes: Vec::new(), rows: 0 };
        table.columns.extend(names.iter().map(|&name| (name.to_owned(), Vec::new())));
        for (number, line) in lines.enumerate() {
            let torn =
                || ResultsError::damaged(path, &format!("line {} is not a row of the table", number + 2));
            let cells: Vec<&str> = line.split(',').collect();
            if cells.len() != names.len() {
                return Err(torn());
            }
            for (cell, (name, column)) in cells.iter().zip(&mut table.columns) {
                if name == REGIME {
                    table.regimes.push((*cell).to_owned());
                } else if cell.is_empty() && may_lack(name) {
                    column.push(f64::NAN);
                } else {
                    column.push(cell.parse().map_err(|_| torn())?);
                }
            }
            table.rows += 1;
        }
        table.columns.retain(|(name, _)| name != REGIME);
        let needed = ["increment", "stage", "normal_force", "tangential_force_x", "shift_x", "residual"];
        match needed.iter().find(|needed| !names.contains(needed)) {
            Some(needed) => Err(ResultsError::damaged(path, &format!("has no column {needed:?}"))),
            None => Ok(Self { text, ..table }),
        }
    }

    /// Number of increments.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether there is a column of numbers of this name.
    pub fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|(column, _)| column == name)
    }

    /// A column; no rows when there is none of this name.
    pub fn column(&self, name: &str) -> &[f64] {
        self.columns.iter().find(|(column, _)| column == name).map_or(&[], |(_, values)| values)
    }

    /// A value; not a number when there is none.
    pub fn at(&self, name: &str, row: usize) -> f64 {
        self.column(name).get(row).copied().unwrap_or(f64::NAN)
    }

    /// The columns `name_x` and `name_y` side by side.
    pub fn vectors(&self, name: &str) -> Vec<[f64; 2]> {
        let [x, y] = ["x", "y"].map(|axis| self.column(&format!("{name}_{axis}")));
        x.iter().zip(y).map(|(x, y)| [*x, *y]).collect()
    }

    /// All columns of numbers, in the order of the file.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.columns.iter().map(|(name, values)| (name.as_str(), values.as_slice()))
    }

    /// What the contact did in each increment.
    pub fn regimes(&self) -> &[String] {
        &self.regimes
    }
}
