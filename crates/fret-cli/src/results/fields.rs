//! `fields.zarr`, read back: the arrays that a run writes, and no others.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::history::FIELDS;
use serde_json::{Value, json};

use super::unusable;
use crate::failure::Failure;

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
    /// Places of these increments in the store.
    places: Vec<usize>,
}

/// One field, `values[i * ny + j]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Values, y fastest; a zone is 0 open, 1 stick, 2 slip.
    pub values: Vec<f64>,
}

impl Field {
    /// Value of a cell.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.cells[1] + j]
    }
}

impl Fields {
    /// Looks at a store; fields beyond the `rows` of the history table are left away.
    pub fn read(path: &Path, rows: usize) -> Result<Self, Failure> {
        let x = floats(&coordinate(path, "x")?);
        // a line contact is the same all along y
        let is_line = !path.join("y").exists();
        let y = if is_line { vec![0.0] } else { floats(&coordinate(path, "y")?) };
        let numbers = coordinate(path, "increment")?;
        let numbers = numbers.chunks_exact(8).map(|eight| i64::from_le_bytes(whole(eight)));
        let names: Vec<&'static str> = FIELDS
            .iter()
            .map(|field| field.name)
            .filter(|name| path.join(name).join("zarr.json").exists())
            .collect();
        if x.is_empty() || y.is_empty() {
            return Err(unusable(path, "holds no grid"));
        }
        let mut fields = Self { path: path.to_owned(), names, x, y, steps: Vec::new(), places: Vec::new() };
        for name in &fields.names {
            fields.check(name)?;
        }
        for (place, number) in numbers.enumerate() {
            let reached = usize::try_from(number).ok().filter(|&number| number < rows);
            if let Some(number) = reached.filter(|_| !fields.names.is_empty()) {
                fields.steps.push(number);
                fields.places.push(place);
            }
        }
        Ok(fields)
    }

    /// Cells along x and y.
    pub fn cells(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// Whether they are those of a line contact, the same all along y.
    pub fn is_line(&self) -> bool {
        self.y.len() == 1
    }

    /// Sides of a cell [length]; of a line contact, the width of a strip twice.
    pub fn spacing(&self) -> [f64; 2] {
        let of = |centres: &[f64]| if let [a, b, ..] = centres[..] { b - a } else { 1.0 };
        let dx = of(&self.x);
        [dx, if self.is_line() { dx } else { of(&self.y) }]
    }

    /// Whether an array is there.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains(&name)
    }

    /// A field of the increment at `position` of [`Fields::steps`].
    pub fn field(&self, name: &str, position: usize) -> Result<Field, Failure> {
        let cells = self.cells();
        let place = self.places[position];
        let end = if self.is_line() { "" } else { "/0" };
        let file = self.path.join(name).join(format!("c/{place}/0{end}"));
        let bytes_each = if name == "zone" { 1 } else { 8 };
        let expected = cells[0] * cells[1] * bytes_each;
        let bytes = fs::read(&file).map_err(|error| unusable(&file, &format!("cannot be read: {error}")))?;
        if bytes.len() != expected {
            let what = format!("{} bytes where the grid asks for {expected}", bytes.len());
            return Err(unusable(&file, &what));
        }
        let values = if name == "zone" { bytes.into_iter().map(f64::from).collect() } else { floats(&bytes) };
        Ok(Field { cells, values })
    }

    /// Refuses an array that is not what a run writes.
    fn check(&self, name: &str) -> Result<(), Failure> {
        let file = self.path.join(name).join("zarr.json");
        let metadata: Value =
            fs::read(&file).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
        let [nx, ny] = self.cells();
        let data_type = if name == "zone" { "uint8" } else { "float64" };
        let shape = metadata["shape"].as_array().map_or(&[][..], Vec::as_slice);
        let codecs = metadata["codecs"].as_array().map_or(&[][..], Vec::as_slice);
        let little = |codec: &Value| codec["configuration"]["endian"] == "little";
        let in_order = match (shape, codecs) {
            ([_, along_x], [bytes]) => self.is_line() && *along_x == nx && little(bytes),
            ([_, along_y, along_x], [order, bytes]) => {
                *along_y == ny
                    && *along_x == nx
                    && order["configuration"]["order"] == json!([0, 2, 1])
                    && little(bytes)
            }
            _ => false,
        };
        let is_ours = in_order && metadata["data_type"] == data_type;
        if is_ours { Ok(()) } else { Err(unusable(&file, "not an array as a run writes it")) }
    }
}

fn coordinate(path: &Path, name: &str) -> Result<Vec<u8>, Failure> {
    let file = path.join(name).join("c/0");
    fs::read(&file).map_err(|error| unusable(&file, &format!("cannot be read: {error}")))
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
