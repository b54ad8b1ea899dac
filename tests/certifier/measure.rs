//! Deviations in their units, and the worst of many.

use ndarray::Array2;

/// A worst value so far.
pub(super) trait Raise {
    /// Takes the larger one; what is not a number stays.
    fn raise(&mut self, value: f64);
}

impl Raise for f64 {
    fn raise(&mut self, value: f64) {
        if value.is_nan() || value.abs() > *self {
            *self = value.abs();
        }
    }
}

/// A deviation in its unit; none at all where the unit is nothing as well.
pub(super) fn over(deviation: f64, unit: f64) -> f64 {
    if deviation == 0.0 { 0.0 } else { (deviation / unit).abs() }
}

pub(super) fn size(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| value.abs().max(most))
}

pub(super) fn largest(field: &Array2<f64>) -> f64 {
    field.iter().fold(0.0, |most, value| value.abs().max(most))
}

pub(super) fn hypot([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
