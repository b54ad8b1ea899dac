//! The fields of a run in a folder of results, read when they are asked for.

use std::path::PathBuf;

use fret_cli::embedded::{StoredRun as Stored, stored_run};
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, ToPyArray};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{Bound, PyAny, PyResult, Python, pyclass, pymethods};

use crate::error::unreadable;

/// A folder of results that was found whole; fields stay on the disk.
#[pyclass(frozen, module = "fretting._core")]
pub struct StoredRun {
    run: Stored,
    folder: PathBuf,
}

#[pymethods]
impl StoredRun {
    /// The run of a folder, judged by the reader of the command.
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        match py.detach(|| stored_run(&folder)) {
            Ok(run) => Ok(Self { run, folder }),
            Err(message) => Err(unreadable(message, &folder.to_string_lossy())),
        }
    }

    /// Cell centres along x or y.
    fn centres<'py>(&self, py: Python<'py>, axis: usize) -> Bound<'py, PyArray1<f64>> {
        self.run.centres(axis).to_pyarray(py)
    }

    /// Numbers of the increments whose fields are kept.
    fn kept_increments(&self) -> Vec<usize> {
        self.run.kept_increments().to_vec()
    }

    /// Names of the kept fields.
    fn names(&self) -> Vec<&'static str> {
        self.run.names().to_vec()
    }

    /// A field of the increment at a place among the kept ones, shape `(nx, ny)`; zones as bytes.
    fn field<'py>(&self, py: Python<'py>, name: &str, place: usize) -> PyResult<Bound<'py, PyAny>> {
        let field: Array2<f64> = py
            .detach(|| self.run.field(name, place))
            .map_err(|message| unreadable(message, &self.folder.to_string_lossy()))?;
        if name == "zone" {
            let zones: Bound<'py, PyArray2<u8>> = field.mapv(|zone| zone as u8).into_pyarray(py);
            return zones.into_bound_py_any(py);
        }
        field.into_pyarray(py).into_bound_py_any(py)
    }
}
