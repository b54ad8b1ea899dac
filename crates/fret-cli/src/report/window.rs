//! The part of the grid that maps show, and the line through it that sections follow.

use super::overview::Overview;
use fret_core::model::Dimension;
use fret_results::{Field, Fields};

/// Cells around the contact that are shown.
const MARGIN: usize = 2;

/// The part of the grid that maps show: first cell and number of cells along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    grid: [usize; 2],
    low: [usize; 2],
    high: [usize; 2],
}

impl Window {
    /// No cell yet.
    pub fn new(grid: [usize; 2]) -> Self {
        Self { grid, low: grid, high: [0; 2] }
    }

    /// Takes in all cells of a field that are not zero.
    pub fn widen(&mut self, field: &Field) {
        for i in 0..self.grid[0] {
            for j in 0..self.grid[1] {
                if field.at(i, j) != 0.0 {
                    self.take([i, j]);
                }
            }
        }
    }

    /// Takes in a cell.
    pub fn take(&mut self, cell: [usize; 2]) {
        for axis in 0..2 {
            self.low[axis] = self.low[axis].min(cell[axis]);
            self.high[axis] = self.high[axis].max(cell[axis]);
        }
    }

    /// First cell and number of cells along each axis, with a margin; the whole grid where there is no contact.
    pub fn cells(&self) -> ([usize; 2], [usize; 2]) {
        self.cells_with(|_| MARGIN)
    }

    /// The same with a margin that follows from the cells of the contact along an axis.
    pub fn cells_with(&self, margin: impl Fn(usize) -> usize) -> ([usize; 2], [usize; 2]) {
        if self.low[0] > self.high[0] {
            return ([0; 2], self.grid);
        }
        let margin = [0, 1].map(|axis| margin(self.high[axis] + 1 - self.low[axis]));
        let first = [0, 1].map(|axis| self.low[axis].saturating_sub(margin[axis]));
        let end = [0, 1].map(|axis| (self.high[axis] + 1 + margin[axis]).min(self.grid[axis]));
        (first, [end[0] - first[0], end[1] - first[1]])
    }

    /// Its ends along x and y [length].
    pub fn edges(&self, fields: &Fields) -> [[f64; 2]; 2] {
        let ((first, cells), spacing) = (self.cells(), fields.spacing());
        [0, 1].map(|axis| {
            let centres = [&fields.x, &fields.y][axis];
            let half = 0.5 * spacing[axis];
            [centres[first[axis]] - half, centres[first[axis] + cells[axis] - 1] + half]
        })
    }
}

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
    pub fn values(&self, field: &Field) -> Vec<f64> {
        let at = |k: usize| if self.upright { field.at(self.line, k) } else { field.at(k, self.line) };
        (0..self.along.len()).map(at).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_holds_every_contact_with_a_margin() {
        let mut field = Field { cells: [20, 20], values: vec![0.0; 400] };
        field.values[5 * 20 + 9] = 1.0;
        field.values[7 * 20 + 19] = 2.0;
        let mut window = Window::new([20, 20]);
        assert_eq!(window.cells(), ([0, 0], [20, 20]));
        window.widen(&field);
        assert_eq!(window.cells(), ([3, 7], [7, 13]));
    }
}
