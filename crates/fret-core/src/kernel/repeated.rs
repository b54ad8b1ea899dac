//! What a unit traction on a cell and on all its images along y, one period apart, does under another cell.
//!
//! The sum over images has no end: far away a kernel falls like `1/r`, and what an infinite half-space lacks under a line load, a zero, the
//! sum lacks too. It is taken apart by a window `w` that is 1 near the load and falls to 0 over several periods:
//!
//! ```text
//! K(x, y) = Sum_n (w f)(x, y + n b) + Sum_n ((1 - w) f)(x, y + n b)
//! ```
//!
//! The rest is the sum of a function that is smooth over a period `b`: by Poisson's formula its waves along y, `exp(2 pi i m y/b)`, are as
//! small as the window's spectrum is at their wavenumber, and its mean is what brings the mean of `K` to that of a traction which does not
//! change along y: the kernel of a line contact over the number of cells in a period, which has a datum. The window's slope is the
//! exponential of a semicircle, whose spectrum falls off about as fast as any of that width can (Barnett, Magland & af Klinteberg 2019,
//! SIAM J. Sci. Comput. 41, C479). Nothing is assumed of the kernel but that it is smooth far away: coatings are in it.

use std::f64::consts::TAU;

use ndarray::Array3;
use rayon::prelude::*;

use super::cell_integrals::Moments;
use super::cell_rules::CellQuadrature;
use super::cells::{CellCoefficients, Tables, fill_row};
use super::quartets::Quartets;

/// Periods over which the window is 1 on either side of the load.
const FLAT: f64 = 0.5;
/// Periods over which it then falls. What is left of the first wave is `exp(-pi FALL)` of its slope at the load: 4e-17; of the sum of
/// `1/r` 2e-13 (measured, at a quarter of a period and farther).
const FALL: f64 = 12.0;

/// Weights of offsets along an axis on a grid with so many cells in a period: as many as count.
pub(super) fn window(period: usize) -> Vec<f64> {
    let count = ((FLAT + FALL) * period as f64).ceil() as usize;
    let half = 0.5 * FALL * period as f64;
    let steepness = 0.5 * FALL * TAU;
    // The slope between one offset and the next.
    let slope = |index: usize| {
        let place = (index as f64 + 0.5 - FLAT * period as f64 - half) / half;
        if place.abs() < 1.0 { libm::exp(steepness * ((1.0 - place * place).sqrt() - 1.0)) } else { 0.0 }
    };
    let slopes: Vec<f64> = (0..count).map(slope).collect();
    let all: f64 = slopes.iter().sum();
    let mut fallen = 0.0;
    slopes
        .into_iter()
        .map(|slope| {
            let weight = 1.0 - fallen / all;
            fallen += slope;
            weight
        })
        .collect()
}

/// Offsets that are summed on a grid of so many cells `[across, in a period]`.
pub(super) fn with_images([across, period]: [usize; 2]) -> [usize; 2] {
    [across, window(period).len()]
}

/// Kernels over the offsets of one period along y, from tables that reach over [all offsets](with_images), each with its images.
/// `uniform(i, kernel)` is what a traction that does not change along y does at the `i`-th offset across; `is_odd(kernel)`, along `[x, y]`.
pub(super) fn repeated<Q: Quartets<N>, const N: usize, const C: usize, const L: usize>(
    tables: &Tables<Q, N>,
    [nx, ny]: [usize; 2],
    uniform: impl Fn(usize, usize) -> f64 + Sync,
    is_odd: impl Fn(usize) -> [bool; 2] + Sync,
    of_moments: impl Fn(&[Moments; N]) -> [[f64; C]; L] + Sync,
) -> CellCoefficients<C> {
    let (quadrature, weights, kernels) = (CellQuadrature::new(), window(ny), L * C);
    let count = weights.len();
    let mut values = vec![0.0; nx * kernels * ny];
    values.par_chunks_mut(kernels * ny).enumerate().for_each(|(index, rows)| {
        let mut alone = vec![0.0; kernels * count];
        let single = alone.chunks_exact_mut(count).collect();
        fill_row(tables, &quadrature, (index, count), &of_moments, single);
        for (kernel, (row, single)) in rows.chunks_exact_mut(ny).zip(alone.chunks_exact(count)).enumerate() {
            let [odd_x, odd_y] = is_odd(kernel);
            if !(odd_x && index == 0) {
                fold(single, &weights, odd_y, uniform(index, kernel), row);
            }
        }
    });
    let shape = (nx, kernels, ny);
    CellCoefficients::new(Array3::from_shape_vec(shape, values).unwrap_or_else(|_| Array3::zeros(shape)))
}

