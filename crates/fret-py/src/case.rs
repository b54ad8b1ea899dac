//! The question as Python hands it over: text, read and judged by the core.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::case::{self, ArraySource, numbers};
use ndarray::Array2;
use numpy::PyReadonlyArray2;
use pyo3::prelude::{PyResult, pyclass, pymethods};

use crate::error::refused;

/// Larger files are no array of a grid: 2^26 cells of 16 letters each.
const MOST_BYTES: u64 = 1 << 30;

/// A case that has passed every check.
#[pyclass(frozen, module = "fretting._core")]
pub struct Case(pub case::Case);

#[pymethods]
impl Case {
    /// Case from TOML text; `name` stands in messages. Relative names of files start at `folder`.
    #[staticmethod]
    fn from_toml(text: &str, name: &str, folder: PathBuf) -> PyResult<Self> {
        let supply = |source: ArraySource<'_>| array(&folder, &[], source);
        case::Case::from_toml_with(text, name, &supply).map(Self).map_err(|error| refused(&error))
    }

    /// Case from JSON text of the same structure, with the arrays that it names by number; messages show it as TOML.
    #[staticmethod]
    fn from_json(
        text: &str,
        name: &str,
        folder: PathBuf,
        arrays: Vec<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let supply = |source: ArraySource<'_>| array(&folder, &arrays, source);
        case::Case::from_json_with(text, name, &supply).map(Self).map_err(|error| refused(&error))
    }
}

/// The array of a file, or one that was handed over. Only ordinary files are read, so that nothing waits on a pipe.
fn array(
    folder: &Path,
    arrays: &[PyReadonlyArray2<'_, f64>],
    source: ArraySource<'_>,
) -> Result<Array2<f64>, String> {
    let name = match source {
        ArraySource::File(name) => name,
        ArraySource::Handed(number) => {
            let array = arrays.get(number).ok_or_else(|| format!("no array {number} was handed over"))?;
            return Ok(array.as_array().to_owned());
        }
    };
    let path = folder.join(name);
    let facts = fs::metadata(&path).map_err(|error| format!("cannot be read: {error}"))?;
    if !facts.is_file() {
        return Err("no ordinary file".to_owned());
    }
    if facts.len() > MOST_BYTES {
        return Err(format!("{} bytes: at most {MOST_BYTES} are read", facts.len()));
    }
    let bytes = fs::read(&path).map_err(|error| format!("cannot be read: {error}"))?;
    numbers(&bytes).map_err(|error| error.to_string())
}
