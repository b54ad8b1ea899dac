//! Temperature rise by friction and contact resistance, from kept fields.

use fret_core::conduction::{self, HeatedSurface, friction_heat, slip_of_cycle};
use fret_core::plan::memory_of_stress;
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;

use crate::error::bad_value;
use crate::ran::{Ran, VectorArrays};
use crate::threads::{Threads, check_memory, on_pool};

/// Pressure, shear and slip of an increment.
type IncrementArrays<'py> = (PyReadonlyArray2<'py, f64>, VectorArrays<'py>, VectorArrays<'py>);

/// Temperature rise by the friction of a cycle: arrays heat, `heat_into_lower`, `rise_lower`, `rise_upper` (of a body that conducts) of shape
/// (nx, ny), and the fraction of the dissipated energy that the increments account for.
#[pyfunction]
pub fn surface_temperature<'py>(
    py: Python<'py>,
    plan: &str,
    increments: Vec<IncrementArrays<'py>>,
    loading: (f64, f64),
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let (dissipated_energy, frequency) = loading;
    let ran = Ran::read(plan)?;
    let (grid, periodic, bodies) = (ran.grid(), ran.periodic(), ran.conductors(true));
    let [nx, ny] = grid.cells();
    check_memory(
        &format!("{} increments of {nx} x {ny} cells", increments.len()),
        memory_of_stress(grid.len(), increments.len()),
    )?;
    let surface = |(pressure, shear, slip): &IncrementArrays<'py>| {
        let (pressure, shear, slip) = (ran.field(pressure)?, ran.vector(shear)?, ran.vector(slip)?);
        Ok(HeatedSurface { pressure, shear, slip })
    };
    let surfaces: Vec<HeatedSurface> = increments.iter().map(surface).collect::<PyResult<_>>()?;
    let Some(slip) = slip_of_cycle(surfaces, dissipated_energy, grid.cell_area()) else {
        return Err(PyValueError::new_err(
            "the kept fields of the cycle give another dissipated energy than the run",
        ));
    };
    let found = on_pool(py, threads, || {
        let heat = friction_heat(&slip, frequency);
        conduction::surface_temperature(bodies, grid, periodic, &heat, &slip.contact)
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

/// Resistance of the contact where there is pressure, to heat or to current.
#[pyfunction]
pub fn contact_resistance(
    py: Python<'_>,
    plan: &str,
    thermal: bool,
    pressure: PyReadonlyArray2<'_, f64>,
    threads: Threads,
) -> PyResult<f64> {
    let ran = Ran::read(plan)?;
    let (grid, periodic, bodies) = (ran.grid(), ran.periodic(), ran.conductors(thermal));
    let [nx, ny] = grid.cells();
    check_memory(&format!("{nx} x {ny} cells"), memory_of_stress(grid.len(), 1))?;
    let contact = ran.field(&pressure)?.mapv(|pressure| pressure > 0.0);
    on_pool(py, threads, || conduction::contact_resistance(bodies, grid, periodic, &contact))?
        .map_err(bad_value)
}
