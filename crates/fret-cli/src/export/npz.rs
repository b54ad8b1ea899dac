//! `--npz`: one file for `numpy.load`: `x`, `y`, `kept_increment`, every kept field with shape `(kept_increment, x, y)`, every column
//! of the history; `units`, a text in JSON, where the case declares units.
//!
//! Formats: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, in a zip archive without compression.

use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::iter;
use std::path::{Path, PathBuf};

use fret_core::history::{STEP_COLUMNS, Value};
use fret_core::model::Dimension;
use fret_core::units::Units;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::written;
use crate::failure::{Failure, Unwritten};
use fret_results::{Results, kind_of_field};

/// Archives of more bytes need the wider form of the format.
const WIDE: usize = 1 << 31;

/// Whether a column of the history holds whole numbers.
fn counts(name: &str) -> bool {
    STEP_COLUMNS.iter().any(|column| column.name == name && matches!(column.value, Value::Count(_)))
}

/// The unit of every array that has one, as JSON in a single text.
fn units_in_json(results: &Results, units: &Units) -> String {
    let dimension = results.grid().dimension();
    let fields = ["x", "y"].iter().chain(&results.fields.names).map(|name| (*name, kind_of_field(name)));
    let columns = STEP_COLUMNS.iter().map(|column| (column.name, column.unit));
    let named = fields.chain(columns).filter_map(|(name, kind)| {
        let heading = Units::heading(Some(units), name, kind, dimension);
        let unit = heading.strip_prefix(name)?.strip_prefix(" [")?.strip_suffix(']')?;
        Some((name.to_owned(), serde_json::Value::from(unit)))
    });
    serde_json::Value::Object(named.collect()).to_string()
}

/// Writes the results as a `.npz` file.
pub fn write(results: &Results, path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let fields = &results.fields;
    let [nx, ny] = fields.cells();
    archived(path, |archive| {
        let steps: Vec<u8> = fields.steps.iter().flat_map(|&step| (step as i64).to_le_bytes()).collect();
        archive.array("x", "<f8", &[nx], &bytes(&fields.x))?;
        let dimension = fields.grid().dimension();
        if dimension == Dimension::Plane {
            archive.array("y", "<f8", &[ny], &bytes(&fields.y))?;
        }
        archive.array("kept_increment", "<i8", &[fields.steps.len()], &steps)?;
        for name in &fields.names {
            let (kind, width) = if *name == "zone" { ("|u1", 1) } else { ("<f8", 8) };
            let shape = &[fields.steps.len(), nx, ny][..=dimension.axes().len()];
            archive.begin(name, kind, shape, width * shape.iter().product::<usize>())?;
            for position in 0..fields.steps.len() {
                let values = fields.field(name, position)?;
                let zones = || values.iter().map(|&value| value as u8).collect();
                archive.append(&if width == 1 { zones() } else { bytes(&values) })?;
            }
        }
        for (name, values) in results.table.columns() {
            if counts(name) {
                let counts: Vec<u8> = values.iter().flat_map(|&count| (count as i64).to_le_bytes()).collect();
                archive.array(name, "<i8", &[values.len()], &counts)?;
            } else {
                archive.array(name, "<f8", &[values.len()], &bytes(values))?;
            }
        }
        if let Some(units) = results.units() {
            archive.words("units", &[], &[units_in_json(results, units)])?;
        }
        let regimes = results.table.regimes();
        archive.words("regime", &[regimes.len()], regimes)
    })?;
    Ok(vec![path.to_owned()])
}

/// Writes arrays of numbers, each with its name and shape, as a `.npz` file.
pub fn arrays(path: &Path, arrays: &[(&str, &[usize], Vec<f64>)]) -> Result<(), Failure> {
    archived(path, |archive| {
        let mut arrays = arrays.iter();
        arrays.try_for_each(|(name, shape, values)| archive.array(name, "<f8", shape, &bytes(values)))
    })
}

