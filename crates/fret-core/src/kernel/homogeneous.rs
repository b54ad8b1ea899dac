//! Pressure alone on homogeneous bodies: the kernel is `1/r`, so that coefficients need no table.

use ndarray::Array2;
use pulp::Arch;
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::quadrature::GaussRule;
use crate::fields::{CellRule, Reals, each_cell};

/// Cells nearer than this many longer sides are integrated in closed form, whose corner differences lose the square of
/// distance over side.
const NEAR: f64 = 6.0;
/// Cells nearer than this many longer sides are integrated by Gauss points, which converge like `(side/(4 distance))^(2 points)`.
const FAR: f64 = 12.0;
/// Points along either side.
const POINTS: usize = 6;
/// Powers of `(side/distance)^2` kept beyond: what is left is 1e-16 of the whole at [`FAR`].
const POWERS: usize = 5;

/// Whether cells of these sides are square enough for the rules.
pub(super) fn serves(spacing: [f64; 2]) -> bool {
    spacing[0] <= 2.0 * spacing[1] && spacing[1] <= 2.0 * spacing[0]
}

/// Displacement at the offsets of `cells` by unit pressure on a cell, when `k C_zz = times_k` \[1/pressure\].
pub(super) fn normal_coefficients(times_k: f64, cells: [usize; 2], spacing: [f64; 2]) -> Array2<f64> {
    let [nx, ny] = cells;
    let symmetric = nx == ny && spacing[0] == spacing[1];
    let points = scaled_rule(POINTS, spacing, times_k / TAU);
    let multipoles = Multipoles::new(spacing, times_k / TAU);
    let along_y: Vec<f64> = (0..ny).map(|j| j as f64 * spacing[1]).collect();
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
        let near = beyond(NEAR);
        let far = beyond(FAR).max(near);
        for (j, value) in row[..near].iter_mut().enumerate() {
            *value = times_k / TAU * near_cell([x, along_y[j]], spacing);
        }
        add_points(&mut row[near..far], &points, x, near, spacing[1]);
        let end = row.len();
        each_cell(&FarCells { multipoles: &multipoles, x }, [&along_y[far..end]], [&mut row[far..]]);
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

/// `1/r` over a far cell by powers of side over distance: `1/|r - s| = sum_l s^l/r^(l+1) P_l(cos gamma)`, gamma between r and s, and
/// `P_l(cos gamma) = sum_j a_j a_(l-j) cos((l-2j) gamma)` with `a_j = (2j)!/(2^j j!)^2` (Whittaker and Watson, A Course of Modern
/// Analysis, 15.1). Of a rectangle even powers and even multiples of the angle are left.
struct Multipoles {
    /// Factor of `(longer/r)^(2p) cos(2 k theta)` at `[p][k]`.
    moments: [[f64; POWERS + 1]; POWERS + 1],
    /// Length of the longer side.
    longer: f64,
    /// Factor of all.
    size: f64,
}

impl Multipoles {
    fn new(sides: [f64; 2], factor: f64) -> Self {
        let longer = sides[0].max(sides[1]);
        let mut shares = [1.0; 2 * POWERS + 1];
        for j in 1..=2 * POWERS {
            shares[j] = shares[j - 1] * (2 * j - 1) as f64 / (2 * j) as f64;
        }
        let mut moments = [[0.0; POWERS + 1]; POWERS + 1];
        // exact for all powers
        for [x, y, weight] in scaled_rule(POWERS + 1, sides.map(|side| side / longer), 1.0) {
            let (square, angle) = (x * x + y * y, libm::atan2(y, x));
            for p in 0..=POWERS {
                for k in 0..=p {
                    let both_signs = if k == 0 { 1.0 } else { 2.0 };
                    let share = both_signs * shares[p - k] * shares[p + k];
                    moments[p][k] +=
                        weight * share * square.powi(p as i32) * libm::cos((2 * k) as f64 * angle);
                }
            }
        }
        Self { moments, longer, size: factor * longer * longer }
    }
}

/// Integrals over far cells of a row at `x`, from their places along y.
struct FarCells<'a> {
    multipoles: &'a Multipoles,
    x: f64,
}

impl CellRule<1, 1, 0> for FarCells<'_> {
    #[inline(always)]
    fn at<R: Reals>(&self, [y]: [R; 1], [value]: &mut [R; 1]) -> [R; 0] {
        let Multipoles { moments, longer, size } = self.multipoles;
        let along_x = y.all(self.x * self.x);
        let square = along_x + y * y;
        let per_square = y.all(1.0) / square;
        let ratio = per_square * (longer * longer);
        // cos(2 k theta)
        let mut cosines = [y.all(1.0); POWERS + 1];
        cosines[1] = (along_x - y * y) * per_square;
        for k in 2..=POWERS {
            cosines[k] = cosines[1] * cosines[k - 1] * 2.0 - cosines[k - 2];
        }
        let mut sum = y.all(0.0);
        for p in (0..=POWERS).rev() {
            sum = sum * ratio;
            for k in 0..=p {
                sum = sum + cosines[k] * moments[p][k];
            }
        }
        *value = sum * square.sqrt() * per_square * *size;
        []
    }
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
    use super::serves;

    #[test]
    fn the_general_way_gives_the_same() {
        // by radial table and other Gauss rules, judged itself by Love's solution
        let pair = pair(&[], Some((2.6, 0.3)));
        for (cells, spacing) in
            [([70, 70], [1.0, 1.0]), ([260, 5], [1.0, 1.0]), ([40, 60], [1.0, 1.9]), ([40, 40], [1.9, 1.0])]
        {
            let fast = influence_coefficients(&pair, cells, spacing, Components::NORMAL).zz.unwrap();
            let general = influence_coefficients(&pair, cells, spacing, Components::ALL).zz.unwrap();
            for ((i, j), value) in general.indexed_iter() {
                let error = (fast[[i, j]] - value).abs() / value;
                assert!(error < 3e-14, "({i}, {j}): {error:.1e}"); // rounding of 36 corner cells' differences
            }
        }
    }

    #[test]
    fn cells_up_to_twice_as_long_as_wide_are_served() {
        for unit in [1e-6, 1.0, 1e6] {
            for (sides, served) in
                [([1.0, 1.0], true), ([1.0, 2.0], true), ([1.0, 2.01], false), ([1.0, 10.0], false)]
            {
                let [short, long] = sides.map(|side| unit * side);
                assert_eq!([serves([short, long]), serves([long, short])], [served; 2], "{sides:?} {unit}");
            }
        }
    }

    /// Near, farther and far cells are told by lengths of sides: powers of two change no bit.
    #[test]
    fn the_same_in_every_unit() {
        let of = |unit: f64| {
            let pair = pair(&[], Some((2.6, 0.3)));
            influence_coefficients(&pair, [40, 30], [unit, 1.5 * unit], Components::NORMAL).zz.unwrap()
        };
        let before = of(1.0);
        for unit in [2.0_f64.powi(-20), 2.0_f64.powi(13)] {
            assert_eq!(of(unit) / unit, before);
        }
    }
}
