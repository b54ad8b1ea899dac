//! Lists of points, `x y z` or in a line contact `x z`: their values on the cells of the grid.

use ndarray::{Array2, ArrayView2};

/// How far a coordinate may lie from its place on the grid of the points, in spacings: printed digits, and the noise of a stage.
const OFF: f64 = 0.1;
/// How far the spacing of the points may differ from that of the cells.
const SPACING: f64 = 1e-3;

/// Whether an array can be a list of points: no grid has two or three cells on a side.
pub fn is_list(array: &Array2<f64>, cells: [usize; 2]) -> bool {
    match array.ncols() {
        3 => true,
        2 => cells[1] == 1,
        _ => false,
    }
}

/// Values on the cells, and the spacing of the points along each axis that has more than one cell. Rows may come in any order; every
/// cell needs one. Coordinates may be off by a tenth of the spacing.
///
/// # Errors
/// What is wrong with the points, in words.
pub fn on_cells(
    points: &ArrayView2<'_, f64>,
    cells: [usize; 2],
) -> Result<(Array2<f64>, [Option<f64>; 2]), String> {
    let count = points.nrows();
    if count != cells[0] * cells[1] {
        return Err(match own_cells(points) {
            Some([nx, ny]) => format!(
                "{count} points on a grid of {nx} x {ny}, but the grid has {} x {} cells",
                cells[0], cells[1]
            ),
            None => format!("{count} points, but the grid has {} x {} cells", cells[0], cells[1]),
        });
    }
    let axes = points.ncols() - 1;
    let [x, y] =
        [0, 1].map(|axis| if axis < axes { Places::of(points, axis, cells[axis]) } else { Places::ONE });
    let mut found: Array2<Option<f64>> = Array2::from_elem(cells, None);
    for (row, point) in points.rows().into_iter().enumerate() {
        let mut at = [0; 2];
        for (axis, places) in [x, y].iter().enumerate().take(axes) {
            at[axis] = places.index(point[axis], cells[axis]).ok_or_else(|| {
                format!(
                    "point {} of {count} at {} = {:?} lies on no grid of {} x {} cells, {}",
                    row + 1,
                    ["x", "y"][axis],
                    point[axis],
                    cells[0],
                    cells[1],
                    places.in_words()
                )
            })?;
        }
        if found[at].replace(point[axes]).is_some() {
            return Err(format!("point {} of {count} lies where another does: cell {at:?}", row + 1));
        }
    }
    // as many points as cells, and no cell has two
    Ok((found.mapv(|value| value.unwrap_or(f64::NAN)), [x.spacing(cells[0]), y.spacing(cells[1])]))
}

/// The grid that the points lie on, where they fill one.
pub fn own_cells(points: &ArrayView2<'_, f64>) -> Option<[usize; 2]> {
    let levels = |axis: usize| {
        let mut values: Vec<f64> = points.column(axis).to_vec();
        values.sort_unstable_by(f64::total_cmp);
        let widest = values.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        1 + values.windows(2).filter(|pair| pair[1] - pair[0] > 0.5 * widest).count()
    };
    let cells = if points.ncols() == 2 { [levels(0), 1] } else { [levels(0), levels(1)] };
    (cells[0] * cells[1] == points.nrows()).then_some(cells)
}

/// Evenly spaced places along an axis.
#[derive(Clone, Copy)]
struct Places {
    first: f64,
    spacing: f64,
}

impl Places {
    const ONE: Self = Self { first: 0.0, spacing: 0.0 };

    fn of(points: &ArrayView2<'_, f64>, axis: usize, count: usize) -> Self {
        let column = points.column(axis);
        let first = column.iter().copied().fold(f64::INFINITY, f64::min);
        let last = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self { first, spacing: if count > 1 { (last - first) / (count - 1) as f64 } else { last - first } }
    }

    /// The place that a coordinate means.
    fn index(self, coordinate: f64, count: usize) -> Option<usize> {
        if count == 1 {
            return (self.spacing == 0.0).then_some(0);
        }
        let place = (coordinate - self.first) / self.spacing;
        let index = place.round();
        ((place - index).abs() <= OFF && (0.0..count as f64).contains(&index)).then_some(index as usize)
    }

    fn spacing(self, count: usize) -> Option<f64> {
        (count > 1).then_some(self.spacing)
    }

    fn in_words(self) -> String {
        format!("which begins at {:?} with a spacing of {:?}", self.first, figures(self.spacing))
    }
}