/// Writes an archive in one go.
fn archived(
    path: &Path,
    fill: impl FnOnce(&mut Archive<'_, UntilFailed<&mut BufWriter<File>>>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    written(path, |writer| {
        let mut archive = Archive { zip: ZipWriter::new(UntilFailed::new(writer)), path };
        fill(&mut archive)?;
        archive.zip.finish().map_err(|error| unwritten(path, error))?;
        Ok(())
    })
}

/// Passes on what is written until that fails once; then only counts it: an archive that is given up still tries to write its end, and
/// would complain of it on standard error.
struct UntilFailed<W> {
    writer: W,
    failed: bool,
    /// Where the next byte goes, or would go.
    place: u64,
}

impl<W> UntilFailed<W> {
    fn new(writer: W) -> Self {
        Self { writer, failed: false, place: 0 }
    }

    fn attempt<T>(&mut self, instead: T, act: impl FnOnce(&mut W) -> io::Result<T>) -> io::Result<T> {
        if self.failed {
            return Ok(instead);
        }
        let outcome = act(&mut self.writer);
        self.failed = outcome.is_err();
        outcome
    }
}

impl<W: Write> Write for UntilFailed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.attempt(bytes.len(), |writer| writer.write(bytes))?;
        self.place += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.attempt((), Write::flush)
    }
}

impl<W: Seek> Seek for UntilFailed<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let instead = match to {
            SeekFrom::Start(place) => place,
            SeekFrom::Current(further) | SeekFrom::End(further) => self.place.saturating_add_signed(further),
        };
        self.place = self.attempt(instead, |writer| writer.seek(to))?;
        Ok(self.place)
    }
}

/// An archive while it is filled.
struct Archive<'a, W: Write + Seek> {
    zip: ZipWriter<W>,
    path: &'a Path,
}

impl<W: Write + Seek> Archive<'_, W> {
    fn array(&mut self, name: &str, kind: &str, shape: &[usize], content: &[u8]) -> Result<(), Failure> {
        self.begin(name, kind, shape, content.len())?;
        self.append(content)
    }

    /// Words, all of them as wide as the longest one.
    fn words(&mut self, name: &str, shape: &[usize], words: &[String]) -> Result<(), Failure> {
        let letters = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
        let padded = |word: &String| word.chars().chain(iter::repeat('\0')).take(letters).collect::<Vec<_>>();
        let all = words.iter().flat_map(padded);
        let content: Vec<u8> = all.flat_map(|letter| u32::from(letter).to_le_bytes()).collect();
        self.array(name, &format!("<U{letters}"), shape, &content)
    }

    fn begin(&mut self, name: &str, kind: &str, shape: &[usize], bytes: usize) -> Result<(), Failure> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(bytes >= WIDE);
        self.zip.start_file(format!("{name}.npy"), options).map_err(|error| unwritten(self.path, error))?;
        self.append(&header(kind, shape))
    }

    fn append(&mut self, content: &[u8]) -> Result<(), Failure> {
        self.zip.write_all(content).map_err(|error| Unwritten::at(self.path)(error).into())
    }
}

fn unwritten(path: &Path, error: zip::result::ZipError) -> Failure {
    let cause = match error {
        zip::result::ZipError::Io(cause) => cause,
        other => io::Error::other(other),
    };
    Unwritten::at(path)(cause).into()
}

/// The head of an array in C order, version 1.0, padded to a multiple of 64 bytes.
fn header(kind: &str, shape: &[usize]) -> Vec<u8> {
    let sides: String = shape.iter().map(|side| format!("{side}, ")).collect();
    let words = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", sides.trim_end());
    let before = 6 + 2 + 2;
    let padded = (before + words.len() + 1).next_multiple_of(64) - before;
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend_from_slice(&u16::try_from(padded).unwrap_or(u16::MAX).to_le_bytes());
    head.extend_from_slice(format!("{words:<width$}\n", width = padded - 1).as_bytes());
    head
}

fn bytes<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    values.into_iter().flat_map(|value| value.to_le_bytes()).collect()
}
