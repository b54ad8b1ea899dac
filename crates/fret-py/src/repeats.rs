//! Along which axes a problem repeats, as a case has it: a truth, or the letter of an axis.

use fret_core::model::{Axis, Periodicity};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Borrowed, FromPyObject, PyAny, PyErr};

/// `False`, `True`, `"x"` or `"y"`.
#[derive(Clone, Copy)]
pub struct Repeats(pub Periodicity);

impl FromPyObject<'_, '_> for Repeats {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, '_, PyAny>) -> Result<Self, PyErr> {
        if let Ok(both) = object.extract::<bool>() {
            return Ok(Self(Periodicity::Both(both)));
        }
        match object.extract::<String>()?.as_str() {
            "x" => Ok(Self(Periodicity::Along(Axis::X))),
            "y" => Ok(Self(Periodicity::Along(Axis::Y))),
            other => Err(PyValueError::new_err(format!(
                "periodic = {other:?}: must be True, False, \"x\" or \"y\""
            ))),
        }
    }
}
