//! Stress under the surface of one body of a pair, from tractions.

use fret_core::case::Side;
use fret_core::model::{Body, ContactPair, HalfSpace, ResidualStress, SurfaceGrid};
use fret_core::plan::memory_of_stress;
use fret_core::subsurface::{
    EvenStress, LoadedSurface, StressTensor, Tractions, depth_points, displacements, survey,
};
use ndarray::{Array2, Array3, Axis};
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyfunction};
use pyo3::types::PyDict;

use crate::error::bad_value;
use crate::repeats::Repeats;
use crate::threads::{Threads, check_memory, on_pool};

/// The half-space of one body of a pair given as JSON text, and the sign of the contact's shear on it.
pub fn half_space_of((text, upper): (&str, bool)) -> PyResult<(HalfSpace, f64)> {
    let pair: ContactPair = serde_json::from_str(text).map_err(bad_value)?;
    let side = if upper { Side::Upper } else { Side::Lower };
    match side.of(&pair) {
        Body::Elastic(half_space) => Ok((half_space.clone(), if upper { -1.0 } else { 1.0 })),
        Body::Rigid => {
            let message = format!("the {} body is rigid: there is no stress in it", side.name());
            Err(PyValueError::new_err(message))
        }
    }
}

/// The residual stress of one body of those of the lower and the upper, given as JSON text.
pub fn residual_of(text: &str, upper: bool) -> PyResult<ResidualStress> {
    let [of_lower, of_upper]: [ResidualStress; 2] = serde_json::from_str(text).map_err(bad_value)?;
    Ok(if upper { of_upper } else { of_lower })
}

const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// Tractions: pressure, and shear on the lower body along x and y.
type TractionArrays<'py> =
    (PyReadonlyArray2<'py, f64>, Option<(PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>)>);

/// Stress at depths: arrays xx, yy, zz, xy, xz, yz, `von_mises` of shape (nz, nx, ny); depth and layer of shape (nz,).
#[pyfunction]
pub fn subsurface_stress<'py>(
    py: Python<'py>,
    bodies: (&str, bool),
    setting: ([f64; 2], Repeats),
    tractions: TractionArrays<'py>,
    depths: Vec<f64>,
    even: ([f64; 2], &str),
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let (spacing, Repeats(periodic)) = setting;
    let residual = residual_of(even.1, bodies.1)?;
    let even = EvenStress { bulk: even.0, residual };
    let (half_space, sign) = half_space_of(bodies)?;
    let half_space = &half_space;
    let points = depth_points(half_space, &depths).map_err(bad_value)?;
    let shape = tractions.0.as_array().dim();
    let cells = shape.0 * shape.1;
    // Seven numbers a cell and depth are the answer.
    let bytes = memory_of_stress(cells, 1).saturating_add(56 * cells.saturating_mul(points.len()));
    check_memory(&format!("{} depths of {} x {} cells", points.len(), shape.0, shape.1), bytes)?;
    let pressure: Array2<f64> = tractions.0.as_array().to_owned();
    let shear = tractions.1.map(|(x, y)| [x, y].map(|component| component.as_array().to_owned() * sign));
    if shear.as_ref().is_some_and(|shear| shear.iter().any(|component| component.dim() != shape)) {
        return Err(PyValueError::new_err(format!("shear of another shape than the pressure, {shape:?}")));
    }
    let grid = SurfaceGrid::new([shape.0, shape.1], spacing).map_err(bad_value)?;
    let surface = LoadedSurface { increment: 0, pressure, shear, slip: None, even };
    let mut stress: [Array3<f64>; 7] =
        std::array::from_fn(|_| Array3::zeros((points.len(), shape.0, shape.1)));
    on_pool(py, threads, || {
        survey(half_space, &grid, periodic, &points, &[surface], |point, _, field| {
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
    let depths: Vec<f64> = points.iter().map(|point| point.depth).collect();
    let layers: Vec<i64> = points.iter().map(|point| point.layer as i64).collect();
    items.set_item("depth", depths.into_pyarray(py))?;
    items.set_item("layer", layers.into_pyarray(py))?;
    Ok(items)
}

/// Displacement at depths: arrays `displacement_x`, `_y`, `_z` of shape (nz, nx, ny), in the order of the points of the stresses.
#[pyfunction]
pub fn subsurface_displacement<'py>(
    py: Python<'py>,
    bodies: (&str, bool),
    setting: ([f64; 2], Repeats),
    tractions: TractionArrays<'py>,
    depths: Vec<f64>,
    threads: Threads,
) -> PyResult<Bound<'py, PyDict>> {
    let (spacing, Repeats(periodic)) = setting;
    let (half_space, sign) = half_space_of(bodies)?;
    let half_space = &half_space;
    let points = depth_points(half_space, &depths).map_err(bad_value)?;
    let shape = tractions.0.as_array().dim();
    if shape.1 == 1 || periodic.one_axis().is_some() {
        return Err(PyValueError::new_err(
            "displacements below a line contact, or another without end along one axis, are not computed",
        ));
    }
    let cells = shape.0 * shape.1;
    // Nine kernels more than those of the stresses with what their transforms take, and three numbers a cell and depth.
    let bytes = memory_of_stress(2 * cells, 1).saturating_add(24 * cells.saturating_mul(points.len()));
    check_memory(&format!("{} depths of {} x {} cells", points.len(), shape.0, shape.1), bytes)?;
    let pressure: Array2<f64> = tractions.0.as_array().to_owned();
    let shear = tractions.1.map(|(x, y)| [x, y].map(|component| component.as_array().to_owned() * sign));
    if shear.as_ref().is_some_and(|shear| shear.iter().any(|component| component.dim() != shape)) {
        return Err(PyValueError::new_err(format!("shear of another shape than the pressure, {shape:?}")));
    }
    let grid = SurfaceGrid::new([shape.0, shape.1], spacing).map_err(bad_value)?;
    let mut moved: [Array3<f64>; 3] =
        std::array::from_fn(|_| Array3::zeros((points.len(), shape.0, shape.1)));
    on_pool(py, threads, || {
        let shear = shear.as_ref().map(|[x, y]| [x.view(), y.view()]);
        let tractions = Tractions { pressure: pressure.view(), shear };
        displacements(half_space, (&grid, periodic), &points, &tractions, |point, found| {
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
