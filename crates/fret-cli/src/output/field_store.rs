//! `fields.zarr`: kept fields as a Zarr v3 folder (dims increment, y, x), one chunk file per increment and field, raw little-endian numbers
//! with y fastest, as in memory.
//!
//! Shape and numbers of increments stand from the start, or grow with a history that may end early; an increment that is not reached reads as NaN
//! (zone: 255). The group repeats the metadata of its arrays, as zarr-python consolidates them: `xr.open_zarr(path)` opens it, and
//! draws x to the right. Format: <https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html>.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use fret_core::case::Units;
use fret_core::history::{FIELDS, Field, FieldValues, KeptFields, ZONE_WORDS};
use fret_core::model::{SurfaceGrid, Zone};
use fret_core::plan::Plan;
use ndarray::Array2;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};
use serde_json::{Value, json};

use super::place::folder_below;
use super::whole_file::{write_whole, write_whole_sparsely};
use crate::failure::Unwritten;

/// The store while it is filled.
#[derive(Debug)]
pub struct FieldStore {
    path: PathBuf,
    title: String,
    /// Units that the case declares.
    units: Option<Units>,
    grid: SurfaceGrid,
    arrays: Vec<&'static Field>,
    /// Numbers of the increments along `increment`.
    steps: Vec<usize>,
    /// How many of them are there.
    kept: usize,
    /// Whether the axis grows as the history goes, since that may end early.
    grows: bool,
}

/// The one chunk of the axis `increment`.
const STEPS: &str = "increment/c/0";

impl FieldStore {
    /// A store of the plan's final shape, without any field yet.
    pub fn create(path: &Path, plan: &Plan) -> Result<Self, Unwritten> {
        let store = Self::of(path, plan, Vec::new());
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            let centres = plan.grid.centres(axis);
            let bytes: Vec<u8> = centres.iter().flat_map(|centre| centre.to_le_bytes()).collect();
            store.write(&format!("{name}/c/0"), &bytes)?;
        }
        store.write_metadata()?;
        Ok(store)
    }

    /// The store of a broken-off run, cut back to its first `kept` increments.
    pub fn reopen(path: &Path, plan: &Plan, kept: usize) -> Result<Self, Unwritten> {
        let mut store = Self::of(path, plan, steps_at(path));
        for step in kept..store.steps.len() {
            for array in &store.arrays {
                let chunk = path.join(array.name).join("c").join(step.to_string());
                match fs::remove_dir_all(&chunk) {
                    Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                        return Err(Unwritten::at(&chunk)(error));
                    }
                    _ => {}
                }
            }
        }
        store.kept = kept;
        if store.grows {
            store.steps.truncate(kept);
            store.write_metadata()?;
        }
        Ok(store)
    }

    /// The first file that should be in the store at `path` after `kept` increments and is not, or not of its size.
    pub fn missing(path: &Path, plan: &Plan, kept: usize) -> Option<PathBuf> {
        let store = Self::of(path, plan, steps_at(path));
        let cells = store.grid.len();
        if store.steps.len() < kept {
            return Some(path.join(STEPS));
        }
        let chunks = store.arrays.iter().flat_map(|array| {
            let bytes = if array.name == "zone" { cells } else { 8 * cells };
            (0..kept).map(move |step| (chunk(&plan.grid, array.name, step), Some(bytes as u64)))
        });
        let metadata = store.arrays.iter().map(|array| (format!("{}/zarr.json", array.name), None));
        metadata.chain(chunks).map(|(key, bytes)| (path.join(key), bytes)).find_map(|(file, bytes)| {
            let is_there = fs::metadata(&file)
                .is_ok_and(|found| found.is_file() && bytes.is_none_or(|bytes| found.len() == bytes));
            (!is_there).then_some(file)
        })
    }

    /// Steps whose fields have been kept.
    pub fn kept(&self) -> usize {
        self.kept
    }

    /// A store without fields; `grown`: its increments so far, should they not be known beforehand.
    fn of(path: &Path, plan: &Plan, grown: Vec<usize>) -> Self {
        let asked = |array: &&Field| plan.case.output.fields.iter().any(|name| name == array.asked_as);
        let grows = plan.case.is_open_ended();
        Self {
            path: path.to_owned(),
            title: plan.case.title.clone(),
            units: plan.case.units.clone(),
            grid: plan.grid,
            arrays: FIELDS.iter().filter(asked).collect(),
            steps: if grows { grown } else { plan.case.kept_increments() },
            kept: 0,
            grows,
        }
    }

    /// Writes the fields of one increment, side by side: each waits for the disk.
    pub fn keep(&mut self, kept: &KeptFields) -> Result<(), Unwritten> {
        let step = self.position(kept.increment)?;
        self.arrays.par_iter().try_for_each(|array| {
            let bytes = (array.values)(kept).map(|values| match values {
                FieldValues::Reals(values) => numbers(values),
                FieldValues::Zones(values) => zones(values),
            });
            bytes.map_or(Ok(()), |bytes| {
                // Frictionless contacts have fields of zeros.
                write_whole_sparsely(&self.file(&chunk(&self.grid, array.name, step))?, &bytes)
            })
        })?;
        self.kept = step + 1;
        Ok(())
    }

    /// Place of an increment along `increment`. One that was not foreseen is added.
    fn position(&mut self, increment: usize) -> Result<usize, Unwritten> {
        if let Ok(position) = self.steps.binary_search(&increment) {
            return Ok(position);
        }
        self.steps.push(increment);
        self.write_metadata()?;
        Ok(self.steps.len() - 1)
    }

    /// The numbers of the increments, the metadata of every array, and all of these again in the group's.
    fn write_metadata(&self) -> Result<(), Unwritten> {
        let numbers: Vec<u8> = self.steps.iter().flat_map(|&step| (step as i64).to_le_bytes()).collect();
        self.write(STEPS, &numbers)?;
        let [nx, ny] = self.grid.cells();
        let centre = |length: usize| ("float64", "length", "cell centre", length);
        let number = ("int64", "", "number of the increment, from 0", self.steps.len());
        let axes = [("x", centre(nx)), ("y", centre(ny)), ("increment", number)];
        let is_line = self.grid.is_line();
        let axes = axes.into_iter().filter(|(name, _)| !(is_line && *name == "y"));
        let axes = axes.map(|(name, (kind, unit, long_name, length))| {
            (name, axis_metadata(name, (kind, &self.unit(unit), long_name, length)))
        });
        let arrays = self.arrays.iter().map(|array| (array.name, self.field_metadata(array)));
        let mut all = serde_json::Map::new();
        for (name, metadata) in axes.chain(arrays) {
            self.write_text(&format!("{name}/zarr.json"), &metadata)?;
            all.insert(name.to_owned(), metadata);
        }
        let group = json!({
            "zarr_format": 3,
            "node_type": "group",
            "attributes": { "title": self.title, "made_by": concat!("fretting ", env!("CARGO_PKG_VERSION")) },
            "consolidated_metadata": { "kind": "inline", "must_understand": false, "metadata": all },
        });
        self.write_text("zarr.json", &group)
    }

    /// The unit of a kind of quantity: what the case declares, or that there is none declared.
    fn unit(&self, kind: &str) -> String {
        match &self.units {
            _ if kind.is_empty() => "1".to_owned(),
            Some(units) => units.of(kind),
            None => format!("case units: {kind}"),
        }
    }

    fn field_metadata(&self, array: &Field) -> Value {
        let [nx, ny] = self.grid.cells();
        let zone = array.name == "zone";
        let mut attributes = json!({ "units": self.unit(array.unit), "long_name": array.meaning });
        if zone {
            attributes["flag_values"] = json!([0, 1, 2]);
            attributes["flag_meanings"] = json!(ZONE_WORDS.join(" "));
        }
        // Seen with y before x, stored with x before y; of a line contact there is no y.
        let transposed = json!({ "name": "transpose", "configuration": { "order": [0, 2, 1] } });
        let steps = self.steps.len();
        let (shape, chunk, codecs, names) = if self.grid.is_line() {
            (json!([steps, nx]), json!([1, nx]), json!([little_endian_bytes()]), json!(["increment", "x"]))
        } else {
            let codecs = json!([transposed, little_endian_bytes()]);
            (json!([steps, ny, nx]), json!([1, ny, nx]), codecs, json!(["increment", "y", "x"]))
        };
        json!({
            "zarr_format": 3,
            "node_type": "array",
            "shape": shape,
            "data_type": if zone { "uint8" } else { "float64" },
            "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk } },
            "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
            "fill_value": if zone { json!(255) } else { json!("NaN") },
            "codecs": codecs,
            "attributes": attributes,
            "dimension_names": names,
        })
    }

    fn write_text(&self, key: &str, value: &Value) -> Result<(), Unwritten> {
        self.write(key, format!("{value:#}\n").as_bytes())
    }

    fn write(&self, key: &str, content: &[u8]) -> Result<(), Unwritten> {
        write_whole(&self.file(key)?, content)
    }

    /// Path of a file of the store, in a folder that is there.
    fn file(&self, key: &str) -> Result<PathBuf, Unwritten> {
        let path = self.path.join(key);
        if let Some(folder) = Path::new(key).parent() {
            folder_below(&self.path, folder)?;
        }
        Ok(path)
    }
}