/// Refuses points that lie closer or farther apart than the cells, in the case's unit of length and in that of the heights.
pub fn spacing_refused(points: [Option<f64>; 2], cells: [f64; 2], unit: f64) -> Option<String> {
    let fits = |unit: f64| {
        points
            .iter()
            .zip(cells)
            .all(|(point, cell)| point.is_none_or(|point| (point * unit / cell - 1.0).abs() <= SPACING))
    };
    if fits(1.0) || fits(unit) {
        return None;
    }
    let along = |values: [Option<f64>; 2]| {
        let words: Vec<String> =
            values.iter().flatten().map(|&value| format!("{:?}", figures(value))).collect();
        words.join(" x ")
    };
    let shown = [0, 1].map(|axis| points[axis].map(|_| cells[axis]));
    Some(format!("points {} apart, but the cells of the grid are {}", along(points), along(shown)))
}

/// A number in six figures.
pub fn figures(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use ndarray::array;

    use super::*;

    fn points(order: impl Fn(usize) -> usize, off: f64) -> Array2<f64> {
        Array2::from_shape_fn((12, 3), |(row, column)| {
            let (i, j) = (order(row) / 4, order(row) % 4);
            match column {
                0 => 5.0 + 0.5 * i as f64 + off * (row % 3) as f64,
                1 => -1.0 - 2.0 * j as f64,
                _ => (10 * i + j) as f64,
            }
        })
    }

    /// Cell [i, j] has the value 10 i + 3 - j: y grows with j, and the points were made with y falling.
    #[test]
    fn points_in_any_order_lie_on_their_cells() {
        let right = Array2::from_shape_fn((3, 4), |(i, j)| (10 * i + 3 - j) as f64);
        let orders: [&dyn Fn(usize) -> usize; 3] = [&|row| row, &|row| 11 - row, &|row| row * 5 % 12];
        for order in orders {
            for off in [0.0, 0.02] {
                let (values, spacing) = on_cells(&points(order, off).view(), [3, 4]).unwrap();
                assert_eq!(values, right);
                // two thirds of two hundredths at each end
                assert!((spacing[0].unwrap() - 0.5).abs() < 0.021 && spacing[1] == Some(2.0));
            }
        }
        let line = array![[0.25, 7.0], [0.0, 5.0], [0.5, 9.0], [0.75, 1.0]];
        let (values, spacing) = on_cells(&line.view(), [4, 1]).unwrap();
        assert_eq!((values, spacing), (array![[5.0], [7.0], [9.0], [1.0]], [Some(0.25), None]));
    }

    #[test]
    fn points_that_are_no_grid_are_refused_in_words() {
        let refused = |points: &Array2<f64>, cells| on_cells(&points.view(), cells).unwrap_err();
        let good = points(|row| row, 0.0);
        assert_eq!(refused(&good, [4, 4]), "12 points on a grid of 3 x 4, but the grid has 4 x 4 cells");
        assert!(
            refused(&good, [4, 3]).contains("lies on no grid of 4 x 3 cells"),
            "{}",
            refused(&good, [4, 3])
        );
        let mut twice = good.clone();
        twice[[3, 0]] = twice[[4, 0]];
        twice[[3, 1]] = twice[[4, 1]];
        assert_eq!(refused(&twice, [3, 4]), "point 5 of 12 lies where another does: cell [1, 3]");
        let mut off = good.clone();
        off[[5, 0]] += 0.06; // of 0.5
        assert!(refused(&off, [3, 4]).contains("point 6 of 12 at x = 5.56"));
        assert!(refused(&Array2::zeros((12, 3)), [3, 4]).contains("lies on no grid"));
    }

    #[test]
    fn the_spacing_is_that_of_the_cells_in_one_of_the_two_units() {
        let points = [Some(0.5), Some(2.0)];
        assert_eq!(spacing_refused(points, [0.5, 2.0], 1e-6), None);
        assert_eq!(spacing_refused(points, [5e-7, 2e-6], 1e-6), None);
        assert_eq!(spacing_refused([Some(0.5), None], [0.5, 1.0], 1.0), None);
        let words = spacing_refused(points, [0.5, 1.0], 1e-6).unwrap();
        assert_eq!(words, "points 0.5 x 2.0 apart, but the cells of the grid are 0.5 x 1.0");
        assert!(spacing_refused(points, [5e-4, 2e-3], 1e-6).is_some());
        assert!(spacing_refused(points, [0.5006, 2.0], 1.0).is_some());
    }
}
