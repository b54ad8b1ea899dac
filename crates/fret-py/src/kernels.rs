//! The response of layered half-spaces, and products with it.

use std::sync::{Mutex, TryLockError};

use fret_core::kernel::{self, Components, FrequencyResponse};
use fret_core::model::{Body, ContactPair, HalfSpace};
use fret_fft::{Block, Kernel, Parity, Workspace};
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::PyDict;

use crate::case::Case;
use crate::error::bad_value;
use crate::threads::{ALL, on_pool};

/// A public name and the component of a response it stands for.
type Component = (&'static str, fn(&kernel::Response) -> f64);

/// The lower body of a case, which is elastic.
fn half_space(case: &Case) -> PyResult<&HalfSpace> {
    match case.0.bodies.lower() {
        Body::Elastic(half_space) => Ok(half_space),
        Body::Rigid => Err(PyValueError::new_err("body: rigid, it does not respond to tractions")),
    }
}

/// Surface compliance of the lower body of a case at every wavenumber `k > 0` of a contiguous array; arrays zz, rr, rz, tt.
#[pyfunction]
pub fn frequency_response<'py>(
    py: Python<'py>,
    k: PyReadonlyArray1<'py, f64>,
    case: &Case,
) -> PyResult<Bound<'py, PyDict>> {
    let half_space = half_space(case)?;
    let k = k.as_slice()?;
    let responses: Vec<kernel::Response> = py.detach(|| {
        let response = FrequencyResponse::new(half_space);
        k.iter().map(|&k| response.at(k)).collect()
    });
    let components: [Component; 4] = [("zz", |c| c.zz), ("rr", |c| c.rr), ("rz", |c| c.rz), ("tt", |c| c.tt)];
    let items = PyDict::new(py);
    for (name, component) in components {
        items.set_item(name, responses.iter().map(component).collect::<Vec<f64>>().into_pyarray(py))?;
    }
    Ok(items)
}

/// Influence coefficients of the lower body of a case under a rigid body; arrays zz, xx, yy, xy, zx, zy of shape `cells`.
#[pyfunction]
pub fn influence_coefficients<'py>(
    py: Python<'py>,
    case: &Case,
    cells: [usize; 2],
    spacing: [f64; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let half_space = half_space(case)?.clone();
    let pair = ContactPair::new(Body::Rigid, Body::Elastic(half_space)).map_err(bad_value)?;
    let coefficients =
        on_pool(py, ALL, || kernel::influence_coefficients(&pair, cells, spacing, Components::ALL))?;
    let components: [(&str, Option<Array2<f64>>); 6] = [
        ("zz", coefficients.zz),
        ("xx", coefficients.xx),
        ("yy", coefficients.yy),
        ("xy", coefficients.xy),
        ("zx", coefficients.zx),
        ("zy", coefficients.zy),
    ];
    let items = PyDict::new(py);
    for (name, array) in components {
        if let Some(array) = array {
            items.set_item(name, array.into_pyarray(py))?;
        }
    }
    Ok(items)
}

/// The free-space product of a field with one kernel.
#[pyclass(frozen, module = "fretting._core")]
pub struct Convolution {
    product: fret_fft::Convolution,
    workspace: Mutex<Workspace>,
}

#[pymethods]
impl Convolution {
    /// Plans the product with `values` over offsets >= 0, continued by `parity` along x and y.
    #[new]
    fn new(py: Python<'_>, values: PyReadonlyArray2<'_, f64>, parity: &str) -> PyResult<Self> {
        let parity = match parity {
            "even-even" => Parity::EvenEven,
            "odd-even" => Parity::OddEven,
            "even-odd" => Parity::EvenOdd,
            "odd-odd" => Parity::OddOdd,
            other => {
                return Err(PyValueError::new_err(format!(
                    "parity = {other:?}: must be \"even-even\", \"odd-even\", \"even-odd\" or \"odd-odd\" (along x, then y)"
                )));
            }
        };
        let kernel = Kernel { values: values.as_array(), parity };
        let shape = [kernel.values.nrows(), kernel.values.ncols()];
        let block = Block { output: 0, input: 0, kernel: 0, sign: 1.0 };
        let product = on_pool(py, ALL, || fret_fft::Convolution::new(shape, &[kernel], &[block]))?
            .map_err(bad_value)?;
        let workspace = Mutex::new(product.workspace());
        Ok(Self { product, workspace })
    }

    /// Cells `(nx, ny)`.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        let [nx, ny] = self.product.shape();
        (nx, ny)
    }

    /// The product with a contiguous field of shape `(nx, ny)`.
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        field: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let [nx, ny] = self.product.shape();
        if field.shape() != [nx, ny] {
            return Err(PyValueError::new_err(format!(
                "field of shape {:?}: the product was made for ({nx}, {ny})",
                field.shape()
            )));
        }
        let input = field.as_slice()?;
        let mut output = Array2::zeros((nx, ny));
        on_pool(py, ALL, || {
            let output: &mut [f64] = output.as_slice_mut().unwrap_or_default(); // zeros are contiguous
            match self.workspace.try_lock() {
                Ok(mut workspace) => self.product.apply(&mut workspace, &[input], &mut [output]),
                // Another thread is at work with it, or was when the process forked.
                Err(TryLockError::WouldBlock | TryLockError::Poisoned(_)) => {
                    self.product.apply(&mut self.product.workspace(), &[input], &mut [output]);
                }
            }
        })?;
        Ok(output.into_pyarray(py))
    }
}
