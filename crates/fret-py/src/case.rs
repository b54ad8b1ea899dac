//! The question as Python hands it over: text, read and judged by the core.

use fret_core::case;
use pyo3::prelude::{Bound, PyAny, PyAnyMethods, PyResult, Python, pyclass, pymethods};

use crate::error::refused;

/// A case that has passed every check.
#[pyclass(frozen, module = "fretting._core")]
pub struct Case(pub case::Case, Source);

/// What a case was read from.
struct Source {
    reader: &'static str,
    text: String,
    name: String,
}

impl Source {
    fn new(reader: &'static str, text: &str, name: &str) -> Self {
        Self { reader, text: text.to_owned(), name: name.to_owned() }
    }
}

#[pymethods]
impl Case {
    /// Case from TOML text; `name` stands in messages.
    #[staticmethod]
    fn from_toml(text: &str, name: &str) -> PyResult<Self> {
        let case = case::Case::from_toml(text, name).map_err(|error| refused(&error))?;
        Ok(Self(case, Source::new("from_toml", text, name)))
    }

    /// Case from JSON text of the same structure; messages show it as TOML.
    #[staticmethod]
    fn from_json(text: &str, name: &str) -> PyResult<Self> {
        let case = case::Case::from_json(text, name).map_err(|error| refused(&error))?;
        Ok(Self(case, Source::new("from_json", text, name)))
    }

    /// Pickled as what it was read from.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (&str, &str))> {
        let reader = py.get_type::<Self>().as_any().getattr(self.1.reader)?;
        Ok((reader, (&self.1.text, &self.1.name)))
    }
}
