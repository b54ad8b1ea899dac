//! The question as Python hands it over: text, read and judged by the core.

use std::path::PathBuf;

use fret_core::case::{self, Attachments, CaseError};
use fret_core::plan::{LeaveOut, Plan};
use ndarray::Array2;
use numpy::{PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::IntoPyObject;
use pyo3::prelude::{Bound, Py, PyAny, PyAnyMethods, PyResult, Python, pyclass, pymethods};

use crate::error::refused;
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
        let attachments = Attachments { file: &file, arrays, start };
        let read = if self.arrays.is_some() {
            case::Case::from_json_with(&self.text, &self.name, attachments)
        } else {
            case::Case::from_toml_with(&self.text, &self.name, attachments)
        };
        read.map_err(|error| refused(&error))
    }
}

impl Case {
    /// The case planned, to start from the state that it was read with.
    pub fn planned(&self) -> Result<Plan, CaseError> {
        let start = self.1.start.as_ref().map(|start| start.get().0.clone());
        Plan::starting_from(start, self.0.clone(), LeaveOut::ALL)
    }
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
