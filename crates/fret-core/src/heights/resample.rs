//! Heights of the cells of a grid from those of measured points.

use std::ops::Range;

use ndarray::{Array2, Axis};

/// The points that count for a cell along an axis: the first of them, and their weights.
struct Weights {
    first: usize,
    of: Vec<f64>,
}

/// Places of points along an axis, growing.
pub fn even(count: usize, spacing: f64) -> Vec<f64> {
    (0..count).map(|point| (point as f64 + 0.5) * spacing).collect()
}

/// A measured surface, and the part of it that a grid covers, however many cells that has.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSurface {
    /// Heights of the points, index `[x, y]`.
    pub heights: Array2<f64>,
    /// Places of the points along x and y, growing.
    pub places: [Vec<f64>; 2],
    /// From where to where the grid lies along x and y.
    pub window: [Range<f64>; 2],
    /// Whether the window is a period of the surface along x and y, which goes on at its other end.
    pub repeats: [bool; 2],
}

impl MeasuredSurface {
    /// Mean height of each of so many cells along x and y.
    pub fn on(&self, cells: [usize; 2]) -> Array2<f64> {
        resampled(&self.heights, [&self.places[0], &self.places[1]], (&self.window, self.repeats), cells)
    }

    /// Whether cells are finer than the points, between which the surface is straight.
    pub fn is_coarser_than(&self, cells: [usize; 2]) -> bool {
        let within =
            |axis: usize| self.places[axis].iter().filter(|place| self.window[axis].contains(place)).count();
        (0..2).any(|axis| cells[axis] > 1 && cells[axis] > within(axis))
    }
}

/// Mean height of every cell: that of the surface which is linear between the points (bilinear in two dimensions). `places` are those
/// of the points along x and y, `window` from where to where the cells lie, and whether it is a period. A plane stays the same plane.
pub fn resampled(
    heights: &Array2<f64>,
    places: [&[f64]; 2],
    (window, repeats): (&[Range<f64>; 2], [bool; 2]),
    cells: [usize; 2],
) -> Array2<f64> {
    let mut heights = heights.clone();
    for axis in [0, 1] {
        let ghosts = if repeats[axis] { with_ghosts(places[axis], &window[axis]) } else { Vec::new() };
        let places = if ghosts.is_empty() { places[axis] } else { &ghosts };
        let weights = weights(places, &window[axis], cells[axis]);
        // the first of the points with ghosts is the last one
        let before = if ghosts.is_empty() { 0 } else { heights.len_of(Axis(axis)) - 1 };
        let mut shape = [heights.nrows(), heights.ncols()];
        shape[axis] = cells[axis];
        let mut means = Array2::zeros(shape);
        for (lane, mut mean) in heights.lanes(Axis(axis)).into_iter().zip(means.lanes_mut(Axis(axis))) {
            for (weights, mean) in weights.iter().zip(&mut mean) {
                let at = |place: usize| lane[(weights.first + place + before) % lane.len()];
                *mean = weights.of.iter().enumerate().map(|(place, w)| w * at(place)).sum();
            }
        }
        heights = means;
    }
    heights
}

/// The points of a period with the last one before the first, and the first one after the last.
fn with_ghosts(places: &[f64], window: &Range<f64>) -> Vec<f64> {
    let (Some(first), Some(last)) = (places.first(), places.last()) else { return Vec::new() };
    let period = window.end - window.start;
    [last - period].into_iter().chain(places.iter().copied()).chain([first + period]).collect()
}

