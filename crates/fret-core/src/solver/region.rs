//! The active subdomain around the contact: where the iteration works, and how fields pass between it and the whole grid.

use std::ops::Range;

use ndarray::{Array2, ArrayBase, Ix2, RawData, s};
use serde::{Deserialize, Serialize};

use crate::fields::TangentialField;

/// A rectangular part of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[expect(clippy::unsafe_derive_deserialize, reason = "the unsafe part is inside ndarray's slicing macro")]
pub struct Region {
    /// First cell.
    pub origin: [usize; 2],
    /// Number of cells.
    pub shape: [usize; 2],
}

impl Region {
    /// The whole grid.
    pub fn whole(cells: [usize; 2]) -> Self {
        Self { origin: [0, 0], shape: cells }
    }

    /// Whether this is a part of a grid of `cells`.
    pub fn lies_within(&self, cells: [usize; 2]) -> bool {
        (0..2).all(|axis| {
            self.shape[axis] > 0
                && self.origin[axis].checked_add(self.shape[axis]).is_some_and(|end| end <= cells[axis])
        })
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// The part of a grid field, as flat rows.
    pub fn gather(&self, field: &Array2<f64>) -> Vec<f64> {
        let part = inside(field.view(), self.ranges()).as_standard_layout().into_owned();
        part.into_raw_vec_and_offset().0
    }

    /// Something of every cell of a grid field in the part, as flat rows.
    pub fn gather_map<T, U>(&self, field: &Array2<T>, of: impl Fn(&T) -> U) -> Vec<U> {
        let [rows, columns] = self.ranges();
        field.slice(s![rows, columns]).iter().map(of).collect()
    }

    fn ranges(&self) -> [Range<usize>; 2] {
        [0, 1].map(|axis| self.origin[axis]..self.origin[axis] + self.shape[axis])
    }

    /// The part of a tangential grid field.
    pub fn gather_tangential(&self, field: &[Array2<f64>; 2]) -> TangentialField {
        TangentialField { x: self.gather(&field[0]), y: self.gather(&field[1]) }
    }

    /// Writes the part into a grid field that is zero elsewhere.
    pub fn scatter(&self, part: &[f64], field: &mut Array2<f64>) {
        field.fill(0.0);
        self.place(part, field);
    }

    /// Writes what is not zero of the part into a grid field of zeros: memory that nobody wrote to costs nothing.
    pub fn place(&self, part: &[f64], field: &mut Array2<f64>) {
        let mut inside = inside(field.view_mut(), self.ranges());
        for (line, row) in inside.rows_mut().into_iter().zip(part.chunks_exact(self.shape[1])) {
            if row.iter().any(|value| *value != 0.0) {
                for (place, value) in line.into_iter().zip(row) {
                    *place = *value;
                }
            }
        }
    }

    /// Whether a cell of the grid lies inside.
    pub fn contains(&self, i: usize, j: usize) -> bool {
        let [rows, columns] = self.ranges();
        rows.contains(&i) && columns.contains(&j)
    }

    /// Whether another region lies inside.
    pub fn contains_all(&self, other: &Self) -> bool {
        (0..2).all(|axis| {
            self.origin[axis] <= other.origin[axis]
                && other.origin[axis] + other.shape[axis] <= self.origin[axis] + self.shape[axis]
        })
    }

    /// Rows and columns of all cells where `wanted`, from the mirror on along a mirrored axis; `None` when there are none.
    pub fn extent(
        cells: [usize; 2],
        mirrored: [bool; 2],
        wanted: impl Fn(usize, usize) -> bool,
    ) -> Option<[Range<usize>; 2]> {
        let mut low = [usize::MAX; 2];
        let mut high = [0_usize; 2];
        for i in 0..cells[0] {
            let is_wanted = |j: &usize| wanted(i, *j);
            if let Some(first) = (0..cells[1]).find(is_wanted) {
                let last = (first..cells[1]).rfind(is_wanted).unwrap_or(first);
                low = [low[0].min(i), low[1].min(first)];
                high = [i, high[1].max(last)];
            }
        }
        (low[0] < usize::MAX)
            .then(|| [0, 1].map(|axis| if mirrored[axis] { 0 } else { low[axis] }..high[axis] + 1))
    }

    /// The smallest region around all cells where `wanted`, with a `margin` of cells on each side, its sides rounded up by
    /// `good_length`; the whole grid when that is hardly larger, or when nothing is wanted. Along a mirrored axis it begins at the
    /// mirror.
    pub fn around(
        cells: [usize; 2],
        mirrored: [bool; 2],
        margin: usize,
        good_length: impl Fn(usize) -> usize,
        wanted: impl Fn(usize, usize) -> bool,
    ) -> Self {
        let Some(extent) = Self::extent(cells, mirrored, wanted) else { return Self::whole(cells) };
        let mut region = Self::whole(cells);
        for axis in 0..2 {
            let sides = if mirrored[axis] { 1 } else { 2 };
            let shape = good_length(extent[axis].len() + sides * margin);
            if shape as f64 > 0.93 * cells[axis] as f64 {
                continue;
            }
            if mirrored[axis] {
                region.shape[axis] = shape;
                continue;
            }
            // Centred on what is wanted, moved inside where it would stick out.
            let middle = (extent[axis].start + extent[axis].end - 1).div_ceil(2);
            region.origin[axis] = middle.saturating_sub(shape / 2).min(cells[axis] - shape);
            region.shape[axis] = shape;
        }
        region
    }
}

/// The part of a view in these rows and columns.
fn inside<S: RawData<Elem = f64>>(
    field: ArrayBase<S, Ix2>,
    [rows, columns]: [Range<usize>; 2],
) -> ArrayBase<S, Ix2> {
    field.slice_move(s![rows, columns])
}
