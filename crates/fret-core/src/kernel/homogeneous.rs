//! Pressure alone on homogeneous bodies: the kernel is `1/r`, so that coefficients need no table.

use ndarray::Array2;
use pulp::Arch;
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::quadrature::GaussRule;

/// Cells nearer than this many longer sides are integrated in closed form, whose corner differences lose the square of
/// distance over side; beyond, Gauss points converge like `(side/(4 distance))^(2 points)`.
const NEAR: f64 = 6.0;
/// Points along either side up to a distance in longer sides.
const RULES: [(f64, usize); 4] = [(12.0, 6), (24.0, 5), (100.0, 4), (f64::INFINITY, 3)];

/// Whether cells of these sides are square enough for the rules.
pub(super) fn serves(spacing: [f64; 2]) -> bool {
    spacing[0] <= 2.0 * spacing[1] && spacing[1] <= 2.0 * spacing[0]
}

/// Displacement at the offsets of `cells` by unit pressure on a cell, when `k C_zz = times_k` \[1/pressure\].
pub(super) fn normal_coefficients(times_k: f64, cells: [usize; 2], spacing: [f64; 2]) -> Array2<f64> {
    let [nx, ny] = cells;
    let symmetric = nx == ny && spacing[0] == spacing[1];
    let rules = RULES.map(|(limit, count)| (limit, scaled_rule(count, spacing, times_k / TAU)));
    let mut values = Array2::zeros(cells);
    let Some(flat) = values.as_slice_mut() else { unreachable!("a new array is contiguous") };
    let longer = spacing[0].max(spacing[1]);
    flat.par_chunks_mut(ny.max(1)).enumerate().for_each(|(i, row)| {
        let x = i as f64 * spacing[0];
        let row = if symmetric { &mut row[..=i] } else { row };
        // first column farther than a distance
        let beyond = |distance: f64| {
            let rest = (distance * longer).powi(2) - x * x;
            if rest <= 0.0 { 0 } else { ((rest.sqrt() / spacing[1]).ceil()).min(row.len() as f64) as usize }
        };
        let mut first = beyond(NEAR);
        let ends: Vec<usize> = rules.iter().map(|(limit, _)| beyond(*limit)).collect();
        for (j, value) in row[..first].iter_mut().enumerate() {
            *value = times_k / TAU * near_cell([x, j as f64 * spacing[1]], spacing);
        }
        for ((_, points), end) in rules.iter().zip(ends) {
            let end = end.max(first);
            add_points(&mut row[first..end], points, x, first, spacing[1]);
            first = end;
        }
    });
    if symmetric {
        for i in 0..nx {
            for j in i + 1..ny {
                values[[i, j]] = values[[j, i]];
            }
        }
    }
    values
}

/// Offsets from the centre of a cell, and weights.
fn scaled_rule(count: usize, spacing: [f64; 2], factor: f64) -> Vec<[f64; 3]> {
    let points = GaussRule::new(count).points;
    let half = spacing.map(|side| 0.5 * side);
    let pairs = points.iter().flat_map(|a| points.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| [half[0] * a.0, half[1] * b.0, factor * half[0] * half[1] * a.1 * b.1]).collect()
}

fn add_points(row: &mut [f64], points: &[[f64; 3]], x: f64, first: usize, side: f64) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for &[px, py, weight] in points {
                let square = (x + px) * (x + px);
                for (j, value) in row.iter_mut().enumerate() {
                    let y = (first + j) as f64 * side + py;
                    *value += weight / (square + y * y).sqrt();
                }
            }
        },
    );
}

/// Integral of `1/r` over a cell at `offset` (Love 1929).
fn near_cell(offset: [f64; 2], sides: [f64; 2]) -> f64 {
    let [x, y] = [0, 1].map(|axis| [offset[axis] + 0.5 * sides[axis], offset[axis] - 0.5 * sides[axis]]);
    let corner = |x: f64, y: f64| x * libm::asinh(y / x.abs()) + y * libm::asinh(x / y.abs());
    corner(x[0], y[0]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[1], y[1])
}

#[cfg(test)]
mod tests {
    use super::super::influence::{Components, influence_coefficients};
    use super::super::samples::pair;

    #[test]
    fn the_general_way_gives_the_same() {
        // by radial table and other Gauss rules, judged itself by Love's solution
        let pair = pair(&[], Some((2.6, 0.3)));
        for (cells, spacing) in [([70, 70], [1.0, 1.0]), ([260, 5], [1.0, 1.0]), ([40, 60], [1.0, 1.9])] {
            let fast = influence_coefficients(&pair, cells, spacing, Components::NORMAL).zz.unwrap();
            let general = influence_coefficients(&pair, cells, spacing, Components::ALL).zz.unwrap();
            for ((i, j), value) in general.indexed_iter() {
                let error = (fast[[i, j]] - value).abs() / value;
                assert!(error < 3e-14, "({i}, {j}): {error:.1e}"); // rounding of 36 corner cells' differences
            }
        }
    }
}
