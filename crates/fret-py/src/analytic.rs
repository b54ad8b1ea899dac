//! Closed-form solutions: those of the catalogue by their names, and the few that take or give more than numbers. `fretting.analytic` gives
//! them names.

use fret_core::analytic::{
    Branch, FORMS, Functions, Hertz, HertzLine, LineHistory, MindlinDeresiewicz, SPENCE_TABLE, Solved,
    TangentialHistory,
};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pyfunction, pymethods};
use serde_json::{Value, json};

use crate::error::bad_value;

/// `(sphere radius, force, effective modulus)`; of a cylinder, per length.
type HertzNumbers = (f64, f64, f64);

/// One closed-form solution.
#[pyclass(frozen, module = "fretting._core")]
pub struct Solution(Solved);

#[pymethods]
impl Solution {
    /// All numbers of the solution, JSON text.
    fn numbers(&self) -> PyResult<String> {
        serde_json::to_string(self.0.numbers()).map_err(bad_value)
    }

    /// A function of the solution at the points whose coordinates stand in contiguous arrays of one length.
    fn function<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        at: Vec<PyReadonlyArray1<'py, f64>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let function = self.0.function(name, at.len());
        let function = function.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let coordinates = at.iter().map(|one| Ok(one.as_slice()?)).collect::<PyResult<Vec<_>>>()?;
        let points = coordinates.first().map_or(0, |first| first.len());
        if coordinates.iter().any(|one| one.len() != points) {
            return Err(PyValueError::new_err("coordinates of different lengths"));
        }
        let mut point = vec![0.0; coordinates.len()];
        let value = |place: usize| {
            point.iter_mut().zip(&coordinates).for_each(|(to, one)| *to = one[place]);
            function(&point)
        };
        Ok((0..points).map(value).collect::<Vec<f64>>().into_pyarray(py))
    }
}

/// The catalogue of closed forms, JSON text.
#[pyfunction]
pub fn closed_forms() -> PyResult<String> {
    serde_json::to_string(FORMS).map_err(bad_value)
}

/// The solution of a closed form of the catalogue for the numbers of its parameters.
#[pyfunction]
pub fn closed_form(name: &str, given: Vec<f64>) -> PyResult<Solution> {
    let form = FORMS.iter().find(|form| form.name == name);
    let form = form.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
    form.solve(&given).map(Solution).map_err(bad_value)
}

/// Functions of a solution beside numbers of its own.
fn solution<const N: usize>(
    numbers: [(&str, Value); N],
    functions: impl Functions + Send + Sync + 'static,
) -> Solution {
    let numbers = numbers.map(|(name, value)| (name.to_owned(), value));
    Solution(Solved::with(numbers.into_iter().collect(), functions))
}

fn hertz_of((radius, force, modulus): HertzNumbers) -> PyResult<Hertz> {
    Hertz::sphere(radius, force, modulus).map_err(bad_value)
}

fn hertz_line_of((radius, line_force, modulus): HertzNumbers) -> PyResult<HertzLine> {
    HertzLine::cylinder(radius, line_force, modulus).map_err(bad_value)
}

/// Sphere pushed to and fro: the numbers of the whole loop, and the contact at its first peak.
#[pyfunction]
pub fn mindlin_deresiewicz(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    amplitude: f64,
) -> PyResult<(Solution, Solution)> {
    let fretting_loop =
        MindlinDeresiewicz::new(&hertz_of(sphere)?, friction, shear_modulus, amplitude).map_err(bad_value)?;
    let peak = Solution(Solved::of(*fretting_loop.peak()));
    Ok((solution([], fretting_loop), peak))
}

/// Sphere pushed to and fro, at a tangential force on a branch of its loop.
#[pyfunction]
pub fn mindlin_deresiewicz_at(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    amplitude: f64,
    branch: &str,
    tangential_force: f64,
) -> PyResult<Solution> {
    let branch = match branch {
        "loading" => Branch::Loading,
        "unloading" => Branch::Unloading,
        "reloading" => Branch::Reloading,
        other => {
            return Err(PyValueError::new_err(format!(
                "branch = {other:?}: must be \"loading\", \"unloading\" or \"reloading\""
            )));
        }
    };
    let point = MindlinDeresiewicz::new(&hertz_of(sphere)?, friction, shear_modulus, amplitude)
        .and_then(|fretting_loop| fretting_loop.at(branch, tangential_force))
        .map_err(bad_value)?;
    Ok(solution([], point))
}

/// Sphere pushed through any sequence of tangential forces.
#[pyfunction]
pub fn tangential_history(
    sphere: HertzNumbers,
    friction: f64,
    shear_modulus: f64,
    forces: Vec<f64>,
) -> PyResult<Solution> {
    let mut history =
        TangentialHistory::new(&hertz_of(sphere)?, friction, shear_modulus).map_err(bad_value)?;
    let mut found: [Vec<f64>; 3] = Default::default();
    for force in &forces {
        history.push(*force).map_err(bad_value)?;
        found[0].push(history.shift());
        found[1].push(history.stick_radius());
        found[2].push(history.dissipated_energy());
    }
    let [shift, stick_radius, dissipated_energy] = found;
    let numbers = [
        ("tangential_forces", json!(forces)),
        ("shift", json!(shift)),
        ("stick_radius", json!(stick_radius)),
        ("dissipated_energy", json!(dissipated_energy)),
    ];
    Ok(solution(numbers, history))
}

/// Cylinder pushed through any sequence of tangential forces per length; `datum` is its depth and what a unit force moves it by.
#[pyfunction]
pub fn line_history(
    cylinder: HertzNumbers,
    friction: f64,
    compliance: f64,
    forces: Vec<f64>,
    datum: Option<(f64, f64)>,
) -> PyResult<Solution> {
    let mut history = LineHistory::new(&hertz_line_of(cylinder)?, friction, compliance).map_err(bad_value)?;
    let mut found: [Vec<f64>; 3] = Default::default();
    for force in &forces {
        history.push(*force).map_err(bad_value)?;
        found[0].extend(datum.map(|(depth, at_datum)| history.shift(depth, at_datum)));
        found[1].push(history.stick_half_width());
        found[2].push(history.dissipated_energy());
    }
    let [shift, stick_half_width, dissipated_energy] = found;
    let numbers = [
        ("tangential_forces", json!(forces)),
        ("shift", json!(datum.map(|_| shift))),
        ("stick_half_width", json!(stick_half_width)),
        ("dissipated_energy", json!(dissipated_energy)),
    ];
    Ok(solution(numbers, history))
}

/// The table of Spence's problem, JSON text.
#[pyfunction]
pub fn spence_table() -> PyResult<String> {
    serde_json::to_string(SPENCE_TABLE).map_err(bad_value)
}
