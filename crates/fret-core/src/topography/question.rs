//! Measured heights, and what they are judged with.

use ndarray::Array2;

use super::cells::Cells;
use super::keys::TreatmentFile;
use crate::model::Dimension;
use crate::units::Units;

/// How far the spacing of points that are to be the cells may differ from that of the cells.
pub const SPACING: f64 = 1e-3;

/// Measured heights in the units of the case.
pub struct Measured {
    /// Heights `[x, y]`; NaN where nothing was measured.
    pub heights: Array2<f64>,
    /// Side lengths.
    pub size: Option<[f64; 2]>,
    /// Places of the points of a line scan that are not evenly spaced.
    pub places: Option<Vec<f64>>,
    /// Who read the file, its format and its channel, in words.
    pub read_by: Option<String>,
}

impl Measured {
    /// Numbers of points along x and y.
    pub fn points(&self) -> [usize; 2] {
        [self.heights.nrows(), self.heights.ncols()]
    }
}

/// What heights are judged with.
pub struct Question<'a> {
    /// What is done to them.
    pub keys: &'a TreatmentFile,
    /// The grid.
    pub cells: Cells,
    /// Units that the case declares.
    pub units: Option<&'a Units>,
}

impl Question<'_> {
    /// Whether the contact has two axes or is a line contact.
    pub fn dimension(&self) -> Dimension {
        Dimension::of(self.cells.count)
    }
}