/// The integral over each cell, by its width, of the hat functions of the points; the first and the last line go on beyond the points.
fn weights(places: &[f64], window: &Range<f64>, cells: usize) -> Vec<Weights> {
    let width = (window.end - window.start) / cells as f64;
    let last = places.len().saturating_sub(2);
    let segment = |at: f64| places.partition_point(|place| *place <= at).saturating_sub(1).min(last);
    let of_cell = |cell: usize| {
        if places.len() < 2 {
            return Weights { first: 0, of: vec![1.0] };
        }
        let [from, to] = [0, 1].map(|side| window.start + (cell + side) as f64 * width);
        let (first, end) = (segment(from), segment(to));
        let mut of = vec![0.0; end - first + 2];
        for at in first..=end {
            let left = if at == first { from } else { places[at] };
            let right = if at == end { to } else { places[at + 1] };
            let (share, middle) = ((right - left) / (to - from), 0.5 * (left + right));
            let rise = (middle - places[at]) / (places[at + 1] - places[at]);
            of[at - first] += share * (1.0 - rise);
            of[at - first + 1] += share * rise;
        }
        Weights { first, of }
    };
    (0..cells).map(of_cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_stays_a_plane_on_finer_and_coarser_cells() {
        let (points, spacing) = ([40, 30], [0.5, 0.4]);
        let [x, y] = [0, 1].map(|axis| even(points[axis], spacing[axis]));
        let plane = |x: f64, y: f64| 2.0 + 0.3 * x - 0.7 * y;
        let heights = Array2::from_shape_fn((points[0], points[1]), |(i, j)| plane(x[i], y[j]));
        for cells in [[40, 30], [7, 64], [16, 16], [200, 1]] {
            let window = [2.0..17.0, 0.0..12.0];
            let found = resampled(&heights, [&x, &y], (&window, [false; 2]), cells);
            for ((i, j), height) in found.indexed_iter() {
                let at = |axis: usize, cell: usize| {
                    let Range { start, end } = window[axis];
                    start + (end - start) * (cell as f64 + 0.5) / cells[axis] as f64
                };
                assert!((height - plane(at(0, i), at(1, j))).abs() < 1e-13, "{cells:?} {i} {j}");
            }
        }
    }

    /// The middle cell has 3/4 of its point and 1/8 of each neighbour; those at the border the value of the line at their middle.
    #[test]
    fn a_cell_has_the_mean_of_the_surface_between_the_points() {
        let x = even(3, 1.0);
        let peak = Array2::from_shape_vec((3, 1), vec![0.0, 8.0, 0.0]).unwrap();
        let found = resampled(&peak, [&x, &[0.0]], (&[0.0..3.0, 0.0..1.0], [false; 2]), [3, 1]);
        // beyond the first point the line goes on: from -4 at the border to 4 at the edge of the cell
        assert_eq!(found.into_raw_vec_and_offset().0, [0.0, 6.0, 0.0]);
        // uneven points; one cell over all of them has the area of the two triangles, 8 * 3 / 2, by its width
        let whole = resampled(&peak, [&[0.0, 1.0, 3.0], &[0.0]], (&[0.0..3.0, 0.0..1.0], [false; 2]), [1, 1]);
        assert!((whole[[0, 0]] - 4.0).abs() < 1e-14);
    }

    /// A period moved by whole points is the same surface moved by them; here by three cells a point.
    #[test]
    fn a_period_has_no_border() {
        let heights = Array2::from_shape_fn((12, 10), |(i, j)| ((7 * i + 5 * j) % 13) as f64);
        let moved = Array2::from_shape_fn((12, 10), |(i, j)| heights[[(i + 5) % 12, (j + 3) % 10]]);
        let (x, y) = (even(12, 0.2), even(10, 0.3));
        let on = |heights: &Array2<f64>| {
            resampled(heights, [&x, &y], (&[0.0..2.4, 0.0..3.0], [true; 2]), [36, 30])
        };
        let (found, of_moved) = (on(&heights), on(&moved));
        for ((i, j), height) in of_moved.indexed_iter() {
            // rounding of places and weights
            assert!((height - found[[(i + 15) % 36, (j + 9) % 30]]).abs() < 1e-12, "{i} {j}");
        }
    }

    /// The mean over all cells is the integral of the surface, however fine they are.
    #[test]
    fn the_mean_does_not_depend_on_the_cells() {
        let heights = Array2::from_shape_fn((31, 23), |(i, j)| ((7 * i + 5 * j) % 13) as f64);
        let [x, y] = [even(31, 0.2), even(23, 0.3)];
        let mean = |cells: [usize; 2]| {
            let window = [0.3..6.0, 0.1..6.8];
            let found = resampled(&heights, [&x, &y], (&window, [false; 2]), cells);
            found.sum() / found.len() as f64
        };
        let right = mean([1, 1]);
        for cells in [[3, 4], [31, 23], [128, 77]] {
            assert!((mean(cells) - right).abs() < 1e-13 * right, "{cells:?}");
        }
    }
}
