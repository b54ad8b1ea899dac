//! The top of the pressure between the cells.

use ndarray::{Array2, ArrayView2};

use crate::model::Symmetry;

/// Largest pressure [pressure] as the top of the quadratic of least squares through `p^2` in the largest cell and its eight
/// neighbours. For smooth contacts it falls with the cell squared and from one side, which the largest cell does not: that
/// depends on where the peak falls between the cells. The largest cell where a neighbour is open or missing, or where the
/// quadratic has no top within a cell of it: edges, rims, points.
pub fn peak_pressure(pressure: &Array2<f64>) -> f64 {
    peak_pressure_in_front(pressure, Symmetry::NONE)
}

/// The same of the pressure in front of mirrors.
pub fn peak_pressure_in_front(pressure: &Array2<f64>, symmetry: Symmetry) -> f64 {
    // Of cells that are alike the first one of the whole counts, and that lies behind the mirrors.
    let pressure = symmetry.behind(pressure);
    let Some((at, largest)) = largest_cell(&pressure) else { return 0.0 };
    top(&pressure, symmetry.axes(), at).map_or(largest, f64::sqrt)
}

/// The first of the largest cells, and its pressure.
fn largest_cell(pressure: &ArrayView2<'_, f64>) -> Option<([usize; 2], f64)> {
    let mut found: Option<([usize; 2], f64)> = None;
    for (i, row) in pressure.rows().into_iter().enumerate() {
        let largest = row.fold(0.0, |largest: f64, p| largest.max(*p));
        if largest > found.map_or(0.0, |(_, largest)| largest) {
            found = row.iter().position(|p| *p == largest).map(|j| ([i, j], largest));
        }
    }
    found
}

/// Top of the quadratic through `p^2` around a cell. Beyond the last cells of a mirrored axis their images follow.
fn top(pressure: &ArrayView2<'_, f64>, mirrored: [bool; 2], [i, j]: [usize; 2]) -> Option<f64> {
    let (nx, ny) = pressure.dim();
    if ny == 1 {
        return top_of_line(pressure, i);
    }
    let is_last = [i + 1 >= nx, j + 1 >= ny];
    if i == 0 || j == 0 || (0..2).any(|axis| is_last[axis] && !mirrored[axis]) {
        return None;
    }
    // Sums of p^2 times 1, x, y, x^2, y^2, x y over the nine cells, x and y in cells from the middle one.
    let mut sums = [0.0; 6];
    for a in 0..3 {
        for b in 0..3 {
            let p = pressure[[(i + a - 1).min(nx - 1), (j + b - 1).min(ny - 1)]];
            if p <= 0.0 {
                return None;
            }
            let (x, y, square) = (a as f64 - 1.0, b as f64 - 1.0, p * p);
            for (sum, weight) in sums.iter_mut().zip([1.0, x, y, x * x, y * y, x * y]) {
                *sum += weight * square;
            }
        }
    }
    let [one, x, y, xx, yy, xy] = sums;
    // c + g . r + (1/2) r . H r of least squares on the nine points.
    let centre = (5.0 * one - 3.0 * (xx + yy)) / 9.0;
    let (gx, gy) = (x / 6.0, y / 6.0);
    let (hx, hy, hxy) = (xx - 2.0 / 3.0 * one, yy - 2.0 / 3.0 * one, xy / 4.0);
    let determinant = hx * hy - hxy * hxy;
    if !(hx < 0.0 && determinant > 0.0) {
        return None;
    }
    let (u, v) = ((hxy * gy - hy * gx) / determinant, (hxy * gx - hx * gy) / determinant);
    (u.abs() <= 1.0 && v.abs() <= 1.0).then_some(centre + 0.5 * (gx * u + gy * v))
}

/// Top of the parabola through `p^2` of a cell of a line contact and its two neighbours.
fn top_of_line(pressure: &ArrayView2<'_, f64>, i: usize) -> Option<f64> {
    let square = |i: usize| pressure.get([i, 0]).filter(|p| **p > 0.0).map(|p| p * p);
    let (left, middle, right) = (square(i.checked_sub(1)?)?, square(i)?, square(i + 1)?);
    let (slope, bend) = (0.5 * (right - left), left - 2.0 * middle + right);
    (bend < 0.0).then(|| middle - 0.5 * slope * slope / bend)
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::{peak_pressure, peak_pressure_in_front};
    use crate::model::Symmetry;

    /// Hertz's p^2 is a quadratic: its top is found to rounding wherever it lies, turned and stretched.
    #[test]
    fn the_top_of_a_quadratic_is_met_wherever_it_lies() {
        for (x0, y0) in [(0.0, 0.0), (0.5, 0.5), (0.3, -0.45), (-0.2, 0.1)] {
            let pressure = Array2::from_shape_fn((9, 9), |(i, j)| {
                let (x, y) = (i as f64 - 4.0 - x0, j as f64 - 4.0 - y0);
                (7.0 - 0.1 * x * x - 0.05 * y * y + 0.04 * x * y).max(0.0).sqrt()
            });
            assert!((peak_pressure(&pressure) / 7.0_f64.sqrt() - 1.0).abs() < 1e-14, "{x0} {y0}");
        }
    }

    #[test]
    fn without_a_top_inside_the_largest_cell_stands() {
        let rim = Array2::from_shape_fn((5, 5), |(i, _)| if i < 3 { 1.0 + i as f64 } else { 0.0 });
        assert_eq!(peak_pressure(&rim), 3.0);
        let mut alone = Array2::zeros((5, 5));
        assert_eq!(peak_pressure(&alone), 0.0);
        alone[[0, 2]] = 2.0;
        assert_eq!(peak_pressure(&alone), 2.0);
        let saddle = Array2::from_shape_fn((5, 5), |(i, j)| {
            (10.0 - (i as f64 - 2.0).powi(2) + (j as f64 - 2.0).powi(2)).sqrt()
        });
        assert_eq!(peak_pressure(&saddle), 14.0_f64.sqrt());
    }

    /// Tops on a mirror, beside it and away from it are those of the whole, to the bit.
    #[test]
    fn the_top_is_found_in_front_of_mirrors() {
        for (x0, y0) in [(0.0, 0.0), (0.5, 0.0), (1.7, 0.4), (0.2, 3.1)] {
            let whole = Array2::from_shape_fn((12, 16), |(i, j)| {
                let (x, y) = ((i as f64 - 5.5).abs() - x0, (j as f64 - 7.5).abs() - y0);
                (7.0 - 0.1 * x * x - 0.05 * y * y + 0.01 * x * y).max(0.0).sqrt()
            });
            for odd_shear in [[None, Some(1)], [Some(0), None], [Some(0), Some(1)]] {
                let symmetry = Symmetry { odd_shear };
                let found = peak_pressure_in_front(&symmetry.part(&whole), symmetry);
                assert_eq!(found, peak_pressure(&whole), "{x0} {y0} {symmetry:?}");
            }
        }
    }
}
