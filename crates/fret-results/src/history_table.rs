//! `history.csv`: a line an increment; `cycles.csv`: a line a cycle. On disk as soon as it is over.

use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use fret_core::case::Case;
use fret_core::history::{CYCLE_COLUMNS, Column, CycleRecord, Drive, STEP_COLUMNS, StepRecord, Value};
use fret_core::units::Units;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::error::{ResultsError, Unwritten};
use crate::names::CYCLES;
use crate::place::{new_file, own_file};
use crate::run_record::Record;

/// What a table holds a line of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lines {
    /// Increments.
    Increments,
    /// Cycles.
    Cycles,
}

impl Lines {
    /// The head, with units where the case declares some.
    fn head(self, case: &Case) -> String {
        fn names<R>(columns: &[Column<R>], case: &Case) -> String {
            let head = |column: &Column<R>| case.heading(column.name, column.unit_driven(Drive::of(case)));
            columns.iter().map(head).collect::<Vec<_>>().join(",") + "\n"
        }
        match self {
            Self::Increments => names(STEP_COLUMNS, case),
            Self::Cycles => names(CYCLE_COLUMNS, case),
        }
    }
}

/// What of a table was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Written {
    /// Bytes.
    pub bytes: u64,
    /// Their CRC-32.
    pub checksum: u32,
}

/// A table while it grows.
#[derive(Debug)]
pub struct HistoryTable {
    path: PathBuf,
    file: File,
    bytes: u64,
    checksum: crc32fast::Hasher,
}

impl HistoryTable {
    /// A table with its head; an earlier one is gone.
    pub fn create(path: &Path, lines: Lines, case: &Case) -> Result<Self, Unwritten> {
        let file = new_file(path).map_err(Unwritten::at(path))?;
        let mut table = Self { path: path.to_owned(), file, bytes: 0, checksum: crc32fast::Hasher::new() };
        table.append(&lines.head(case))?;
        Ok(table)
    }

    /// The table of a broken-off run, cut back to what was `written`.
    pub fn reopen(path: &Path, written: Written) -> Result<Self, Unwritten> {
        let Written { bytes, checksum } = written;
        let mut file = own_file(path).map_err(Unwritten::at(path))?;
        file.set_len(bytes).and_then(|()| file.seek(SeekFrom::End(0))).map_err(Unwritten::at(path))?;
        let checksum = crc32fast::Hasher::new_with_initial_len(checksum, bytes);
        Ok(Self { path: path.to_owned(), file, bytes, checksum })
    }

    /// Whether the table at `path` begins with what was `written`: its head and so many lines, none of them changed.
    pub fn holds(path: &Path, written: Written, lines: usize, case: &Case) -> bool {
        whole_lines(path, written, &Lines::Increments.head(case))
            .is_some_and(|text| text.lines().count() == lines)
    }

    /// The cycles in what was `written` of the table at `path`; none where that is not its head and whole lines, or changed.
    pub fn cycles(path: &Path, written: Written, case: &Case) -> Option<Vec<CycleRecord>> {
        let text = whole_lines(path, written, &Lines::Cycles.head(case))?;
        let names: Vec<&str> = CYCLE_COLUMNS.iter().map(|column| column.name).collect();
        text.lines().map(|line| cycle(&names, line)).collect()
    }

    /// Lines of the table at `path`, its head among them; none where there is no table.
    pub fn lines(path: &Path) -> usize {
        std::fs::read(path).map_or(0, |text| text.iter().filter(|&&byte| byte == b'\n').count())
    }

    /// What is written so far.
    pub fn written(&self) -> Written {
        Written { bytes: self.bytes, checksum: self.checksum.clone().finalize() }
    }

    /// What was written, read again; its path where it is not there any more.
    pub fn read_again(&self) -> Result<Vec<u8>, PathBuf> {
        std::fs::read(&self.path)
            .ok()
            .filter(|content| crc32fast::hash(content) == self.written().checksum)
            .ok_or_else(|| self.path.clone())
    }

    /// Adds an increment: one write a line, so that a killed process leaves whole lines.
    pub fn add(&mut self, record: &StepRecord) -> Result<(), Unwritten> {
        self.append(&line(STEP_COLUMNS, record))
    }

    /// Adds a cycle.
    pub fn add_cycle(&mut self, record: &CycleRecord) -> Result<(), Unwritten> {
        self.append(&line(CYCLE_COLUMNS, record))
    }

    /// Waits until the table is on the disk.
    pub fn settle(&self) -> Result<(), Unwritten> {
        self.file.sync_all().map_err(Unwritten::at(&self.path))
    }

    fn append(&mut self, text: &str) -> Result<(), Unwritten> {
        self.file.write_all(text.as_bytes()).map_err(Unwritten::at(&self.path))?;
        self.bytes += text.len() as u64;
        self.checksum.update(text.as_bytes());
        Ok(())
    }
}

