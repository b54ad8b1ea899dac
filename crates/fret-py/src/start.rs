//! A solved state for another history to start from.

use std::path::PathBuf;
use std::sync::Arc;

use fret_core::history;
use fret_results::Origin;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyBytes;

use crate::error::unusable;
use crate::history::History;

/// A solved state with its grid, bodies and profile.
#[pyclass(frozen, module = "fretting._core")]
pub struct Start(pub Arc<history::Start>);

#[pymethods]
impl Start {
    /// The state at the end of an increment (the last one when none is given) of the results in a folder.
    #[staticmethod]
    fn from_folder(folder: PathBuf, increment: Option<usize>) -> PyResult<Self> {
        match Origin::of(&folder, increment) {
            Ok(origin) => Ok(Self(origin.start)),
            Err(error) => Err(unusable(error, &folder)),
        }
    }

    /// The state at the end of an increment of a history.
    #[staticmethod]
    fn from_history(history: &History, increment: usize) -> PyResult<Self> {
        let state = history::Start::of(&history.solved, increment).ok_or_else(|| {
            let all: Vec<_> = history::Start::all_of(&history.solved).iter().map(usize::to_string).collect();
            PyValueError::new_err(format!(
                "start: the history has no state at the end of increment {increment}; it has those of {}: increments whose \
                 pressure, shear and slip are kept ([output]), and the last of every stage",
                all.join(", ")
            ))
        })?;
        Ok(Self(Arc::new(state)))
    }

    /// The state of bytes that were pickled.
    #[staticmethod]
    fn from_bytes(content: &[u8]) -> PyResult<Self> {
        let state = history::Start::from_bytes(content);
        state.map(|state| Self(Arc::new(state))).ok_or_else(|| PyValueError::new_err("bytes of no state"))
    }

    /// Digest that tells it from other states.
    fn digest(&self) -> &str {
        self.0.digest()
    }

    /// Pickled as its bytes.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let bytes = self.0.to_bytes().unwrap_or_default();
        let arguments = (PyBytes::new(py, &bytes),).into_bound_py_any(py)?;
        Ok((py.get_type::<Self>().getattr("from_bytes")?, arguments))
    }
}
