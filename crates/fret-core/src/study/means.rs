//! Cell means: of a field on other cells, and of a formula.

use ndarray::Array2;

use crate::model::SurfaceGrid;

/// Points a side at which a formula is taken in every cell.
const POINTS: usize = 12;

/// Mean over the cells of `grid` of a field that is uniform in the cells of `from`; both grids have the same size.
pub fn of_field(field: &Array2<f64>, from: &SurfaceGrid, grid: &SurfaceGrid) -> Array2<f64> {
    let [x, y] = [0, 1].map(|axis| shares(from.cells()[axis], grid.cells()[axis]));
    let [nx, ny] = grid.cells();
    let mut rows: Array2<f64> = Array2::zeros((nx, from.cells()[1]));
    for (i, parts) in x.iter().enumerate() {
        for (source, share) in parts {
            for j in 0..from.cells()[1] {
                rows[[i, j]] += share * field[[*source, j]];
            }
        }
    }
    let mut means: Array2<f64> = Array2::zeros((nx, ny));
    for (j, parts) in y.iter().enumerate() {
        for (source, share) in parts {
            for i in 0..nx {
                means[[i, j]] += share * rows[[i, *source]];
            }
        }
    }
    means
}

/// Shares of `from` equal parts of a length in each of `to` equal parts of it.
fn shares(from: usize, to: usize) -> Vec<Vec<(usize, f64)>> {
    // In units of 1 / (from * to) of the length every border is a whole number.
    let overlap = |i: usize, j: usize| {
        let (low, high) = ((i * from).max(j * to), ((i + 1) * from).min((j + 1) * to));
        high.saturating_sub(low)
    };
    let parts = |i: usize| {
        let first = i * from / to;
        (first..from)
            .map(move |j| (j, overlap(i, j)))
            .take_while(|(_, overlap)| *overlap > 0)
            .map(|(j, overlap)| (j, overlap as f64 / from as f64))
            .collect()
    };
    (0..to).map(parts).collect()
}

/// Mean of a formula over every cell.
pub fn of_formula(formula: &dyn Fn(f64, f64) -> f64, grid: &SurfaceGrid) -> Array2<f64> {
    let [dx, dy] = grid.spacing();
    let place = |k: usize| (k as f64 + 0.5) / POINTS as f64 - 0.5;
    Array2::from_shape_fn(grid.cells(), |(i, j)| {
        let (x, y) = (grid.centre(0, i), grid.centre(1, j));
        let mut sum = 0.0;
        for a in 0..POINTS {
            for b in 0..POINTS {
                sum += formula(x + place(a) * dx, y + place(b) * dy);
            }
        }
        sum / (POINTS * POINTS) as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means keep the integral and the values of a uniform field, whatever the two numbers of cells.
    #[test]
    fn means_conserve() {
        for (n, m) in [(12, 4), (12, 5), (5, 12), (7, 7)] {
            let from = SurfaceGrid::new([n, n], [1.0 / n as f64; 2]).unwrap();
            let to = SurfaceGrid::new([m, m], [1.0 / m as f64; 2]).unwrap();
            let field = Array2::from_shape_fn((n, n), |(i, j)| (3 * i + j * j) as f64);
            let means = of_field(&field, &from, &to);
            let (a, b) = (field.sum() * from.cell_area(), means.sum() * to.cell_area());
            assert!((a / b - 1.0).abs() < 1e-13, "{n} {m}: {a} {b}");
            let one = of_field(&Array2::from_elem((n, n), 1.0), &from, &to);
            assert!(one.iter().all(|value| (value - 1.0).abs() < 1e-14));
        }
    }
}
