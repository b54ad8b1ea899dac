//! The part of the grid that maps of the page show: the contact with some room around it.

use fret_core::model::SurfaceGrid;
use ndarray::Array2;

use crate::drawing::raster::pixels_for;
use crate::report::Window;

/// Room around the contact in a picture, over its width.
pub const ROOM: f64 = 0.12;

/// The part that is shown.
pub struct Part {
    first: [usize; 2],
    cells: [usize; 2],
    /// Pixels along x and y.
    pub size: [usize; 2],
    /// Its ends along x and y [length].
    pub edges: [[f64; 2]; 2],
}

impl Part {
    /// The part around the contact.
    pub fn of(grid: &SurfaceGrid, pressure: &Array2<f64>) -> Self {
        let mut window = Window::new(grid.cells());
        let touching = pressure.indexed_iter().filter(|(_, pressure)| **pressure > 0.0);
        touching.for_each(|((i, j), _)| window.take([i, j]));
        let (first, cells) = window.cells_with(|wide| (ROOM * wide as f64).ceil() as usize);
        let edges = [0, 1].map(|axis| {
            let half = 0.5 * grid.spacing()[axis];
            let last = first[axis] + cells[axis] - 1;
            [grid.centre(axis, first[axis]) - half, grid.centre(axis, last) + half]
        });
        Self { first, cells, size: cells.map(pixels_for), edges }
    }

    /// The cell that a pixel shows, rows from the top.
    pub fn cell(&self, column: usize, row: usize) -> [usize; 2] {
        crate::report::cell_of_pixel(self.first, self.cells, self.size, [column, row])
    }
}
