//! `fields.zarr`, read back: the arrays that a run writes, and no others.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::history::{self, FIELDS};
use fret_core::model::{Dimension, SurfaceGrid};
use ndarray::Array2;
use serde_json::Value;

use crate::error::ResultsError;
use crate::run_record::Record;
use crate::zarr::{axis_metadata, bytes_of, checked, chunk, field_metadata, is_checked, is_zone};

/// Fields of the kept increments that the run has reached.
#[derive(Debug)]
pub struct Fields {
    path: PathBuf,
    /// Names of the arrays.
    pub names: Vec<&'static str>,
    /// Cell centres along x [length].
    pub x: Vec<f64>,
    /// Cell centres along y [length].
    pub y: Vec<f64>,
    /// Numbers of the increments, from 0, in order.
    pub steps: Vec<usize>,
    /// The same, also where no field was asked for.
    pub reached: Vec<usize>,
    grid: SurfaceGrid,
    /// Whether the chunks of fields end with a checksum.
    is_checked: bool,
}

impl Fields {
    /// Looks at the store of a run, whose record is known; fields beyond the `rows` of the history table are left away.
    ///
    /// # Errors
    /// When it is not what that run has written.
    pub fn read(path: &Path, record: &Record, rows: usize) -> Result<Self, ResultsError> {
        let (case, grid) = (&record.plan.case, record.plan.grid);
        // Where nothing wears the wear depth is not kept, also where it was asked for; nor debris where none
        // stays, nor the plastic depth where nothing yields.
        let is_filled = |name: &str| {
            let is_kept = match name {
                "worn_depth" => case.wear.is_some(),
                "plastic_depth" => case.hardness.is_some(),
                "debris" => case.wear.as_ref().is_some_and(|wear| wear.debris.is_some()),
                _ => true,
            };
            is_kept || path.join(name).join("c").exists() // of what it started from
        };
        let is_asked = |field: &&history::Field| {
            let moves = case.kinematics.is_finite();
            let is_own = field.asked_as == "worn_depth" && field.name != "worn_depth";
            let is_asked = case.output.fields.iter().any(|name| name == field.asked_as);
            is_asked && is_filled(field.asked_as) && (moves || !is_own)
        };
        let names: Vec<&'static str> = FIELDS.iter().filter(is_asked).map(|field| field.name).collect();
        let [nx, ny] = grid.cells();
        let store = Store { path, is_solved: record.is_solved() };
        let x = floats(&store.axis("x", Some(nx))?);
        // a line contact is the same all along y
        let y = match grid.dimension() {
            Dimension::Plane => floats(&store.axis("y", Some(ny))?),
            Dimension::Line => vec![0.0],
        };
        if x.iter().chain(&y).any(|centre| !centre.is_finite()) {
            return Err(ResultsError::damaged(path, "holds centres of cells that are no numbers"));
        }
        let numbers = store.axis("increment", None)?;
        let numbers: Vec<i64> =
            numbers.chunks_exact(8).map(|eight| i64::from_le_bytes(whole(eight))).collect();
        if numbers.first().is_some_and(|first| *first < 0)
            || numbers.iter().zip(numbers.iter().skip(1)).any(|(one, next)| one >= next)
            || store.is_solved && numbers.last().is_some_and(|last| *last >= rows as i64)
        {
            return Err(ResultsError::damaged(
                &path.join("increment"),
                "does not hold numbers of increments",
            ));
        }
        let mut is_checked = false;
        for name in &names {
            is_checked = store.field(&grid, name, numbers.len())?;
        }
        let reached: Vec<usize> =
            numbers.iter().map(|&number| number as usize).filter(|&number| number < rows).collect();
        let steps = if names.is_empty() { Vec::new() } else { reached.clone() };
        Ok(Self { path: path.to_owned(), grid, names, x, y, steps, reached, is_checked })
    }

    /// Cells along x and y.
    pub fn cells(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// The grid.
    pub fn grid(&self) -> &SurfaceGrid {
        &self.grid
    }

    /// Sides of a cell [length]; of a line contact, the width of a strip twice.
    pub fn spacing(&self) -> [f64; 2] {
        let of = |centres: &[f64]| if let [a, b, ..] = centres[..] { b - a } else { 1.0 };
        let dx = of(&self.x);
        self.grid.dimension().along(|axis| of([&self.x, &self.y][axis]), dx)
    }

    /// Whether an array is there.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains(&name)
    }

