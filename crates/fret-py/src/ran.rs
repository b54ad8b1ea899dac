//! A run as it was planned: what is asked of its fields afterwards takes bodies, grid and constants from there.

use fret_core::case::Side;
use fret_core::model::{Body, Conductor, HalfSpace, Periodicity, ResidualStress, SurfaceGrid};
use fret_core::plan::PlanRecord;
use fret_core::subsurface::fatigue::{FatigueConstants, LayerConstants};
use fret_core::subsurface::{DepthPoint, EvenStress, LoadedSurface};
use ndarray::Array2;
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python};
use pyo3::types::PyDict;

use crate::error::bad_value;

/// Two fields of a vector.
pub type VectorArrays<'py> = (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>);

/// Fields of an increment: pressure, shear, slip and the bulk stress of the body.
pub type IncrementArrays<'py> =
    (PyReadonlyArray2<'py, f64>, Option<VectorArrays<'py>>, Option<VectorArrays<'py>>, [f64; 2]);

/// A run, by its plan.
pub struct Ran(PlanRecord);

impl Ran {
    /// The run of a plan, given as JSON text.
    pub fn read(plan: &str) -> PyResult<Self> {
        serde_json::from_str(plan).map(Self).map_err(bad_value)
    }

    /// The grid.
    pub fn grid(&self) -> &SurfaceGrid {
        &self.0.grid
    }

    /// Along which axes it repeats.
    pub fn periodic(&self) -> Periodicity {
        self.0.case.periodic
    }

    /// What the lower and the upper body conduct: heat, or current.
    pub fn conductors(&self, thermal: bool) -> [Option<&Conductor>; 2] {
        let conduction = &self.0.case.conduction;
        let conductors = if thermal { &conduction.thermal } else { &conduction.electrical };
        conductors.each_ref().map(Option::as_ref)
    }

    /// The constants of a body's layers: those that are given as JSON text, or else those of the case.
    pub fn constants(&self, upper: bool, given: Option<&str>) -> PyResult<LayerConstants> {
        let case = &self.0.case;
        let Some(given) = given else {
            let of_stress = case.stress.as_ref().map(|stress| stress.fatigue);
            return Ok(case.fatigue[usize::from(upper)].clone().or(of_stress.unwrap_or_default()));
        };
        let given: FatigueConstants = serde_json::from_str(given).map_err(bad_value)?;
        match given.fault() {
            Some((_, what)) => Err(PyValueError::new_err(what)),
            None => Ok(LayerConstants::everywhere(given)),
        }
    }

    /// A field as the core has it.
    pub fn field(&self, field: &PyReadonlyArray2<'_, f64>) -> PyResult<Array2<f64>> {
        let (field, cells) = (field.as_array(), self.grid().cells());
        if <[usize; 2]>::from(field.dim()) != cells {
            return Err(PyValueError::new_err(format!("a field of another shape than the grid, {cells:?}")));
        }
        Ok(field.to_owned())
    }

    /// Both fields of a vector.
    pub fn vector(&self, (x, y): &VectorArrays<'_>) -> PyResult<[Array2<f64>; 2]> {
        Ok([self.field(x)?, self.field(y)?])
    }
}

/// One of the bodies of a run, under its surface.
pub struct Beneath {
    /// The run.
    pub ran: Ran,
    /// The body.
    pub half_space: HalfSpace,
    sign: f64,
    residual: ResidualStress,
}

impl Beneath {
    /// The upper or the lower body of a run.
    pub fn of(ran: Ran, upper: bool) -> PyResult<Self> {
        let side = if upper { Side::Upper } else { Side::Lower };
        let Body::Elastic(half_space) = side.of(&ran.0.case.bodies) else {
            let message = format!("the {} body is rigid: there is no stress in it", side.name());
            return Err(PyValueError::new_err(message));
        };
        let (half_space, residual) =
            (half_space.clone(), ran.0.case.residual_stress[usize::from(upper)].clone());
        Ok(Self { ran, half_space, sign: if upper { -1.0 } else { 1.0 }, residual })
    }

    /// What an increment loads the body with.
    pub fn surface(
        &self,
        increment: usize,
        (pressure, shear, slip, bulk): &IncrementArrays<'_>,
    ) -> PyResult<LoadedSurface> {
        let vector = |given: &Option<VectorArrays<'_>>| {
            given.as_ref().map(|vector| self.ran.vector(vector)).transpose()
        };
        let shear = vector(shear)?.map(|shear| shear.map(|part| part * self.sign));
        let even = EvenStress { bulk: *bulk, residual: self.residual.clone() };
        Ok(LoadedSurface { increment, pressure: self.ran.field(pressure)?, shear, slip: vector(slip)?, even })
    }
}

/// Puts depths and layers beside what was found there.
pub fn set_points(py: Python<'_>, items: &Bound<'_, PyDict>, points: &[DepthPoint]) -> PyResult<()> {
    items.set_item("depth", points.iter().map(|point| point.depth).collect::<Vec<_>>().into_pyarray(py))?;
    let layers: Vec<i64> = points.iter().map(|point| point.layer as i64).collect();
    items.set_item("layer", layers.into_pyarray(py))
}
