//! The undeformed gap between the bodies: zero at first touch, positive elsewhere.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::grid::SurfaceGrid;
use super::heights::Heights;
use super::shape::Shape;
use crate::fields::in_portions;

/// Gap where one of the bodies has ended, in diagonals of the grid: finite, so that sums stay numbers, and out of reach.
pub const BEYOND_THE_BODY: f64 = 1e6;

/// Numbers of straight passes that take as long as the gap of a cell.
const NUMBERS: usize = 20;

/// The undeformed gap: the sum of the shapes and the heights of both bodies; in a record of a run, with the summaries of the heights.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Profile<H = Heights> {
    /// Shapes by formula, each zero at the middle of the grid.
    pub shapes: Vec<Shape>,
    /// Surfaces by heights.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub heights: Vec<H>,
}

impl Default for Profile {
    fn default() -> Self {
        Self { shapes: Vec::new(), heights: Vec::new() }
    }
}

impl<H> Profile<H> {
    /// Sum of the curvatures of its paraboloids along x and y [1/length].
    pub fn curvatures(&self) -> [f64; 2] {
        let curved = self.shapes.iter().filter_map(Shape::curvatures);
        curved.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }
}

impl From<Shape> for Profile {
    fn from(shape: Shape) -> Self {
        Self { shapes: vec![shape], heights: Vec::new() }
    }
}

impl Profile {
    /// Gap of the shapes alone at a point [length]; infinite where there is no body.
    pub fn gap_of_shapes_at(&self, x: f64, y: f64) -> f64 {
        self.shapes.iter().map(|shape| shape.gap_at(x, y)).sum()
    }

    /// Undeformed gap at the cell centres [length], shape `(nx, ny)`. With heights it is counted from the cell that touches
    /// first. Where a body has ended it is [`BEYOND_THE_BODY`] diagonals of the grid.
    ///
    /// Heights of another shape than the grid's are left out; a checked case has none.
    pub fn gap(&self, grid: &SurfaceGrid) -> Array2<f64> {
        let cells = grid.cells();
        let [width, depth] = grid.size();
        let beyond = BEYOND_THE_BODY * width.hypot(depth);
        let mut gap = Array2::zeros(cells);
        let values = gap.as_slice_mut().unwrap_or_default();
        in_portions((grid.len(), NUMBERS), [values], &|cells, [gap]| {
            for (gap, cell) in gap.iter_mut().zip(cells) {
                let (i, j) = (cell / grid.cells()[1], cell % grid.cells()[1]);
                *gap = self.gap_of_shapes_at(grid.centre(0, i), grid.centre(1, j));
            }
        });
        let fitting = || self.heights.iter().filter(|heights| heights.cells() == cells);
        for heights in fitting() {
            gap += heights.depths();
        }
        if fitting().next().is_some() {
            let first = gap.iter().copied().fold(f64::INFINITY, f64::min);
            if first.is_finite() {
                gap -= first;
            }
        }
        gap.mapv_inplace(|gap| gap.min(beyond));
        gap
    }

    /// Whether the gap is the same everywhere along an axis (0: x, 1: y).
    pub fn is_straight_along(&self, axis: usize) -> bool {
        let balanced = self.curvatures()[axis] == 0.0;
        let straight =
            |shape: &Shape| shape.is_straight_along(axis) || (balanced && shape.curvatures().is_some());
        self.heights.is_empty() && self.shapes.iter().all(straight)
    }
}
