//! The undeformed gap between the bodies: zero at first touch, positive elsewhere.

use ndarray::{Array2, CowArray, Ix2};
use serde::{Deserialize, Serialize};

use super::grid::SurfaceGrid;
use super::heights::Heights;
use super::kinematics::{Motion, Place};
use super::shape::Shape;
use crate::fields::{Outside, carried_by_whole_cells, in_portions};

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
    /// How many of the shapes and of the heights, the first ones, are the upper body's; those of the gap are, too.
    #[serde(skip)]
    pub of_upper: [usize; 2],
}

impl Default for Profile {
    fn default() -> Self {
        Self { shapes: Vec::new(), heights: Vec::new(), of_upper: [0; 2] }
    }
}

/// Depths of heights [length], as they are or carried.
fn depths(heights: &Heights, carried: Option<([isize; 2], Outside)>) -> CowArray<'_, f64, Ix2> {
    match carried {
        None => heights.depths().into(),
        Some((by, outside)) => carried_by_whole_cells(heights.depths(), by, (outside, 0.0)).into(),
    }
}

/// The gap where a body has ended [length].
fn beyond(grid: &SurfaceGrid) -> f64 {
    let [width, depth] = grid.size();
    BEYOND_THE_BODY * width.hypot(depth)
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
        Self { shapes: vec![shape], heights: Vec::new(), of_upper: [1, 0] }
    }
}

impl Profile {
    /// Gap of the shapes alone at a point [length]; infinite where there is no body.
    pub fn gap_of_shapes_at(&self, x: f64, y: f64) -> f64 {
        self.shapes.iter().map(|shape| shape.gap_at(x, y)).sum()
    }

    /// Whether it may be lowest anywhere, so that it is counted from where it touches first: with heights on a grid of `cells`, or a formula.
    fn is_lowest_anywhere(&self, cells: [usize; 2]) -> bool {
        let by_formula = self.shapes.iter().any(|shape| matches!(shape, Shape::Formula(_)));
        by_formula || self.heights.iter().any(|heights| heights.cells() == cells)
    }

    /// A cell centre at which a formula has no finite value, or the middle of the grid, where there is one.
    pub fn undefined_on(&self, grid: &SurfaceGrid) -> Option<[f64; 2]> {
        self.shapes.iter().find_map(|shape| match shape {
            Shape::Formula(formula) => formula.undefined_on(grid),
            _ => None,
        })
    }

    /// Gap of the shapes in the middle of the grid [length], which no cell need lie in; of heights there is none between cells.
    fn middle(&self) -> f64 {
        if self.heights.is_empty() { self.gap_of_shapes_at(0.0, 0.0) } else { f64::INFINITY }
    }

    /// Undeformed gap at the cell centres [length], shape `(nx, ny)`. With heights it is counted from the cell that touches
    /// first, with a formula from the lowest value at a cell or in the middle of the grid. Where a body has ended it is [`BEYOND_THE_BODY`] diagonals of the grid.
    ///
    /// Heights of another shape than the grid's are left out; a checked case has none.
    pub fn gap(&self, grid: &SurfaceGrid) -> Array2<f64> {
        let cells = grid.cells();
        let mut gap = self.sum(grid, None);
        let first = if self.is_lowest_anywhere(cells) {
            gap.iter().copied().fold(self.middle(), f64::min)
        } else {
            0.0
        };
        let (first, beyond) = (if first.is_finite() { first } else { 0.0 }, beyond(grid));
        gap.mapv_inplace(|gap| (gap - first).min(beyond));
        gap
    }

    /// Sum of the shapes and of the heights at the cell centres [length]; of heights that have been `carried` by whole cells along each axis, with what
    /// lies beyond them, where they have.
    fn sum(&self, grid: &SurfaceGrid, carried: Option<([isize; 2], Outside)>) -> Array2<f64> {
        let mut fitting = self.heights.iter().filter(|heights| heights.cells() == grid.cells());
        let alone = if self.shapes.is_empty() { fitting.next() } else { None };
        let mut sum = match alone {
            Some(heights) => depths(heights, carried).as_standard_layout().into_owned(),
            None => self.sum_of_shapes(grid),
        };
        for heights in fitting {
            sum += &depths(heights, carried);
        }
        sum
    }

    /// The same of the shapes alone [length].
    fn sum_of_shapes(&self, grid: &SurfaceGrid) -> Array2<f64> {
        let mut sum = Array2::zeros(grid.cells());
        let values = sum.as_slice_mut().unwrap_or_default();
        in_portions((grid.len(), NUMBERS), [values], &|cells, [sum]| {
            for (sum, cell) in sum.iter_mut().zip(cells) {
                let (i, j) = (cell / grid.cells()[1], cell % grid.cells()[1]);
                *sum = self.gap_of_shapes_at(grid.centre(0, i), grid.centre(1, j));
            }
        });
        sum
    }

