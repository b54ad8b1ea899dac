//! The run in a folder of results, as arrays: read by the one reader of such folders; fields when they are asked for.

use std::path::PathBuf;

use fret_core::history::{Column, STEP_COLUMNS, Value};
use fret_results::{Results, ResultsError};
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, ToPyArray};
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyDict;
use serde_json::json;

use crate::error::unusable;

/// A folder of results that was found whole; fields stay on the disk. What it has of a `History` it gives by the same names.
#[pyclass(frozen, module = "fretting._core")]
pub struct StoredRun(Results);

#[pymethods]
impl StoredRun {
    /// The run of a folder, finished or not.
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        py.detach(|| Results::read(&folder)).map(Self).map_err(|error| unusable(error, &folder))
    }

    /// The record of the run, as JSON text.
    fn record(&self) -> String {
        json!(self.0.record).to_string()
    }

    /// The numbers of all steps: one array a name, one entry an increment; `regime` is a list of words.
    fn increments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = &self.0.table;
        let items = PyDict::new(py);
        for Column { name, value, .. } in STEP_COLUMNS {
            let numbers = || {
                table.has(name).then(|| table.column(name)).ok_or_else(|| {
                    let what =
                        format!("has no column {name}; it may be of an earlier version: run the case again");
                    unusable(ResultsError::unusable(&self.0.path.join("history.csv"), &what), &self.0.path)
                })
            };
            match value {
                Value::Count(_) => {
                    let counts: Vec<i64> = numbers()?.iter().map(|count| *count as i64).collect();
                    items.set_item(name, counts.into_pyarray(py))
                }
                Value::Real(_) | Value::RealOrNone(_) | Value::RealOrZero(_) => {
                    items.set_item(name, numbers()?.to_pyarray(py))
                }
                Value::Truth(_) => {
                    let truths = numbers()?.iter().map(|truth| *truth != 0.0);
                    items.set_item(name, PyArray1::from_iter(py, truths))
                }
                Value::Word(_) => items.set_item(name, table.regimes()),
            }?;
        }
        Ok(items)
    }

    /// The records of the cycles, as JSON text.
    fn cycles(&self) -> String {
        json!(self.0.cycles).to_string()
    }

    /// Running condition of each stage's cycles, as JSON text.
    fn running_conditions(&self) -> String {
        json!(self.0.running_conditions()).to_string()
    }

    /// Cell centres along x or y.
    fn centres<'py>(&self, py: Python<'py>, axis: usize) -> Bound<'py, PyArray1<f64>> {
        if axis == 0 { &self.0.fields.x } else { &self.0.fields.y }.to_pyarray(py)
    }

    /// Numbers of the increments whose fields are kept.
    fn kept_increments(&self) -> Vec<usize> {
        self.0.fields.steps.clone()
    }

    /// Names of the fields kept of an increment; none when nothing of it is kept.
    fn kept_fields(&self, increment: usize) -> Vec<&'static str> {
        if self.0.fields.steps.contains(&increment) { self.0.fields.names.clone() } else { Vec::new() }
    }

    /// A kept field, shape `(nx, ny)`; zones as bytes.
    fn field<'py>(&self, py: Python<'py>, name: &str, increment: usize) -> PyResult<Bound<'py, PyAny>> {
        let read =
            py.detach(|| self.0.field(name, increment)).map_err(|error| unusable(error, &self.0.path))?;
        let field: Array2<f64> =
            read.ok_or_else(|| pyo3::exceptions::PyKeyError::new_err((name.to_owned(), increment)))?;
        if name == "zone" {
            let zones: Bound<'py, PyArray2<u8>> = field.mapv(|zone| zone as u8).into_pyarray(py);
            return Ok(zones.into_any());
        }
        Ok(field.into_pyarray(py).into_any())
    }
}
