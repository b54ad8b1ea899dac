//! The answer of a run, as arrays.

use std::path::PathBuf;

use fret_cli::embedded::{self, Solved};
use fret_core::history::{
    self, CYCLE_COLUMNS, Column, FIELDS, Field, FieldValues, STEP_COLUMNS, StepRecord, Value, ZONE_WORDS,
    running_condition,
};
use fret_core::plan::Plan;
use fret_core::study::StageQuantities;
use fret_results::{CaseFile, ResultFolder, Wish};
use numpy::{IntoPyArray, PyArray1, ToPyArray};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::PyDict;
use serde_json::{Value as Json, json};

use crate::error::{bad_value, stopped};

/// One step as a dict of numbers.
pub fn step_items<'py>(py: Python<'py>, step: &StepRecord) -> PyResult<Bound<'py, PyDict>> {
    let items = PyDict::new(py);
    for Column { name, value, .. } in STEP_COLUMNS {
        match value {
            Value::Count(of) => items.set_item(name, of(step)),
            Value::Real(of) => items.set_item(name, of(step)),
            Value::RealOrNone(of) => items.set_item(name, of(step)),
            Value::RealOrZero(of) => items.set_item(name, of(step).unwrap_or(0.0)),
            Value::Truth(of) => items.set_item(name, of(step)),
            Value::Word(of) => items.set_item(name, of(step)),
        }?;
    }
    Ok(items)
}

/// All of a run.
#[pyclass(frozen, module = "fretting._core")]
pub struct History {
    /// Numbers and fields.
    pub solved: history::History,
    /// What was solved.
    pub plan: Plan,
    /// The case as it was read.
    pub case: CaseFile,
    /// Quantities of interest at the ends of the stages.
    pub quantities: Vec<StageQuantities>,
    /// JSON text of its error bars, where they were asked for.
    pub error_bars: Option<String>,
}

