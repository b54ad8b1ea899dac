//! The mesh of the potential contact area: uniform rectangular cells, centred on the first point of touch.

use ndarray::Array1;
use serde::{Deserialize, Serialize};

use super::dimension::Dimension;

/// A uniform grid of `cells[0] x cells[1]` rectangular cells. Fields on it have shape `(nx, ny)`, index `[i, j]` = `[x, y]`.
///
/// A grid of `n x 1` cells is that of a line contact: strips that reach to infinity along y. Its areas, forces and energies are
/// those of a unit of length along y, and the second of its sides repeats the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SurfaceGrid {
    cells: [usize; 2],
    spacing: [f64; 2],
}

/// Why a grid was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum GridError {
    /// No cells along an axis.
    #[error("cells = [{0}, {1}]: each side needs at least one cell")]
    NoCells(usize, usize),
    /// A spacing that is not a positive finite length.
    #[error("cell sides {0} x {1}: must be positive finite lengths")]
    Spacing(f64, f64),
}

impl SurfaceGrid {
    /// Grid from the number of cells and the side lengths of one cell [length].
    ///
    /// # Errors
    /// When a count is zero or a side is not a positive finite length.
    pub fn new(cells: [usize; 2], spacing: [f64; 2]) -> Result<Self, GridError> {
        if cells.contains(&0) {
            return Err(GridError::NoCells(cells[0], cells[1]));
        }
        if spacing.iter().any(|side| !(side.is_finite() && *side > 0.0)) {
            return Err(GridError::Spacing(spacing[0], spacing[1]));
        }
        let spacing = if cells[1] == 1 { [spacing[0]; 2] } else { spacing };
        Ok(Self { cells, spacing })
    }

    /// Grid of a line contact from the number of its strips and their width [length].
    ///
    /// # Errors
    /// As [`SurfaceGrid::new`].
    pub fn line(strips: usize, width: f64) -> Result<Self, GridError> {
        Self::new([strips, 1], [width; 2])
    }

    /// Whether its cells are those of an area or strips.
    pub fn dimension(&self) -> Dimension {
        Dimension::of(self.cells)
    }

    /// Whether it is the grid of a line contact.
    pub fn is_line(&self) -> bool {
        self.dimension() == Dimension::Line
    }

    /// Number of cells `[nx, ny]`.
    pub fn cells(&self) -> [usize; 2] {
        self.cells
    }

    /// Sides of one cell `[dx, dy]` [length].
    pub fn spacing(&self) -> [f64; 2] {
        self.spacing
    }

    /// Sides of the whole grid [length].
    pub fn size(&self) -> [f64; 2] {
        [self.cells[0] as f64 * self.spacing[0], self.cells[1] as f64 * self.spacing[1]]
    }

    /// Area of one cell [length^2]; of a line contact, of a unit of its length [length].
    pub fn cell_area(&self) -> f64 {
        self.dimension().cell_area(self.spacing)
    }

    /// Number of all cells.
    pub fn len(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// Never true: a grid has cells.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Coordinate of the centre of the `index`-th cell along `axis` [length]: `(i - (n-1)/2) d`.
    pub fn centre(&self, axis: usize, index: usize) -> f64 {
        (index as f64 - (self.cells[axis] as f64 - 1.0) / 2.0) * self.spacing[axis]
    }

    /// Coordinates of all cell centres along `axis` [length].
    pub fn centres(&self, axis: usize) -> Array1<f64> {
        (0..self.cells[axis]).map(|index| self.centre(axis, index)).collect()
    }
}

/// Side lengths of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GridSize {
    /// Given [length]; of a line contact, the length and the width of one strip.
    Given([f64; 2]),
    /// Chosen so that the largest contact of the history fits with a margin.
    Auto,
}

impl GridSize {
    /// The side lengths, where they are given.
    pub fn given(self) -> Option<[f64; 2]> {
        match self {
            Self::Given(sides) => Some(sides),
            Self::Auto => None,
        }
    }
}
