//! A kernel in real space from its transfer function: the inverse transform of a quadrant of wavenumbers, kept in a window of
//! offsets.

use ndarray::Array2;
use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::Symbol;
use super::fourier::{Frequencies, LineTransform};

/// Kernel of a transfer function on a periodic grid of `period = [nx, ny]` cells, at the offsets `(i, j)`, `i < window[0]`,
/// `j < window[1]`:
///
/// `K[i, j] = 1/(nx ny) * sum over all wavenumber indices (a, b) of S(a, b) exp(2 pi I (a i/nx + b j/ny))`
///
/// with the values and parity of a [`Symbol`]. Cost: a quarter of a complex transform of the grid and less, the smaller the
/// window.
///
/// # Panics
/// When the symbol has fewer than `(nx/2 + 1) x (ny/2 + 1)` values, or the window is larger than the period.
pub fn inverse_table(symbol: &Symbol<'_>, period: [usize; 2], window: [usize; 2]) -> Array2<f64> {
    let waves = period.map(|n| n / 2 + 1);
    let found = symbol.values.dim();
    assert!(
        found.0 >= waves[0] && found.1 >= waves[1],
        "a symbol of {found:?} values does not cover {waves:?}"
    );
    assert!(
        window[0] <= period[0] && window[1] <= period[1],
        "window {window:?} exceeds the period {period:?}"
    );
    let [odd_x, odd_y] = symbol.parity.odd();
    let columns = Array2::from_shape_fn([waves[1], waves[0]], |(b, a)| symbol.values[[a, b]]);
    let along_x = inverse_lines(&columns, period[0], odd_x, window[0]);
    let rows = Array2::from_shape_fn([window[0], waves[1]], |(i, b)| along_x[[b, i]]);
    inverse_lines(&rows, period[1], odd_y, window[1])
}

