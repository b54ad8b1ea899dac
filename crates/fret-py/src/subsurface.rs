//! Stress under the surface of one body of a run, from its tractions.

use fret_core::plan::memory_of_stress;
use fret_core::subsurface::{StressTensor, Tractions, depth_points, displacements, survey};
use ndarray::{Array3, Axis};
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;

use crate::error::bad_value;
use crate::ran::{Beneath, IncrementArrays, Ran, set_points};
use crate::threads::{Threads, check_memory, on_pool};

const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// Stress at depths: arrays xx, yy, zz, xy, xz, yz, `von_mises` of shape (nz, nx, ny); depth and layer of shape (nz,).
#[pyfunction]
pub fn subsurface_stress<'py>(
    py: Python<'py>,
    run: (&str, bool),
    increment: IncrementArrays<'py>,
    depths: Vec<f64>,
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let body = Beneath::of(Ran::read(run.0)?, run.1)?;
    let points = depth_points(&body.half_space, &depths).map_err(bad_value)?;
    let (grid, periodic) = (body.ran.grid(), body.ran.periodic());
    let ([nx, ny], cells) = (grid.cells(), grid.len());
    // Seven numbers a cell and depth are the answer.
    let bytes = memory_of_stress(cells, 1).saturating_add(56 * cells.saturating_mul(points.len()));
    check_memory(&format!("{} depths of {nx} x {ny} cells", points.len()), bytes)?;
    let surfaces = [body.surface(0, &increment)?];
    let mut stress: [Array3<f64>; 7] = std::array::from_fn(|_| Array3::zeros((points.len(), nx, ny)));
    on_pool(py, threads, || {
        survey(&body.half_space, grid, periodic, &points, &surfaces, |point, _, field| {
            for (component, values) in field.components.iter().enumerate() {
                stress[component].index_axis_mut(Axis(0), point).assign(values);
            }
            stress[6].index_axis_mut(Axis(0), point).assign(&field.map(StressTensor::von_mises));
            true
        })
    })?
    .map_err(bad_value)?;
    let items = PyDict::new(py);
    for (name, values) in COMPONENTS.into_iter().chain(["von_mises"]).zip(stress) {
        items.set_item(name, values.into_pyarray(py))?;
    }
    set_points(py, &items, &points)?;
    Ok(items)
}

/// Displacement at depths: arrays `displacement_x`, `_y`, `_z` of shape (nz, nx, ny), in the order of the points of the stresses.
#[pyfunction]
pub fn subsurface_displacement<'py>(
    py: Python<'py>,
    run: (&str, bool),
    increment: IncrementArrays<'py>,
    depths: Vec<f64>,
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let body = Beneath::of(Ran::read(run.0)?, run.1)?;
    let points = depth_points(&body.half_space, &depths).map_err(bad_value)?;
    let (grid, periodic) = (body.ran.grid(), body.ran.periodic());
    let ([nx, ny], cells) = (grid.cells(), grid.len());
    if ny == 1 || periodic.one_axis().is_some() {
        return Err(PyValueError::new_err(
            "displacements below a line contact, or another without end along one axis, are not computed",
        ));
    }
    // Nine kernels more than those of the stresses with what their transforms take, and three numbers a cell and depth.
    let bytes = memory_of_stress(2 * cells, 1).saturating_add(24 * cells.saturating_mul(points.len()));
    check_memory(&format!("{} depths of {nx} x {ny} cells", points.len()), bytes)?;
    let surface = body.surface(0, &increment)?;
    let mut moved: [Array3<f64>; 3] = std::array::from_fn(|_| Array3::zeros((points.len(), nx, ny)));
    on_pool(py, threads, || {
        let shear = surface.shear.as_ref().map(|[x, y]| [x.view(), y.view()]);
        let tractions = Tractions { pressure: surface.pressure.view(), shear };
        displacements(&body.half_space, (grid, periodic), &points, &tractions, |point, found| {
            for (field, found) in moved.iter_mut().zip(&found) {
                field.index_axis_mut(Axis(0), point).assign(found);
            }
        })
    })?
    .map_err(bad_value)?;
    let items = PyDict::new(py);
    for (name, values) in ["displacement_x", "displacement_y", "displacement_z"].into_iter().zip(moved) {
        items.set_item(name, values.into_pyarray(py))?;
    }
    Ok(items)
}