/// Where a field of the increment at a place along `increment` lies in the store.
pub fn chunk(grid: &SurfaceGrid, name: &str, place: usize) -> String {
    format!("{name}/c/{place}/0{}", if grid.is_line() { "" } else { "/0" })
}

/// Numbers of the increments in the store at `path`, as far as they can be read.
fn steps_at(path: &Path) -> Vec<usize> {
    let bytes = fs::read(path.join(STEPS)).unwrap_or_default();
    let numbers = bytes.as_chunks::<8>().0.iter().map(|eight| i64::from_le_bytes(*eight));
    numbers.map_while(|number| usize::try_from(number).ok()).collect()
}

/// An axis in one chunk: its type, unit, meaning and length.
fn axis_metadata(name: &str, (data_type, unit, long_name, length): (&str, &str, &str, usize)) -> Value {
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": [length],
        "data_type": data_type,
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": [length.max(1)] } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": 0,
        "codecs": [little_endian_bytes()],
        "attributes": { "units": unit, "long_name": long_name },
        "dimension_names": [name],
    })
}

fn little_endian_bytes() -> Value {
    json!({ "name": "bytes", "configuration": { "endian": "little" } })
}

/// A field in the order of its index `[i, j]`, j fastest, as Zarr wants it.
/// Nothing is copied where memory has that order already.
fn numbers(field: &Array2<f64>) -> Cow<'_, [u8]> {
    match field.as_slice() {
        Some(values) if cfg!(target_endian = "little") => Cow::Borrowed(bytemuck::cast_slice(values)),
        _ => field.iter().flat_map(|value| value.to_le_bytes()).collect(),
    }
}

fn zones(field: &Array2<Zone>) -> Cow<'_, [u8]> {
    field.iter().map(|&zone| zone as u8).collect()
}