/// Sums a row over the images, and gives it the mean of a uniform traction; an odd one has none.
pub(super) fn fold(single: &[f64], weights: &[f64], is_odd: bool, uniform: f64, row: &mut [f64]) {
    let period = row.len();
    let mut ahead = vec![0.0; period];
    for (single, weights) in single.chunks(period).zip(weights.chunks(period)) {
        for (sum, (value, weight)) in ahead.iter_mut().zip(single.iter().zip(weights)) {
            *sum += weight * value;
        }
    }
    if is_odd {
        for place in 1..period {
            row[place] = ahead[place] - ahead[period - place];
        }
        return;
    }
    row[0] = 2.0 * ahead[0] - single[0];
    for place in 1..period {
        row[place] = ahead[place] + ahead[period - place];
    }
    let missing = (uniform - row.iter().sum::<f64>()) / period as f64;
    for value in row {
        *value += missing;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gauss' digamma function, by its recurrence and asymptotic series.
    fn digamma(x: f64) -> f64 {
        let (steps, mut far) = (20, x);
        let mut sum = 0.0;
        for _ in 0..steps {
            sum -= 1.0 / far;
            far += 1.0;
        }
        let square = 1.0 / (far * far);
        sum + far.ln()
            - 0.5 / far
            - square * (1.0 / 12.0 - square * (1.0 / 120.0 - square * (1.0 / 252.0 - square / 240.0)))
    }

    /// `Sum_n 1/|n + y| - 1/|n + 1/2| = 2 psi(1/2) - psi(y) - psi(1 - y)`.
    #[test]
    fn a_reciprocal_is_summed_over_all_images() {
        let period = 40;
        let weights = window(period);
        let single: Vec<f64> =
            (0..weights.len()).map(|index| period as f64 / (index as f64).max(0.5)).collect();
        let mut row = vec![0.0; period];
        fold(&single, &weights, false, 0.0, &mut row);
        for place in [1, 4, 10, 16, 39] {
            let y = place as f64 / period as f64;
            let exact = 2.0 * digamma(0.5) - digamma(y) - digamma(1.0 - y);
            let found = row[place] - row[period / 2];
            // what the window's spectrum leaves, and rounding of sums up to 100
            assert!((found - exact).abs() < 1e-12 + 1e-14 * exact.abs(), "{y}: {found} {exact}");
        }
    }

    #[test]
    fn a_row_is_even_or_odd_about_half_a_period_to_the_bit_and_has_the_mean_of_a_uniform_traction() {
        let period = 12;
        let weights = window(period);
        let single: Vec<f64> = (0..weights.len()).map(|index| 1.0 / (1.0 + index as f64)).collect();
        let mut row = vec![0.0; period];
        fold(&single, &weights, false, 7.0, &mut row);
        assert!((row.iter().sum::<f64>() - 7.0).abs() < 1e-13);
        assert!((1..period).all(|place| row[place] == row[period - place]));
        fold(&single, &weights, true, 7.0, &mut row);
        assert!((1..period).all(|place| row[place] == -row[period - place]) && row[6] == 0.0);
    }

    #[test]
    fn a_window_falls_from_one_to_nothing() {
        let weights = window(16);
        assert_eq!(weights.len(), 200);
        assert!(weights[..=8].iter().all(|weight| *weight == 1.0));
        assert!(weights.is_sorted_by(|one, next| one >= next) && weights.iter().all(|weight| *weight >= 0.0));
        // half-way, half
        assert!((0.5 * (weights[104] + weights[105]) - 0.5).abs() < 0.05);
    }
}
