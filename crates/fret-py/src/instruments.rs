//! Files of instruments, read by `fretting._instruments` with what is installed.

use std::path::Path;

use fret_core::case::Scan;
use numpy::PyReadonlyArray2;
use pyo3::prelude::{PyAnyMethods, PyResult, Python};

/// What Python hands back: heights with NaN for holes, side lengths, places of points, unit, and who read the file.
type Handed<'py> = (PyReadonlyArray2<'py, f64>, Option<[f64; 2]>, Option<Vec<f64>>, Option<String>, String);

/// Heights of a file, of the channel of a name or the first with heights.
///
/// # Errors
/// In the words of the exception.
pub fn read(path: &Path, channel: Option<&str>) -> Result<Scan, String> {
    Python::attach(|py| {
        let scan = || -> PyResult<Scan> {
            let handed = py.import("fretting._instruments")?.getattr("read")?.call1((path, channel))?;
            let (heights, size, places, unit, read_by): Handed<'_> = handed.extract()?;
            let heights = heights.as_array().to_owned();
            Ok(Scan { heights, size, places, unit, read_by })
        };
        scan().map_err(|error| error.value(py).to_string())
    })
}
