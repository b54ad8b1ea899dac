//! The active subdomain around the contact: where the iteration works, and how fields pass between it and the whole grid.

use std::borrow::Cow;
use std::ops::Range;

use ndarray::{Array2, ArrayBase, ArrayView2, Ix2, RawData, s};
use serde::{Deserialize, Serialize};

use crate::fields::TangentialField;

/// A rectangular part of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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

    /// Where a cell of the part lies on the grid.
    pub fn at(&self, cell: usize) -> [usize; 2] {
        [self.origin[0] + cell / self.shape[1], self.origin[1] + cell % self.shape[1]]
    }

    /// The part of a grid field, as flat rows.
    pub fn gather(&self, field: &Array2<f64>) -> Vec<f64> {
        let part = inside(field.view(), self.ranges()).as_standard_layout().into_owned();
        part.into_raw_vec_and_offset().0
    }

    /// The same without a copy, where the part is all of a field that lies in memory so.
    pub fn gathered<'a>(&self, field: &'a Array2<f64>) -> Cow<'a, [f64]> {
        let all = field.as_slice().filter(|_| *self == Self::whole(field.dim().into()));
        all.map_or_else(|| Cow::Owned(self.gather(field)), Cow::Borrowed)
    }

    /// Something of every cell of a grid field in the part, as flat rows.
    pub fn gather_map<T, U>(&self, field: &Array2<T>, of: impl Fn(&T) -> U) -> Vec<U> {
        inside(field.view(), self.ranges()).iter().map(of).collect()
    }

    fn ranges(&self) -> [Range<usize>; 2] {
        [0, 1].map(|axis| self.origin[axis]..self.origin[axis] + self.shape[axis])
    }

    /// The part of a grid field as it lies there.
    pub fn view<'a>(&self, field: &'a Array2<f64>) -> ArrayView2<'a, f64> {
        inside(field.view(), self.ranges())
    }

    /// With so many more cells on each side of both axes, as far as a grid of `cells` has them.
    pub fn widened(&self, by: [usize; 2], cells: [usize; 2]) -> Self {
        let origin = [0, 1].map(|axis| self.origin[axis].saturating_sub(by[axis]));
        let end = [0, 1].map(|axis| (self.origin[axis] + self.shape[axis] + by[axis]).min(cells[axis]));
        Self { origin, shape: [0, 1].map(|axis| end[axis] - origin[axis]) }
    }

    /// Its field carried over a grid by whole cells along each axis, and the region where it lies now: without what has left the grid.
    pub fn carried(&self, field: &[f64], cells: [isize; 2], grid: [usize; 2]) -> (Vec<f64>, Self) {
        let mut to = Self { origin: [0; 2], shape: [0; 2] };
        let mut first = [0; 2];
        for axis in 0..2 {
            let start = self.origin[axis] as isize + cells[axis];
            let end = (start + self.shape[axis] as isize).clamp(0, grid[axis] as isize);
            let inside = start.clamp(0, end);
            first[axis] = (inside - start) as usize;
            to.origin[axis] = inside as usize;
            to.shape[axis] = (end - inside) as usize;
        }
        let mut kept = Vec::with_capacity(to.len());
        for row in field.chunks_exact(self.shape[1].max(1)).skip(first[0]).take(to.shape[0]) {
            kept.extend_from_slice(&row[first[1]..first[1] + to.shape[1]]);
        }
        (kept, to)
    }

    /// Its field carried over by whole cells along each axis, in itself: what comes over its edge is as it is at the edge.
    pub fn carried_over_edges(&self, field: &[f64], cells: [isize; 2]) -> Vec<f64> {
        let [rows, columns] = self.shape;
        let from =
            |to: usize, by: isize, count: usize| (to as isize - by).clamp(0, count as isize - 1) as usize;
        let mut kept = Vec::with_capacity(field.len());
        for i in 0..rows {
            let row = &field[from(i, cells[0], rows) * columns..][..columns];
            kept.extend((0..columns).map(|j| row[from(j, cells[1], columns)]));
        }
        kept
    }

    /// The part of a tangential grid field.
    pub fn gather_tangential(&self, field: &[Array2<f64>; 2]) -> TangentialField {
        TangentialField { x: self.gather(&field[0]), y: self.gather(&field[1]) }
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

    /// The same part of a grid of `cells` from the field of another one, zero outside of that.
    pub fn taken(&self, (from, field): (Self, &[f64]), cells: [usize; 2]) -> Vec<f64> {
        if from == *self {
            return field.to_vec();
        }
        let mut whole = Array2::zeros(cells);
        from.place(field, &mut whole);
        self.gather(&whole)
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
fn inside<S: RawData>(field: ArrayBase<S, Ix2>, [rows, columns]: [Range<usize>; 2]) -> ArrayBase<S, Ix2> {
    field.slice_move(s![rows, columns])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 5 x 7 field whose numbers say where they stand, and the 2 x 3 region at (1, 2).
    fn field() -> (Array2<f64>, Region) {
        (
            Array2::from_shape_fn((5, 7), |(i, j)| (10 * i + j) as f64),
            Region { origin: [1, 2], shape: [2, 3] },
        )
    }

    #[test]
    fn a_part_is_taken_out_row_by_row_and_put_back_where_it_was() {
        let (grid, region) = field();
        assert_eq!(region.len(), 6);
        let part = region.gather(&grid);
        assert_eq!(part, [12.0, 13.0, 14.0, 22.0, 23.0, 24.0]);
        assert!((0..6).all(|cell| grid[region.at(cell)] == part[cell]));
        // In either order of memory.
        let turned = grid.t().as_standard_layout().into_owned().reversed_axes();
        assert_eq!(region.gather(&turned), part);
        let whole = Region::whole([5, 7]);
        assert!(matches!(whole.gathered(&grid), Cow::Borrowed(all) if all == whole.gather(&grid)));
        for (region, field) in [(whole, &turned), (region, &grid)] {
            assert_eq!(region.gathered(field), region.gather(&grid));
        }
        assert_eq!(region.gather_map(&grid, |value| *value as i32 % 10), [2, 3, 4, 2, 3, 4]);
        let both = region.gather_tangential(&[grid.clone(), -&grid]);
        assert_eq!((&both.x, both.y[5]), (&part, -24.0));
        let mut back = Array2::zeros((5, 7));
        region.place(&part, &mut back);
        for ((i, j), value) in back.indexed_iter() {
            assert_eq!(*value, if region.contains(i, j) { grid[[i, j]] } else { 0.0 });
        }
        assert_eq!(back.iter().filter(|value| **value > 0.0).count(), 6);
        // A row of zeros is left as it is: it is one already.
        let mut kept = Array2::from_elem((5, 7), 9.0);
        region.place(&[0.0, 0.0, 0.0, 1.0, 0.0, 2.0], &mut kept);
        assert_eq!(
            (kept[[1, 3]], kept[[2, 2]], kept[[2, 3]], kept[[2, 4]], kept[[2, 5]]),
            (9.0, 1.0, 0.0, 2.0, 9.0)
        );
    }

    #[test]
    fn regions_know_what_lies_inside_them() {
        let (_, region) = field();
        assert!(region.lies_within([3, 5]) && !region.lies_within([2, 5]) && !region.lies_within([3, 4]));
        assert!(!Region { shape: [0, 3], ..region }.lies_within([5, 7]));
        assert!(!Region { origin: [usize::MAX, 0], ..region }.lies_within([5, 7]));
        assert!(region.contains(1, 2) && region.contains(2, 4));
        assert!(
            !region.contains(0, 2)
                && !region.contains(3, 2)
                && !region.contains(1, 1)
                && !region.contains(1, 5)
        );
        assert!(Region::whole([5, 7]).contains_all(&region) && region.contains_all(&region));
        for other in [
            Region { origin: [0, 2], ..region },
            Region { origin: [1, 1], ..region },
            Region { shape: [3, 3], ..region },
            Region { shape: [2, 4], ..region },
        ] {
            assert!(!region.contains_all(&other), "{other:?}");
        }
    }

    #[test]
    fn a_wider_region_ends_at_the_sides_of_the_grid() {
        let (grid, region) = field();
        let wider = region.widened([1, 1], [5, 7]);
        assert_eq!(wider, Region { origin: [0, 1], shape: [4, 5] });
        assert_eq!(wider.view(&grid)[[3, 4]], 35.0);
        assert_eq!(region.widened([2, 9], [5, 7]), Region { origin: [0, 0], shape: [5, 7] });
    }

    #[test]
    fn the_extent_is_that_of_the_wanted_cells_alone() {
        let wanted = |i: usize, j: usize| [(2, 5), (3, 1), (3, 3)].contains(&(i, j));
        assert_eq!(Region::extent([6, 8], [false; 2], wanted), Some([2..4, 1..6]));
        assert_eq!(Region::extent([6, 8], [true, false], wanted), Some([0..4, 1..6]));
        assert_eq!(Region::extent([6, 8], [false; 2], |_, _| false), None);
    }

    /// A disc of radius 6 at (30, 20) on 100 x 100 cells: 13 wide, 4 more on each side, rounded up to 24.
    #[test]
    fn a_region_lies_around_the_contact_with_its_margin_and_inside_the_grid() {
        let disc = |at: [f64; 2]| move |i: usize, j: usize| (i as f64 - at[0]).hypot(j as f64 - at[1]) < 6.5;
        let good = |length: usize| length.next_multiple_of(8);
        let around = |mirrored: [bool; 2], at| Region::around([100, 100], mirrored, 4, good, disc(at));
        assert_eq!(around([false; 2], [30.0, 20.0]), Region { origin: [18, 8], shape: [24, 24] });
        // At the sides of the grid it is moved inside; what is wanted stays in it.
        assert_eq!(around([false; 2], [7.0, 92.0]), Region { origin: [0, 76], shape: [24, 24] });
        // From a mirror on there is one side: 7 cells, 4 more.
        assert_eq!(around([true, false], [0.0, 20.0]), Region { origin: [0, 8], shape: [16, 24] });
        // Where every length is good: the margin once on each side that is no mirror.
        let bare = |mirrored, at| Region::around([100, 100], mirrored, 4, |length| length, disc(at));
        assert_eq!(bare([false; 2], [30.0, 20.0]), Region { origin: [20, 10], shape: [21, 21] });
        assert_eq!(bare([true, false], [0.0, 20.0]), Region { origin: [0, 10], shape: [11, 21] });
        // Hardly smaller than the grid, or nothing wanted: the whole.
        assert_eq!(
            Region::around([25, 25], [false; 2], 4, good, disc([12.0, 12.0])),
            Region::whole([25, 25])
        );
        assert_eq!(Region::around([25, 25], [false; 2], 4, good, |_, _| false), Region::whole([25, 25]));
        assert_eq!(Region::around([27, 27], [false; 2], 4, good, disc([12.0, 12.0])).shape, [24, 24]);
    }
}
