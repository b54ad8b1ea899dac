//! `fields.zarr`: kept fields as a Zarr v3 folder (dims increment, y, x), one chunk file per increment and field, raw little-endian numbers
//! with y fastest, as in memory.
//!
//! Shape and numbers of increments stand from the start, or grow with a history that may end early; an increment that is not reached reads as NaN
//! (zone: 255). The group repeats the metadata of its arrays, as zarr-python consolidates them: `xr.open_zarr(path)` opens it, and
//! draws x to the right. Format: <https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html>.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use fret_core::history::{FIELDS, Field, FieldValues, KeptFields, ZONE_WORDS};
use fret_core::model::{ContactState, SurfaceGrid, Zone};
use fret_core::plan::Plan;
use fret_core::units::Units;
use ndarray::Array2;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};
use serde_json::{Value, json};

use crate::error::Unwritten;
use crate::place::folder_below;
use crate::whole_file::{write_whole, write_whole_sparsely};
use crate::zarr::{axis_metadata, bytes_of, checked, checksum, chunk, field_metadata, is_zone};

/// The store while it is filled.
#[derive(Debug)]
pub struct FieldStore {
    path: PathBuf,
    title: String,
    /// Units that the case declares.
    units: Option<Units>,
    grid: SurfaceGrid,
    arrays: Vec<&'static Field>,
    /// Whether anything wears: the wear depth is kept then alone, also where it was asked for.
    wears: bool,
    /// The same of debris.
    has_debris: bool,
    /// The same of the plastic depth.
    yields: bool,
    /// Whether chunks end with a checksum.
    is_checked: bool,
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
        store.write_centres()?;
        store.write_metadata()?;
        Ok(store)
    }

    /// The store of a broken-off run, cut back to its first `kept` increments. What follows from the plan is written anew.
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
        }
        store.write_centres()?;
        store.write_metadata()?;
        Ok(store)
    }

    /// The first file of the store at `path` that is not as it was written after `kept` increments, and what is wrong with it. What follows
    /// from the plan is not looked at: it is written anew.
    pub fn damaged(path: &Path, plan: &Plan, kept: usize) -> Option<(PathBuf, String)> {
        let store = Self::of(path, plan, steps_at(path));
        let is_rising = store.steps.iter().zip(store.steps.iter().skip(1)).all(|(one, next)| one < next);
        let is_sound = !store.grows
            || kept == 0
            || fs::read(path.join(STEPS)).is_ok_and(|steps| checked(steps, None, store.is_checked).is_ok());
        if store.steps.len() < kept || !is_rising || !is_sound {
            return Some((path.join(STEPS), "missing, or not whole".to_owned()));
        }
        let chunks = store.filled().flat_map(|array| {
            (0..kept).map(move |step| (chunk(&plan.grid, array.name, step), bytes_of(&plan.grid, array.name)))
        });
        let chunks: Vec<(PathBuf, usize)> = chunks.map(|(key, bytes)| (path.join(key), bytes)).collect();
        let why = |(file, bytes): &(PathBuf, usize)| match fs::read(file) {
            Err(_) => Some((file.clone(), "missing, or not whole".to_owned())),
            Ok(content) => {
                checked(content, Some(*bytes), store.is_checked).err().map(|why| (file.clone(), why))
            }
        };
        chunks.par_iter().map(why).find_first(Option::is_some).flatten()
    }

    /// Numbers of the first `kept` increments in the store at `path`.
    pub fn steps(path: &Path, plan: &Plan, kept: usize) -> Vec<usize> {
        Self::of(path, plan, steps_at(path)).steps.into_iter().take(kept).collect()
    }

    /// The first file of what this has written that is not there any more.
    pub fn lost(&self) -> Option<PathBuf> {
        let metadata = self.arrays.iter().map(|array| format!("{}/zarr.json", array.name));
        let chunks = self
            .filled()
            .flat_map(|array| (0..self.kept).map(move |step| chunk(&self.grid, array.name, step)));
        let files = ["zarr.json".to_owned(), STEPS.to_owned()].into_iter().chain(metadata).chain(chunks);
        files.map(|key| self.path.join(key)).find(|file| !file.is_file())
    }

    /// The arrays that hold fields.
    fn filled(&self) -> impl Iterator<Item = &'static Field> + '_ {
        let is_filled = |array: &&Field| match array.asked_as {
            "worn_depth" => self.wears,
            "debris" => self.has_debris,
            "plastic_depth" => self.yields,
            _ => true,
        };
        self.arrays.iter().copied().filter(is_filled)
    }

    /// Steps whose fields have been kept.
    pub fn kept(&self) -> usize {
        self.kept
    }

    /// A store without fields; `grown`: its increments so far, should they not be known beforehand.
    fn of(path: &Path, plan: &Plan, grown: Vec<usize>) -> Self {
        let asked = |array: &&Field| plan.case.output.fields.iter().any(|name| name == array.asked_as);
        let grows = plan.case.is_open_ended();
        let moves = plan.case.kinematics.is_finite();
        let is_there =
            |array: &&Field| moves || array.asked_as == array.name || array.asked_as != "worn_depth";
        let arrays: Vec<_> = FIELDS.iter().filter(asked).filter(is_there).collect();
        // A store that an earlier version has begun goes on without checksums: its first chunk tells.
        let first = arrays.first().map(|array| (path.join(chunk(&plan.grid, array.name, 0)), array.name));
        let is_plain = first.is_some_and(|(file, name)| {
            fs::metadata(file).is_ok_and(|facts| facts.len() == bytes_of(&plan.grid, name) as u64)
        });
        let starts_with = |has: fn(&ContactState) -> bool| {
            plan.start.as_ref().is_some_and(|start| has(&start.solved.state))
        };
        Self {
            path: path.to_owned(),
            title: plan.case.title.clone(),
            units: plan.case.units.clone(),
            grid: plan.grid,
            arrays,
            wears: plan.case.wear.is_some() || starts_with(|state| state.worn_depth.is_some()),
            has_debris: plan.case.wear.as_ref().is_some_and(|wear| wear.debris.is_some())
                || starts_with(|state| state.debris.is_some()),
            yields: plan.case.hardness.is_some() || starts_with(|state| state.plastic_depth.is_some()),
            is_checked: !is_plain,
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
                let place = self.file(&chunk(&self.grid, array.name, step))?;
                write_whole_sparsely(&place, &bytes, &checksum(&bytes, self.is_checked))
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
        self.write_axis("increment", &numbers)?;
        let [nx, ny] = self.grid.cells();
        let centre = |length: usize| ("length", "cell centre", length);
        let number = ("", "number of the increment, from 0", self.steps.len());
        let axes = [("x", centre(nx)), ("y", centre(ny)), ("increment", number)];
        let of_place = self.grid.dimension().names();
        let axes = axes.into_iter().filter(|(name, _)| *name == "increment" || of_place.contains(name));
        let axes = axes.map(|(name, (unit, long_name, length))| {
            let attributes = json!({ "units": self.unit(unit), "long_name": long_name });
            (name, axis_metadata(name, length, self.is_checked, &attributes))
        });
        let arrays = self.arrays.iter().map(|array| {
            let attributes = self.field_attributes(array);
            let metadata =
                field_metadata(&self.grid, array.name, self.steps.len(), self.is_checked, &attributes);
            (array.name, metadata)
        });
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

    fn field_attributes(&self, array: &Field) -> Value {
        let mut attributes = json!({ "units": self.unit(array.unit), "long_name": array.meaning });
        if is_zone(array.name) {
            attributes["flag_values"] = json!([0, 1, 2]);
            attributes["flag_meanings"] = json!(ZONE_WORDS.join(" "));
        }
        attributes
    }

    fn write_centres(&self) -> Result<(), Unwritten> {
        self.grid.dimension().names().iter().enumerate().try_for_each(|(axis, name)| {
            let centres = self.grid.centres(axis);
            let bytes: Vec<u8> = centres.iter().flat_map(|centre| centre.to_le_bytes()).collect();
            self.write_axis(name, &bytes)
        })
    }

    fn write_axis(&self, name: &str, bytes: &[u8]) -> Result<(), Unwritten> {
        self.write(&format!("{name}/c/0"), &[bytes, &checksum(bytes, self.is_checked)].concat())
    }

    fn write_text(&self, key: &str, value: &Value) -> Result<(), Unwritten> {
        self.write(key, format!("{value:#}\n").as_bytes())
    }

    fn write(&self, key: &str, content: &[u8]) -> Result<(), Unwritten> {
        write_whole(&self.file(key)?, content)
    }

    /// Path of a file of the store, in a folder that is there.
    fn file(&self, key: &str) -> Result<PathBuf, Unwritten> {
        let (folder, name) = key.rsplit_once('/').unwrap_or(("", key));
        let results = self.path.parent().unwrap_or_else(|| Path::new(""));
        let store = self.path.file_name().map_or_else(|| Path::new(""), Path::new);
        Ok(folder_below(results, &store.join(folder))?.join(name))
    }
}

/// Numbers of the increments in the store at `path`, as far as they can be read.
fn steps_at(path: &Path) -> Vec<usize> {
    let bytes = fs::read(path.join(STEPS)).unwrap_or_default();
    let numbers = bytes.as_chunks::<8>().0.iter().map(|eight| i64::from_le_bytes(*eight));
    numbers.map_while(|number| usize::try_from(number).ok()).collect()
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
