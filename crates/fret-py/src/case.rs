//! The question as Python hands it over: text, read and judged by the core.

use std::path::PathBuf;
use std::sync::Arc;

use fret_core::case::{self, Attachments, CaseError};
use fret_core::history;
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run;
use fret_results::{Beside, CaseFile};
use ndarray::Array2;
use numpy::{PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::IntoPyObject;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyResult, Python, pyclass, pymethods};

use serde_json::Value;

use crate::error::{bad_value, refused};
use crate::instruments;
use crate::start::Start;

/// A case that has passed every check.
#[pyclass(frozen, module = "fretting._core")]
pub struct Case(pub case::Case, Source);

/// What a case was read from: TOML, or JSON with the arrays it names by number.
struct Source {
    text: String,
    name: String,
    folder: PathBuf,
    arrays: Option<Vec<Array2<f64>>>,
    start: Option<Py<Start>>,
}

impl Source {
    fn case(&self) -> PyResult<case::Case> {
        let file = |file: &str| case::content(&self.folder.join(file));
        let arrays = self.arrays.as_deref().unwrap_or_default();
        let start = self.start.as_ref().map(|start| start.get().0.solved.loads);
        let scan = |name: &str, channel: Option<&str>| instruments::read(&self.folder.join(name), channel);
        let attachments = Attachments { file: &file, scan: Some(&scan), arrays, start };
        let read = if self.arrays.is_some() {
            case::Case::from_json_with(&self.text, &self.name, attachments)
        } else {
            case::Case::from_toml_with(&self.text, &self.name, attachments)
        };
        read.map_err(|error| refused(&error))
    }
}

impl Case {
    /// The case as text, with the arrays it names by number put into files.
    pub fn text(&self) -> PyResult<CaseFile> {
        let Source { text, name, folder, arrays, .. } = &self.1;
        let beside = |contents| Beside { folder: folder.clone(), contents };
        let Some(arrays) = arrays else {
            let path = PathBuf::from(name);
            let beside = if path.is_file() { None } else { Some(beside(Vec::new())) };
            return Ok(CaseFile { path, text: text.clone(), beside });
        };
        let mut value: Value = serde_json::from_str(text).map_err(bad_value)?;
        let mut contents = Vec::new();
        in_files(&mut value, arrays, &mut contents);
        let text = case::toml_of(&value).map_err(PyValueError::new_err)?;
        Ok(CaseFile::of_text(name, text, beside(contents)))
    }

    /// The state its history starts from.
    pub fn start(&self) -> Option<Arc<history::Start>> {
        self.1.start.as_ref().map(|start| start.get().0.clone())
    }

    /// The case planned, to start from the state that it was read with.
    pub fn planned(&self) -> Result<Plan, CaseError> {
        let start = self.1.start.as_ref().map(|start| start.get().0.clone());
        Plan::starting_from(start, self.0.clone(), LeaveOut::ALL)
    }
}

/// Puts the names of files in the place of `{ "array": n }`, and their contents beside; heights have a key of their own for a file.
fn in_files(value: &mut Value, arrays: &[Array2<f64>], contents: &mut Vec<(String, Vec<u8>)>) {
    match value {
        Value::Object(table) => {
            if let Some(number) = table.get("values").and_then(handed) {
                table.remove("values");
                table.insert("file".to_owned(), Value::String(in_file(number, arrays, contents)));
            }
            for entry in table.values_mut() {
                match handed(entry) {
                    Some(number) => *entry = Value::String(in_file(number, arrays, contents)),
                    None => in_files(entry, arrays, contents),
                }
            }
        }
        Value::Array(entries) => entries.iter_mut().for_each(|entry| in_files(entry, arrays, contents)),
        _ => {}
    }
}

/// The number of an array, where a value names one.
fn handed(value: &Value) -> Option<usize> {
    let table = value.as_object().filter(|table| table.len() == 1)?;
    Some(table.get("array")?.as_u64()? as usize)
}

/// The name of the file of an array, whose content goes beside; a number without an array keeps a name without a file.
fn in_file(number: usize, arrays: &[Array2<f64>], contents: &mut Vec<(String, Vec<u8>)>) -> String {
    let name = format!("array-{number}.npy");
    if let Some(array) = arrays.get(number)
        && contents.iter().all(|(known, _)| *known != name)
    {
        contents.push((name.clone(), npy(array)));
    }
    name
}

/// An array as a file of NumPy's format 1.0.
fn npy(array: &Array2<f64>) -> Vec<u8> {
    let (rows, columns) = array.dim();
    let mut head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let padding = 63 - (10 + head.len()) % 64;
    head.push_str(&" ".repeat(padding));
    head.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((head.len() as u16).to_le_bytes());
    bytes.extend(head.as_bytes());
    bytes.extend(array.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[pymethods]
impl Case {
    /// Case from TOML text; `name` stands in messages. Relative names of files start at `folder`, its history at `start` (bodies
    /// apart without one).
    #[staticmethod]
    #[pyo3(signature = (text, name, folder, start=None))]
    fn from_toml(text: &str, name: &str, folder: PathBuf, start: Option<Py<Start>>) -> PyResult<Self> {
        let source = Source { text: text.to_owned(), name: name.to_owned(), folder, arrays: None, start };
        Ok(Self(source.case()?, source))
    }

    /// Case from JSON text of the same structure, with the arrays that it names by number; messages show it as TOML.
    #[staticmethod]
    #[pyo3(signature = (text, name, folder, arrays, start=None))]
    fn from_json(
        text: &str,
        name: &str,
        folder: PathBuf,
        arrays: Vec<PyReadonlyArray2<'_, f64>>,
        start: Option<Py<Start>>,
    ) -> PyResult<Self> {
        let arrays: Vec<Array2<f64>> = arrays.iter().map(|array| array.as_array().to_owned()).collect();
        let arrays = Some(arrays);
        let source = Source { text: text.to_owned(), name: name.to_owned(), folder, arrays, start };
        Ok(Self(source.case()?, source))
    }

    /// For each number of its first stages a name of all that these depend on: cases that agree in it begin alike.
    fn beginnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let plan = py.detach(|| self.planned()).map_err(|error| refused(&error))?;
        Ok(run::beginnings(&plan))
    }

    /// Pickled as what it was read from.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let Source { text, name, folder, arrays, start } = &self.1;
        let class = py.get_type::<Self>();
        let folder = folder.as_path();
        Ok(match arrays {
            None => (class.getattr("from_toml")?, (text, name, folder, start).into_pyobject(py)?.into_any()),
            Some(arrays) => {
                let arrays: Vec<Bound<'py, PyArray2<f64>>> =
                    arrays.iter().map(|array| array.to_pyarray(py)).collect();
                (
                    class.getattr("from_json")?,
                    (text, name, folder, arrays, start).into_pyobject(py)?.into_any(),
                )
            }
        })
    }
}