/// A line of a table.
fn line<R>(columns: &[Column<R>], record: &R) -> String {
    let cell = |column: &Column<R>| match column.value {
        Value::Count(of) => of(record).to_string(),
        Value::Real(of) => exact(of(record)),
        Value::RealOrNone(of) => of(record).map_or_else(String::new, exact),
        Value::RealOrZero(of) => exact(of(record).unwrap_or(0.0)),
        Value::Truth(of) => of(record).to_string(),
        Value::Word(of) => of(record).to_owned(),
    };
    let cells: Vec<String> = columns.iter().map(cell).collect();
    cells.join(",") + "\n"
}

/// The cycle of a line below these names.
fn cycle(names: &[&str], line: &str) -> Option<CycleRecord> {
    let value = |cell: &str| match cell {
        "" => Json::Null,
        "true" => Json::Bool(true),
        "false" => Json::Bool(false),
        _ => match (cell.parse::<u64>(), cell.parse::<f64>()) {
            (Ok(count), _) => Json::from(count),
            (_, Ok(number)) => Json::from(number),
            _ => Json::from(cell),
        },
    };
    let cells: Vec<&str> = line.split(',').collect();
    let named = names.iter().zip(&cells).map(|(name, cell)| ((*name).to_owned(), value(cell)));
    (cells.len() == names.len()).then(|| serde_json::from_value(named.collect()).ok())?
}

/// What was written of a table below its head, when it still stands there: the head and whole lines.
fn whole_lines(path: &Path, written: Written, head: &str) -> Option<String> {
    let mut text = std::fs::read_to_string(path).ok()?;
    let bytes = usize::try_from(written.bytes).ok()?;
    let is_whole = text
        .get(..bytes)
        .is_some_and(|text| text.ends_with('\n') && crc32fast::hash(text.as_bytes()) == written.checksum);
    text.truncate(if is_whole { bytes } else { 0 });
    text.strip_prefix(head).map(str::to_owned)
}

/// The shortest digits that read back as the same number.
fn exact(value: f64) -> String {
    format!("{value:?}")
}

/// The cycles of a run that are over, as far as its `increments` go; a last line that a kill has torn is left away.
///
/// # Errors
/// When the table of a solved run is not as it was written, or a line is not that of a cycle.
pub fn cycles_of(
    folder: &Path,
    record: &Record,
    increments: usize,
) -> Result<Vec<CycleRecord>, ResultsError> {
    let path = folder.join(CYCLES);
    let bytes = std::fs::read(&path).unwrap_or_default();
    record.refuse_changed(folder, CYCLES, &bytes)?;
    let text = String::from_utf8_lossy(&bytes);
    let mut lines = text.rfind('\n').map_or("", |last| &text[..last]).lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').map(Units::name_of).collect();
    let foreign =
        || ResultsError::damaged(&path, "not the table of a run's cycles, or that of an earlier version");
    let cycles = lines.map(|line| cycle(&names, line).ok_or_else(foreign));
    let mut cycles = cycles.collect::<Result<Vec<_>, _>>()?;
    cycles.retain(|cycle| cycle.last_increment < increments);
    Ok(cycles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_reads_back_as_it_was() {
        use fret_core::history::CycleRegime;
        let one = CycleRecord {
            stage: 1,
            cycle: 12,
            first_increment: 30,
            last_increment: 41,
            stands_for: 50,
            last_cycle: 600,
            dissipated_energy: 0.1 + 0.2,
            total_dissipated_energy: 0.3,
            drive: Drive::Torsional,
            direction: -1.0 / 3.0,
            force_amplitude: 1e-300,
            displacement_amplitude: 4.0,
            opening: 0.0,
            energy_ratio: Some(2.0 / 3.0),
            sliding_ratio: None,
            stiffness: Some(1e17),
            regime: Some(CycleRegime::PartialSlip),
            closure: 5e-7,
            steady: true,
            worn_volume: 1.0,
            max_worn_depth: -0.0,
            actuator_amplitude: Some(5.0),
            actuator_energy_ratio: None,
            actuator_sliding_ratio: Some(0.1),
            actuator_stiffness: None,
            friction_coefficient: 0.3,
            friction_change: Some(1e-4),
            jump_error: None,
            lower_worn_depth: Some(2.5e-7),
            upper_worn_depth: None,
            compliance_spread: Some(0.125),
            wear_jump_error: None,
            debris_volume: None,
            debris_outflow: Some(0.25),
        };
        let other = CycleRecord { regime: None, steady: false, ..one.clone() };
        let names: Vec<&str> = CYCLE_COLUMNS.iter().map(|column| column.name).collect();
        for record in [one, other] {
            assert_eq!(cycle(&names, line(CYCLE_COLUMNS, &record).trim_end()), Some(record));
        }
        assert_eq!(cycle(&names, "1,2,3"), None);
        assert_eq!(cycle(&names[..3], "1,2,3"), None);
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        for value in [0.1 + 0.2, 1.0 / 3.0, 1e-300, -4.2e17, 12.0] {
            assert_eq!(exact(value).parse(), Ok(value));
        }
    }
}
