//! Samples of uncertain numbers, and what they say.

use fret_core::uncertainty::{self, Distribution, QUANTILES, SampleDesign};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::{Bound, PyResult, Python, pyfunction};

use crate::error::bad_value;

/// The rows of a design given as JSON text.
#[pyfunction]
pub fn sample_rows(design: &str) -> PyResult<Vec<Vec<f64>>> {
    let design: SampleDesign = serde_json::from_str(design).map_err(bad_value)?;
    for distribution in &design.distributions {
        distribution.checked().map_err(bad_value)?;
    }
    design.rows().map_err(bad_value)
}

/// Mean and standard deviation of distributions given as JSON text.
#[pyfunction]
pub fn moments(distributions: &str) -> PyResult<Vec<[f64; 2]>> {
    let distributions: Vec<Distribution> = serde_json::from_str(distributions).map_err(bad_value)?;
    let of = |distribution: Distribution| distribution.checked().map(|checked| checked.moments());
    distributions.into_iter().map(|distribution| of(distribution).map_err(bad_value)).collect()
}

/// Standard deviation to first order from derivatives and standard deviations of numbers, and the fraction of the variance of each.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python gives them")]
pub fn first_order(derivatives: Vec<f64>, deviations: Vec<f64>) -> (f64, Vec<f64>) {
    let found = uncertainty::first_order(&derivatives, &deviations);
    (found.deviation, found.fractions)
}

/// Fractions of the quantiles that [`statistics`] gives.
#[pyfunction]
pub fn quantile_fractions() -> [f64; 5] {
    QUANTILES
}

/// Mean, standard deviation, least and largest value, quantiles; not numbers where there are fewer than two.
#[pyfunction]
pub fn statistics<'py>(py: Python<'py>, values: PyReadonlyArray1<'py, f64>) -> Bound<'py, PyArray1<f64>> {
    let found = uncertainty::statistics(&values.as_array().to_vec());
    let numbers = found.map_or([f64::NAN; 9], |found| {
        let [a, b, c, d, e] = found.quantiles;
        [found.mean, found.deviation, found.min, found.max, a, b, c, d, e]
    });
    numbers.to_vec().into_pyarray(py)
}

/// First-order and total indices of every number, in turn; not numbers where there are none.
#[pyfunction]
pub fn sobol_indices<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    count: usize,
) -> Bound<'py, PyArray1<f64>> {
    let values = values.as_array().to_vec();
    let numbers = (values.len() / count.max(1)).saturating_sub(2);
    let found = uncertainty::sensitivity(&values, count.max(1));
    let flat = found.map_or(vec![f64::NAN; 2 * numbers], |found| {
        found.iter().flat_map(|index| [index.first, index.total]).collect()
    });
    flat.into_pyarray(py)
}