    /// The undeformed gap where the upper body lies at a place, counted from where it touches first without a shift: its
    /// shapes are taken at their places, its heights carried. Where nothing is known of them the gap is that without a
    /// body. `repeats`: the surfaces do.
    pub fn gap_with_upper_at(&self, grid: &SurfaceGrid, place: Place, repeats: bool) -> Array2<f64> {
        if place == Place::default() {
            return self.gap(grid);
        }
        let mut gap = Array2::zeros(grid.cells());
        let is_counted = self.is_lowest_anywhere(grid.cells());
        let first = if is_counted { self.first_touch(grid) } else { 0.0 };
        let [of_upper, heights_of_upper] = self.of_upper;
        let seen = SeenByUpper::of(grid, place, repeats);
        let values = gap.as_slice_mut().unwrap_or_default();
        in_portions((grid.len(), NUMBERS), [values], &|portion, [gap]| {
            for (gap, cell) in gap.iter_mut().zip(portion) {
                let (i, j) = (cell / grid.cells()[1], cell % grid.cells()[1]);
                let (upper, lower) = self.shapes.split_at(of_upper.min(self.shapes.len()));
                let ([x, y], _) = seen.at(i, j);
                let upper = upper.iter().map(|shape| shape.gap_at(x, y));
                let lower = lower.iter().map(|shape| shape.gap_at(grid.centre(0, i), grid.centre(1, j)));
                *gap = upper.chain(lower).sum();
            }
        });
        let outside = if repeats { Outside::Repeats } else { Outside::Edge };
        for (number, heights) in self.heights.iter().enumerate() {
            if heights.cells() != grid.cells() {
                continue;
            }
            if number >= heights_of_upper {
                gap += heights.depths();
                continue;
            }
            gap += &Motion::over(grid).over_grid(place).of(heights.depths(), outside);
            for ((i, j), gap) in gap.indexed_iter_mut() {
                if !seen.at(i, j).1 {
                    *gap = f64::INFINITY;
                }
            }
        }
        if is_counted && first.is_finite() {
            gap -= first;
        }
        gap.mapv_inplace(|gap| gap.min(beyond(grid)));
        gap
    }

    /// What of it is the upper body's.
    #[must_use]
    pub fn of_upper_body(&self) -> Self {
        let [shapes, heights] = self.of_upper;
        let shapes = self.shapes.iter().take(shapes).cloned().collect();
        Self {
            shapes,
            heights: self.heights.iter().take(heights).cloned().collect(),
            of_upper: self.of_upper,
        }
    }

    /// The undeformed gap where the contact has rolled by `cells` along each axis: paraboloids have gone along, waves and heights, which belong to
    /// places of the surfaces, stay.
    pub fn gap_rolled(&self, grid: &SurfaceGrid, cells: [f64; 2]) -> Array2<f64> {
        let (rolling, fixed) = self.shapes.iter().cloned().partition(|shape| shape.curvatures().is_some());
        let (rolling, fixed): (Vec<Shape>, Vec<Shape>) = (rolling, fixed);
        let of_upper = [rolling.len(), 0];
        let shapes = rolling.into_iter().chain(fixed).collect();
        Self { shapes, heights: self.heights.clone(), of_upper }.gap_with_upper_at(
            grid,
            Place::shifted(cells),
            false,
        )
    }

    /// The undeformed gap on a grid that has gone with a contact by so many whole cells along each axis: paraboloids have gone along, heights, which
    /// belong to places of the surfaces, lie so many cells behind. `outside`: what lies beyond them.
    pub fn gap_passed(&self, grid: &SurfaceGrid, cells: [isize; 2], outside: Outside) -> Array2<f64> {
        let mut gap = self.sum(grid, Some((cells.map(|cells| -cells), outside)));
        if self.is_lowest_anywhere(grid.cells()) {
            let first = self.first_touch(grid);
            if first.is_finite() {
                gap -= first;
            }
        }
        gap.mapv_inplace(|gap| gap.min(beyond(grid)));
        gap
    }

    /// Lowest sum of shapes and heights of a cell, or in the middle [length].
    fn first_touch(&self, grid: &SurfaceGrid) -> f64 {
        self.sum(grid, None).into_iter().fold(self.middle(), f64::min)
    }

    /// Whether the gap is the same everywhere along an axis (0: x, 1: y).
    pub fn is_straight_along(&self, axis: usize) -> bool {
        let balanced = self.curvatures()[axis] == 0.0;
        let straight =
            |shape: &Shape| shape.is_straight_along(axis) || (balanced && shape.curvatures().is_some());
        self.heights.is_empty() && self.shapes.iter().all(straight)
    }
}

