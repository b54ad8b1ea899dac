//! Temperature rise by friction and contact resistance, from kept fields.

use fret_core::conduction::{self, HeatedSurface, friction_heat, slip_of_cycle};
use fret_core::model::{Conductor, SurfaceGrid};
use fret_core::plan::memory_of_stress;
use ndarray::Array2;
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;

use crate::error::bad_value;
use crate::repeats::Repeats;
use crate::threads::{Threads, check_memory, on_pool};

/// The conductors of the lower and the upper body, given as JSON text.
fn conductors_of(text: &str) -> PyResult<[Option<Conductor>; 2]> {
    serde_json::from_str(text).map_err(bad_value)
}

/// Pressure, shear and slip of an increment.
type IncrementArrays<'py> = (
    PyReadonlyArray2<'py, f64>,
    (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>),
    (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>),
);

/// Temperature rise by the friction of a cycle: arrays heat, `heat_into_lower`, `rise_lower`, `rise_upper` (of a body that conducts) of shape
/// (nx, ny), and the fraction of the dissipated energy that the increments account for.
#[pyfunction]
pub fn surface_temperature<'py>(
    py: Python<'py>,
    conductors: &str,
    setting: ([f64; 2], Repeats),
    increments: Vec<IncrementArrays<'py>>,
    loading: (f64, f64),
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let (spacing, Repeats(periodic)) = setting;
    let (dissipated_energy, frequency) = loading;
    let conductors = conductors_of(conductors)?;
    let Some(shape) = increments.first().map(|(pressure, ..)| pressure.as_array().dim()) else {
        return Err(PyValueError::new_err("no increment with kept fields"));
    };
    check_memory(
        &format!("{} increments of {} x {} cells", increments.len(), shape.0, shape.1),
        memory_of_stress(shape.0 * shape.1, increments.len()),
    )?;
    let grid = SurfaceGrid::new([shape.0, shape.1], spacing).map_err(bad_value)?;
    let copied = |field: &PyReadonlyArray2<'py, f64>| field.as_array().to_owned();
    let surfaces: Vec<HeatedSurface> = increments
        .iter()
        .map(|(pressure, shear, slip)| HeatedSurface {
            pressure: copied(pressure),
            shear: [copied(&shear.0), copied(&shear.1)],
            slip: [copied(&slip.0), copied(&slip.1)],
        })
        .collect();
    let is_odd = |field: &Array2<f64>| field.dim() != shape;
    if surfaces
        .iter()
        .any(|surface| is_odd(&surface.pressure) || surface.shear.iter().chain(&surface.slip).any(is_odd))
    {
        return Err(PyValueError::new_err(format!(
            "fields of other shapes than the first pressure, {shape:?}"
        )));
    }
    let Some(slip) = slip_of_cycle(surfaces, dissipated_energy, grid.cell_area()) else {
        return Err(PyValueError::new_err(
            "the kept fields of the cycle give another dissipated energy than the run",
        ));
    };
    let [lower, upper] = conductors.each_ref().map(Option::as_ref);
    let found = on_pool(py, threads, || {
        let heat = friction_heat(&slip, frequency);
        conduction::surface_temperature([lower, upper], &grid, periodic, &heat, &slip.contact)
    })?
    .map_err(bad_value)?;
    let items = PyDict::new(py);
    items.set_item("heat", found.heat.into_pyarray(py))?;
    items.set_item("heat_into_lower", found.into_lower.into_pyarray(py))?;
    for (name, rise) in ["rise_lower", "rise_upper"].into_iter().zip(found.rise) {
        if let Some(rise) = rise {
            items.set_item(name, rise.into_pyarray(py))?;
        }
    }
    items.set_item("accounted", slip.accounted)?;
    Ok(items)
}

/// Resistance of the contact where there is pressure.
#[pyfunction]
pub fn contact_resistance(
    py: Python<'_>,
    conductors: &str,
    setting: ([f64; 2], Repeats),
    pressure: PyReadonlyArray2<'_, f64>,
    threads: Threads,
) -> PyResult<f64> {
    let (spacing, Repeats(periodic)) = setting;
    let conductors = conductors_of(conductors)?;
    let contact = pressure.as_array().mapv(|pressure| pressure > 0.0);
    let shape = contact.dim();
    check_memory(&format!("{} x {} cells", shape.0, shape.1), memory_of_stress(shape.0 * shape.1, 1))?;
    let grid = SurfaceGrid::new([shape.0, shape.1], spacing).map_err(bad_value)?;
    let [lower, upper] = conductors.each_ref().map(Option::as_ref);
    on_pool(py, threads, || conduction::contact_resistance([lower, upper], &grid, periodic, &contact))?
        .map_err(bad_value)
}
