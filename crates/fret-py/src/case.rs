//! The question as Python hands it over: text, read and judged by the core.

use fret_core::case;
use pyo3::prelude::{PyResult, pyclass, pymethods};

use crate::error::refused;

/// A case that has passed every check.
#[pyclass(frozen, module = "fretting._core")]
pub struct Case(pub case::Case);

#[pymethods]
impl Case {
    /// Case from TOML text; `name` stands in messages.
    #[staticmethod]
    fn from_toml(text: &str, name: &str) -> PyResult<Self> {
        case::Case::from_toml(text, name).map(Self).map_err(|error| refused(&error))
    }

    /// Case from JSON text of the same structure; messages show it as TOML.
    #[staticmethod]
    fn from_json(text: &str, name: &str) -> PyResult<Self> {
        case::Case::from_json(text, name).map(Self).map_err(|error| refused(&error))
    }
}
