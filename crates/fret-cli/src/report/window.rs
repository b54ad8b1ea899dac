//! The part of the grid that maps show.

use fret_drawing::{EncodingError, Raster};
use fret_results::Fields;
use ndarray::Array2;

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
    pub fn widen(&mut self, field: &Array2<f64>) {
        let seen = field.indexed_iter().filter(|(_, value)| **value != 0.0);
        seen.for_each(|(cell, _)| self.take(cell.into()));
    }

    /// Takes in a cell.
    fn take(&mut self, cell: [usize; 2]) {
        for axis in 0..2 {
            self.low[axis] = self.low[axis].min(cell[axis]);
            self.high[axis] = self.high[axis].max(cell[axis]);
        }
    }

    /// The cells with a margin around them; the whole grid where there is no contact.
    pub fn part(&self) -> Part {
        self.part_with(|_| MARGIN)
    }

    /// The same with a margin that follows from the cells of the contact along an axis.
    pub fn part_with(&self, margin: impl Fn(usize) -> usize) -> Part {
        if self.low[0] > self.high[0] {
            return Part { first: [0; 2], cells: self.grid };
        }
        let margin = [0, 1].map(|axis| margin(self.high[axis] + 1 - self.low[axis]));
        let first = [0, 1].map(|axis| self.low[axis].saturating_sub(margin[axis]));
        let end = [0, 1].map(|axis| (self.high[axis] + 1 + margin[axis]).min(self.grid[axis]));
        Part { first, cells: [end[0] - first[0], end[1] - first[1]] }
    }
}

/// A part of the grid, of which there are pictures: x to the right and y upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// First cell along each axis.
    pub first: [usize; 2],
    /// Number of cells along each axis.
    pub cells: [usize; 2],
}

impl Part {
    /// Its ends along x and y [length], of a grid whose cells have these centres along each axis.
    pub fn edges(&self, centre: impl Fn(usize, usize) -> f64, spacing: [f64; 2]) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| {
            let (first, half) = (self.first[axis], 0.5 * spacing[axis]);
            [centre(axis, first) - half, centre(axis, first + self.cells[axis] - 1) + half]
        })
    }

    /// The same on the grid of kept fields.
    pub fn edges_in(&self, fields: &Fields) -> [[f64; 2]; 2] {
        self.edges(|axis, cell| [&fields.x, &fields.y][axis][cell], fields.spacing())
    }

    /// Values of its cells in false colours from one end to the other, as an address; what is no number stays clear.
    pub fn values(&self, ends: [f64; 2], value: impl Fn([usize; 2]) -> f64) -> Result<String, EncodingError> {
        let size = Raster::pixels_for(self.cells);
        Raster::of_values(size, ends, |column, row| value(self.cell(size, [column, row]))).address()
    }

    /// Zones of its cells in their colours, as an address.
    pub fn zones(&self, zone: impl Fn([usize; 2]) -> f64) -> Result<String, EncodingError> {
        let size = Raster::pixels_for(self.cells);
        Raster::of_zones(size, |column, row| zone(self.cell(size, [column, row]))).address()
    }

    /// The cell that a pixel shows, rows from the top.
    fn cell(&self, size: [usize; 2], [column, row]: [usize; 2]) -> [usize; 2] {
        let nearest = |place: usize, axis: usize| {
            self.first[axis] + (2 * place + 1) * self.cells[axis] / (2 * size[axis])
        };
        [nearest(column, 0), nearest(size[1] - 1 - row, 1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_holds_every_contact_with_a_margin() {
        let mut field = Array2::zeros((20, 20));
        field[[5, 9]] = 1.0;
        field[[7, 19]] = 2.0;
        let mut window = Window::new([20, 20]);
        assert_eq!(window.part(), Part { first: [0, 0], cells: [20, 20] });
        window.widen(&field);
        assert_eq!(window.part(), Part { first: [3, 7], cells: [7, 13] });
    }

    #[test]
    fn a_map_stands_upright() {
        let (part, cells) = (Part { first: [3, 5], cells: [2, 3] }, [2, 3]);
        // the first pixel is the cell on the left at the top
        assert_eq!(part.cell(cells, [0, 0]), [3, 7]);
        assert_eq!(part.cell(cells, [1, 2]), [4, 5]);
        // of 400 cells on 160 pixels the first and the last are within two cells of the edges
        let many = Part { first: [0, 0], cells: [400, 400] };
        assert_eq!(many.cell([160, 160], [0, 159]), [1, 1]);
        assert_eq!(many.cell([160, 160], [159, 0]), [398, 398]);
    }
}
