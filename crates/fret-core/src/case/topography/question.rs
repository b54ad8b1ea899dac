//! Measured heights, and what they are judged with.

use std::ops::Range;

use ndarray::Array2;

use super::keys::TreatmentFile;
use crate::case::arrays::Cells;
use crate::case::judge::Judge;

/// How far the spacing of points that are to be the cells may differ from that of the cells.
pub(super) const SPACING: f64 = 1e-3;

/// Measured heights in the units of the case.
pub(in crate::case) struct Measured {
    /// Heights `[x, y]`; NaN where nothing was measured.
    pub(super) heights: Array2<f64>,
    /// Side lengths.
    pub(super) size: Option<[f64; 2]>,
    /// Places of the points of a line scan that are not evenly spaced.
    pub(super) places: Option<Vec<f64>>,
    pub(super) read_by: Option<String>,
}

impl Measured {
    /// Numbers of points along x and y.
    pub(super) fn points(&self) -> [usize; 2] {
        [self.heights.nrows(), self.heights.ncols()]
    }
}

/// What heights are judged with.
pub(in crate::case) struct Question<'a> {
    /// Key of the heights, for messages.
    pub place: &'a str,
    /// Where their source stands.
    pub span: Range<usize>,
    /// What is done to them.
    pub keys: &'a TreatmentFile,
    /// The grid.
    pub cells: Cells,
}

impl Question<'_> {
    /// Refuses the heights.
    pub(super) fn refuse<T>(&self, judge: &mut Judge, why: &str, help: &str) -> Option<T> {
        judge.refuse(self.span.clone(), format!("{}: {why}", self.place), help)
    }
}