/// The cell centres as an upper body sees them that lies at a place.
struct SeenByUpper<'a> {
    grid: &'a SurfaceGrid,
    /// Along each axis, before the turn.
    axes: [Vec<Seen>; 2],
    turned: f64,
}

/// A cell centre along an axis, as the upper body sees it.
struct Seen {
    /// Its coordinate [length].
    at: f64,
    /// Whether the cells of the upper body that lie over the cell are on the grid, where it lies without a shift.
    is_known: bool,
}

impl<'a> SeenByUpper<'a> {
    fn of(grid: &'a SurfaceGrid, place: Place, repeats: bool) -> Self {
        let axes = [0, 1].map(|axis| shifted(grid, axis, place.cells[axis], repeats));
        Self { grid, axes, turned: place.turned }
    }

    /// Coordinates of a cell centre [length], and whether what lies over it is known.
    fn at(&self, i: usize, j: usize) -> ([f64; 2], bool) {
        let [x, y] = [&self.axes[0][i], &self.axes[1][j]];
        if self.turned == 0.0 {
            return ([x.at, y.at], x.is_known && y.is_known);
        }
        let (sine, cosine) = self.turned.sin_cos();
        let at = [cosine * x.at + sine * y.at, cosine * y.at - sine * x.at];
        let is_known = (0..2).all(|axis| {
            let half = (self.grid.cells()[axis] as f64 - 1.0) / 2.0;
            at[axis].abs() <= (half + ROUNDING) * self.grid.spacing()[axis]
        });
        (at, is_known)
    }
}

/// So much of a cell is rounding of a turn.
const ROUNDING: f64 = 1e-9;

/// The cell centres along an axis as an upper body sees them that lies `cells` further.
fn shifted(grid: &SurfaceGrid, axis: usize, cells: f64, repeats: bool) -> Vec<Seen> {
    let count = grid.cells()[axis] as f64;
    let middle = (count - 1.0) / 2.0;
    let place = |index: usize| {
        let seen = index as f64 - cells;
        let is_known = repeats || cells == 0.0 || seen.floor() >= 0.0 && seen.ceil() <= count - 1.0;
        let seen = if repeats { (seen + 0.5).rem_euclid(count) - 0.5 } else { seen };
        Seen { at: (seen - middle) * grid.spacing()[axis], is_known }
    };
    (0..grid.cells()[axis]).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Detrend;

    /// Moved by whole cells the gap is that of its own cells further on, to the bit; that of the lower body stays.
    #[test]
    fn the_upper_profile_moves_and_the_lower_one_stays() {
        let grid = SurfaceGrid::new([9, 7], [0.1, 0.2]).unwrap();
        let heights = |seed: usize| {
            let rough = Array2::from_shape_fn((9, 7), |(i, j)| ((i * 7 + j * 3 + seed) % 11) as f64 / 97.0);
            Heights::new("rough", rough, Detrend::None).unwrap()
        };
        let [ball, bed] = [Shape::Sphere { radius: 2.0 }, Shape::Sphere { radius: -5.0 }];
        let profile = Profile {
            shapes: vec![ball.clone(), bed.clone()],
            heights: vec![heights(1), heights(5)],
            of_upper: [1, 1],
        };
        assert_eq!(profile.gap_with_upper_at(&grid, Place::default(), false), profile.gap(&grid));
        let of = |shape: Shape, heights: Heights| Profile {
            shapes: vec![shape],
            heights: vec![heights],
            of_upper: [1, 1],
        };
        let upper = of(ball, heights(1));
        let moved = upper.gap_with_upper_at(&grid, Place::shifted([2.0, -1.0]), false);
        let still = upper.gap(&grid);
        for ((i, j), gap) in moved.indexed_iter() {
            match i.checked_sub(2).and_then(|i| still.get((i, j + 1))) {
                Some(there) => assert_eq!(gap, there),
                None => assert!(*gap > 1e5),
            }
        }
        // the sum of both, less the first touch of it without a shift
        let lower = Profile { of_upper: [0, 0], ..of(bed, heights(5)) };
        let both = profile.gap_with_upper_at(&grid, Place::shifted([2.0, -1.0]), false);
        let [one, other] = [&upper, &lower]
            .map(|profile| profile.gap_with_upper_at(&grid, Place::shifted([2.0, -1.0]), false));
        let less = one[[4, 3]] + other[[4, 3]] - both[[4, 3]];
        for ((i, j), gap) in both.indexed_iter().filter(|(_, gap)| **gap < 1e3) {
            assert!((one[[i, j]] + other[[i, j]] - less - gap).abs() < 1e-14);
        }
        // Repeated, nothing is unknown.
        assert!(
            profile.gap_with_upper_at(&grid, Place::shifted([2.3, -1.0]), true).iter().all(|gap| *gap < 10.0)
        );
    }
}
