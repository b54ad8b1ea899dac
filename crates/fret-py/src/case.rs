//! The question as Python hands it over: text, read and judged by the core.

use fret_core::case;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyErr, PyResult, Python, pyclass, pymethods};

use crate::error::refused;

/// A case that has passed every check.
#[pyclass(frozen, module = "fretting._core")]
pub struct Case(pub case::Case);

#[pymethods]
impl Case {
    /// Case from TOML text; `name` stands in messages, `attachment(name)` gives the bytes of a file the case names.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str, name: &str, attachment: Bound<'_, PyAny>) -> PyResult<Self> {
        case::Case::from_toml_with(text, name, &|file| asked(py, &attachment, file))
            .map(Self)
            .map_err(|error| refused(&error))
    }

    /// Case from JSON text of the same structure; messages show it as TOML.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str, name: &str, attachment: Bound<'_, PyAny>) -> PyResult<Self> {
        case::Case::from_json_with(text, name, &|file| asked(py, &attachment, file))
            .map(Self)
            .map_err(|error| refused(&error))
    }
}

/// The bytes of a file, asked of Python; what it raises becomes the reason.
fn asked(py: Python<'_>, attachment: &Bound<'_, PyAny>, file: &str) -> Result<Vec<u8>, String> {
    let reason = |error: PyErr| error.value(py).to_string();
    attachment.call1((file,)).and_then(|content| content.extract()).map_err(reason)
}