#[pymethods]
impl History {
    /// The numbers of all steps: one array a name, one entry an increment; `regime` is a list of words.
    fn increments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let steps = &self.solved.steps;
        let items = PyDict::new(py);
        for Column { name, value, .. } in STEP_COLUMNS {
            match value {
                Value::Count(of) => {
                    let column: Vec<i64> = steps.iter().map(|step| of(step) as i64).collect();
                    items.set_item(name, column.into_pyarray(py))
                }
                Value::Real(of) => items.set_item(name, PyArray1::from_iter(py, steps.iter().map(of))),
                Value::RealOrNone(of) => {
                    let column = steps.iter().map(|step| of(step).unwrap_or(f64::NAN));
                    items.set_item(name, PyArray1::from_iter(py, column))
                }
                Value::RealOrZero(of) => {
                    let column = steps.iter().map(|step| of(step).unwrap_or(0.0));
                    items.set_item(name, PyArray1::from_iter(py, column))
                }
                Value::Truth(of) => items.set_item(name, PyArray1::from_iter(py, steps.iter().map(of))),
                Value::Word(of) => items.set_item(name, steps.iter().map(of).collect::<Vec<_>>()),
            }?;
        }
        Ok(items)
    }

    /// The records of the cycles, as JSON text.
    fn cycles(&self) -> PyResult<String> {
        serde_json::to_string(&self.solved.cycles).map_err(bad_value)
    }

    /// What is known of the run as a whole, as JSON text, by the names of the record in a folder of results.
    fn record(&self) -> String {
        let history::History { plan, warnings, worn_through, worn_by_layer, .. } = &self.solved;
        json!({
            "version": env!("CARGO_PKG_VERSION"), "status": "solved", "plan": plan, "warnings": warnings,
            "worn_through": worn_through, "worn_by_layer": worn_by_layer,
        })
        .to_string()
    }

    /// Running condition of each stage's cycles, as JSON text.
    fn running_conditions(&self) -> PyResult<String> {
        let of = |stage| running_condition(self.solved.cycles.iter().filter(|cycle| cycle.stage == stage));
        let conditions: Vec<_> = (0..self.solved.stages.len()).map(of).collect();
        serde_json::to_string(&conditions).map_err(bad_value)
    }

    /// Error bars, as JSON text, where they were asked for.
    fn error_bars(&self) -> Option<&str> {
        self.error_bars.as_deref()
    }

    /// Writes all of it into a folder, as the run itself would have done; `early` is the status and reason of one that ended early.
    fn save(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        replace: bool,
        early: Option<(String, String)>,
    ) -> PyResult<()> {
        let solved = Solved {
            plan: &self.plan,
            history: &self.solved,
            quantities: &self.quantities,
            early: early.as_ref().map(|(status, why)| (status.as_str(), why.as_str())),
            error_bars: self.error_bars.as_deref(),
        };
        py.detach(|| embedded::save(solved, &self.case, &folder, Wish::of(false, replace))).map_err(stopped)
    }

    /// Coordinates of the cell centres along axis 0 or 1 [length].
    fn centres<'py>(&self, py: Python<'py>, axis: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        if axis > 1 {
            return Err(PyValueError::new_err(format!("axis = {axis}: must be 0 or 1")));
        }
        Ok(self.solved.grid.centres(axis).into_pyarray(py))
    }

    /// Increments whose fields are kept.
    fn kept_increments(&self) -> Vec<usize> {
        self.solved.fields.iter().map(|kept| kept.increment).collect()
    }

    /// Names of the fields kept of an increment; none when nothing of it is kept.
    fn kept_fields(&self, increment: usize) -> Vec<&'static str> {
        self.solved.fields_of(increment).map_or_else(Vec::new, |kept| {
            FIELDS.iter().filter(|field| (field.values)(kept).is_some()).map(|field| field.name).collect()
        })
    }

    /// A kept field, shape `(nx, ny)`: a copy, the caller's own.
    fn field<'py>(&self, py: Python<'py>, name: &str, increment: usize) -> PyResult<Bound<'py, PyAny>> {
        let missing = || PyKeyError::new_err((name.to_owned(), increment));
        let kept = self.solved.fields_of(increment).ok_or_else(missing)?;
        let field = FIELDS.iter().find(|field| field.name == name).and_then(|field| (field.values)(kept));
        match field {
            Some(FieldValues::Reals(values)) => Ok(values.to_pyarray(py).into_any()),
            Some(FieldValues::Zones(zones)) => Ok(zones.mapv(|zone| zone as u8).into_pyarray(py).into_any()),
            None => Err(missing()),
        }
    }
}

/// The kind of quantity, such as `force x length`, of a dotted key of a case; nothing where it has no unit.
#[pyfunction]
pub fn kind_of_key(key: &str) -> Option<&'static str> {
    fret_cli::embedded::kind_of_key(key)
}

/// Removes the results in a folder, and what is computed of them.
#[pyfunction]
pub fn clear_results(folder: PathBuf) -> PyResult<()> {
    ResultFolder::clear(&folder).map_err(|error| stopped(error.into()))
}

/// Every column and field by its kind, name, meaning and unit, as JSON text: what the Python package says of them is made from it.
#[pyfunction]
pub fn vocabulary() -> String {
    fn told<R>(columns: &[Column<R>]) -> Vec<Json> {
        let kind = |value: &Value<R>| match value {
            Value::Count(_) => "int",
            Value::Real(_) | Value::RealOrNone(_) | Value::RealOrZero(_) => "float",
            Value::Truth(_) => "bool",
            Value::Word(_) => "str",
        };
        let entry = |column: &Column<R>| {
            let Column { name, meaning, unit, turning, value } = column;
            json!({ "name": name, "meaning": meaning, "unit": unit, "turning": turning, "kind": kind(value) })
        };
        columns.iter().map(entry).collect()
    }
    let field = |field: &Field| json!({ "name": field.name, "meaning": field.meaning, "unit": field.unit });
    let fields: Vec<Json> = FIELDS.iter().map(field).collect();
    json!({ "steps": told(STEP_COLUMNS), "cycles": told(CYCLE_COLUMNS), "fields": fields, "zones": ZONE_WORDS })
        .to_string()
}