/// Inverse transform of each row of values at wavenumbers `0..=period/2`, continued by parity: the first `window` values of
/// the row of cosines, or of sines along an odd axis.
fn inverse_lines(rows: &Array2<f64>, period: usize, odd: bool, window: usize) -> Array2<f64> {
    let transform = LineTransform::new(period, Frequencies::Whole);
    let zero = Complex::new(0.0, 0.0);
    let mut output = Array2::zeros([rows.nrows(), window]);
    let Some(values) = output.as_slice_mut() else { unreachable!("a new array is contiguous") };
    // two rows travel as real and imaginary part of one line: both spectra are real, so their transforms stay apart
    values.par_chunks_mut((2 * window).max(1)).enumerate().for_each_init(
        || (vec![zero; period], vec![zero; transform.scratch_len()]),
        |(line, scratch), (pair, window_values)| {
            let (first, second) = (2 * pair, (2 * pair + 1).min(rows.nrows() - 1));
            let at = |a: usize| Complex::new(rows[[first, a]], rows[[second, a]]);
            let half = period / 2;
            line[0] = if odd { zero } else { at(0) };
            for a in 1..period.div_ceil(2) {
                let value = at(a);
                line[a] = value;
                line[period - a] = if odd { -value } else { value };
            }
            if period.is_multiple_of(2) {
                line[half] = if odd { zero } else { at(half) };
            }
            transform.inverse(line, scratch);
            let scale = 1.0 / period as f64;
            for (row, values) in window_values.chunks_mut(window).enumerate() {
                for (value, sum) in values.iter_mut().zip(line.iter()) {
                    // odd: I times the sines of both rows, so that the first is the imaginary part, the second minus the real one
                    *value = scale
                        * match (odd, row) {
                            (false, 0) => sum.re,
                            (false, _) | (true, 0) => sum.im,
                            (true, _) => -sum.re,
                        };
                }
            }
        },
    );
    output
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::{Block, Parity, PeriodicProduct};
    use super::*;

    fn values(shape: [usize; 2]) -> Array2<f64> {
        // any numbers without symmetry
        Array2::from_shape_fn(shape, |(a, b)| ((3 * a * a + 7 * b + a * b) as f64 * 0.37).sin())
    }

    #[test]
    fn the_window_holds_the_plain_sum_over_all_wavenumbers() {
        for period in [[8, 6], [7, 5], [1, 9], [12, 2], [1, 1]] {
            let table = values(period.map(|n| n / 2 + 1));
            for parity in [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd, Parity::OddOdd] {
                let symbol = Symbol { values: table.view(), parity };
                let window = period.map(|n: usize| n.div_ceil(2));
                let found = inverse_table(&symbol, period, window);
                assert_eq!(found.dim(), (window[0], window[1]));
                let wave = |axis: usize, index: usize, offset: usize| {
                    let phase = TAU * (index * offset) as f64 / period[axis] as f64;
                    let twice = if index == 0 || 2 * index == period[axis] { 1.0 } else { 2.0 };
                    twice * if parity.odd()[axis] { phase.sin() } else { phase.cos() }
                };
                for ((i, j), found) in found.indexed_iter() {
                    let exact: f64 = table
                        .indexed_iter()
                        .map(|((a, b), value)| value * wave(0, a, i) * wave(1, b, j))
                        .sum::<f64>()
                        / (period[0] * period[1]) as f64;
                    assert!((found - exact).abs() < 1e-14, "{period:?} {parity:?} ({i}, {j})"); // sums of numbers below 1
                }
            }
        }
    }

    #[test]
    fn it_is_the_periodic_answer_to_one_loaded_cell() {
        let period = [10, 12];
        let table = values([6, 7]);
        for parity in [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd, Parity::OddOdd] {
            let symbol = Symbol { values: table.view(), parity };
            let block = Block { output: 0, input: 0, kernel: 0, sign: 1.0 };
            let product = PeriodicProduct::new(period, &[symbol], &[block]).unwrap();
            let mut input = vec![0.0; 120];
            input[0] = 1.0;
            let mut output = vec![0.0; 120];
            product.apply(&mut product.workspace(), &[&input], &mut [&mut output]);
            let found = inverse_table(&symbol, period, period);
            for (found, exact) in found.iter().zip(&output) {
                assert!((found - exact).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn more_values_than_needed_do_not_matter() {
        let table = values([6, 8]);
        let needed = table.slice(ndarray::s![..4, ..5]);
        for parity in [Parity::EvenEven, Parity::OddOdd] {
            let by = |values| inverse_table(&Symbol { values, parity }, [6, 9], [6, 4]);
            assert_eq!(by(table.view()), by(needed));
        }
    }

    #[test]
    #[should_panic(expected = "a symbol of (3, 3) values does not cover [4, 3]")]
    fn a_symbol_that_is_too_short_along_x_is_refused() {
        inverse_table(&Symbol { values: values([3, 3]).view(), parity: Parity::EvenEven }, [6, 4], [1, 1]);
    }

    #[test]
    #[should_panic(expected = "a symbol of (4, 2) values does not cover [4, 3]")]
    fn a_symbol_that_is_too_short_along_y_is_refused() {
        inverse_table(&Symbol { values: values([4, 2]).view(), parity: Parity::EvenEven }, [6, 4], [1, 1]);
    }

    #[test]
    #[should_panic(expected = "window [7, 1] exceeds the period [6, 4]")]
    fn a_window_longer_than_the_period_is_refused() {
        inverse_table(&Symbol { values: values([4, 3]).view(), parity: Parity::EvenEven }, [6, 4], [7, 1]);
    }

    #[test]
    #[should_panic(expected = "window [1, 5] exceeds the period [6, 4]")]
    fn a_window_wider_than_the_period_is_refused() {
        inverse_table(&Symbol { values: values([4, 3]).view(), parity: Parity::EvenEven }, [6, 4], [1, 5]);
    }
}