    /// A field `[i, j]` of the increment at `position` of [`Fields::steps`]; a zone is 0 open, 1 stick, 2 slip.
    ///
    /// # Errors
    /// When its file is missing, or not as it was written.
    pub fn field(&self, name: &str, position: usize) -> Result<Array2<f64>, ResultsError> {
        let file = self.path.join(chunk(&self.grid, name, position));
        let bytes = fs::read(&file)
            .map_err(|error| ResultsError::damaged(&file, &format!("cannot be read: {error}")))?;
        let bytes = checked(bytes, Some(bytes_of(&self.grid, name)), self.is_checked)
            .map_err(|what| ResultsError::damaged(&file, &what))?;
        let values: Vec<f64> =
            if is_zone(name) { bytes.into_iter().map(f64::from).collect() } else { floats(&bytes) };
        let none = |value: &f64| !value.is_finite() || is_zone(name) && *value > 2.0;
        if let Some(place) = values.iter().position(none) {
            return Err(ResultsError::damaged(&file, &format!("value {place} is none of a field")));
        }
        Array2::from_shape_vec(self.cells(), values)
            .map_err(|error| ResultsError::damaged(&file, &error.to_string()))
    }

    /// Reads every field.
    ///
    /// # Errors
    /// When the file of one is missing, or not as it was written.
    pub fn look_at_all(&self) -> Result<(), ResultsError> {
        let of = |name: &&str| (0..self.steps.len()).try_for_each(|place| self.field(name, place).map(drop));
        self.names.iter().try_for_each(of)
    }
}

/// A store while it is looked at.
struct Store<'a> {
    path: &'a Path,
    /// Whether its run is solved: otherwise its axis of increments may be growing.
    is_solved: bool,
}

impl Store<'_> {
    /// The numbers of an axis, of this length where it is known.
    fn axis(&self, name: &str, length: Option<usize>) -> Result<Vec<u8>, ResultsError> {
        let file = self.path.join(name).join("c/0");
        let bytes = fs::read(&file)
            .map_err(|error| ResultsError::damaged(&file, &format!("cannot be read: {error}")))?;
        if bytes.is_empty() && length.is_some() {
            return Err(ResultsError::damaged(&file, "holds no grid"));
        }
        let written = |length: usize| {
            move |is_checked: bool, words: &Value| axis_metadata(name, length, is_checked, words)
        };
        let metadata = self.metadata(name)?;
        let length = length.or_else(|| length_of(&metadata)).unwrap_or_default();
        let is_checked = is_checked(&metadata, written(length)).ok_or_else(|| self.foreign(name))?;
        let expected = if self.is_solved || name != "increment" { Some(8 * length) } else { None };
        checked(bytes, expected, is_checked).map_err(|what| ResultsError::damaged(&file, &what))
    }

    /// Whether the chunks of a field over so many increments have checksums.
    fn field(&self, grid: &SurfaceGrid, name: &str, steps: usize) -> Result<bool, ResultsError> {
        let metadata = self.metadata(name)?;
        let steps = if self.is_solved { steps } else { length_of(&metadata).unwrap_or_default() };
        is_checked(&metadata, |is_checked, words| field_metadata(grid, name, steps, is_checked, words))
            .ok_or_else(|| self.foreign(name))
    }

    /// The metadata of an array, which the group repeats.
    fn metadata(&self, name: &str) -> Result<Value, ResultsError> {
        let read = |file: &Path| -> Value {
            fs::read(file).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
        };
        let own = read(&self.path.join(name).join("zarr.json"));
        let group = read(&self.path.join("zarr.json"));
        if self.is_solved && own != group["consolidated_metadata"]["metadata"][name] {
            return Err(self.foreign(name));
        }
        Ok(own)
    }

    fn foreign(&self, name: &str) -> ResultsError {
        ResultsError::damaged(
            &self.path.join(name).join("zarr.json"),
            "not an array as a run writes it, or not what the group has of it",
        )
    }
}

/// The length along the first axis of an array, as its metadata tell.
fn length_of(metadata: &Value) -> Option<usize> {
    metadata["shape"][0].as_u64().map(|length| length as usize)
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(whole(eight))).collect()
}

/// Eight bytes, of a chunk that has eight.
fn whole(eight: &[u8]) -> [u8; 8] {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(eight);
    bytes
}
