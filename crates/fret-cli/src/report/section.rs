//! The line through the contact that sections follow.

use super::{Measured, Overview};
use crate::failure::Failure;
use fret_core::model::Dimension;
use fret_results::Fields;
use ndarray::Array2;

/// A line of cells through the middle of the grid, along the load.
#[derive(Debug)]
pub struct Section {
    /// Whether it runs along y.
    pub upright: bool,
    /// Cell centres along it [length].
    pub along: Vec<f64>,
    /// Where it lies across.
    across: f64,
    line: usize,
}

impl Section {
    /// The section of a run.
    pub fn of(view: &Overview<'_>) -> Self {
        let fields = &view.results.fields;
        let upright =
            view.direction.is_some_and(|[x, y]| y.abs() > x.abs()) && view.dimension() == Dimension::Plane;
        let (along, other) = if upright { (&fields.y, &fields.x) } else { (&fields.x, &fields.y) };
        let line = other.len() / 2;
        Self { upright, along: along.clone(), across: other[line], line }
    }

    /// Values of a field along it.
    pub fn values(&self, field: &Array2<f64>) -> Vec<f64> {
        if self.upright { field.row(self.line) } else { field.column(self.line) }.to_vec()
    }

    /// Shear along a direction, at a position among the kept increments.
    pub fn shear(
        &self,
        fields: &Fields,
        position: usize,
        [cosine, sine]: [f64; 2],
    ) -> Result<Vec<f64>, Failure> {
        let parts = [fields.field("shear_x", position)?, fields.field("shear_y", position)?];
        let [x, y] = parts.map(|part| self.values(&part));
        Ok(x.iter().zip(&y).map(|(x, y)| cosine * x + sine * y).collect())
    }

    /// Points of some of its cells as a curve.
    pub fn points(&self, [first, last]: [usize; 2], value: impl Fn(usize) -> f64) -> Vec<[f64; 2]> {
        (first..=last).map(|k| [self.along[k], value(k)]).collect()
    }

    /// Where a place along it lies on the surface.
    pub fn point(&self, s: f64) -> [f64; 2] {
        if self.upright { [self.across, s] } else { [s, self.across] }
    }

    /// The axis that it follows.
    pub fn name(&self) -> &'static str {
        if self.upright { "y" } else { "x" }
    }
}
