//! Influence coefficients by sampling the frequency response on an extended grid: the conversion most of the literature uses.
//! For comparisons only: [`influence_coefficients`](super::influence_coefficients) is right to rounding at the price of
//! an extension by four.

use std::f64::consts::TAU;

use ndarray::Array2;

use super::influence::{Components, InfluenceCoefficients};
use super::pair_response::PairResponse;
use super::periodic::periodic_symbols;
use crate::model::ContactPair;
use fret_fft::{Parity, Symbol, inverse_table};

/// Influence coefficients of a pair from its frequency response sampled at the wavenumbers of a grid `extension` times as long
/// and wide, of the same `spacing` \[length\]; conventions as [`InfluenceCoefficients`].
///
/// The response times the cell's factors `sin(k d/2)/(k d/2)`, transformed back by FFT, and of that the offsets below `cells`:
/// Liu & Wang (2002), J. Tribol. 124, 36 (Polonsky & Keer 2000, J. Tribol. 122, 30, correct for the images instead). The
/// response is singular at `k = 0`, where the sample is replaced: `zz` by the response at the wavenumber whose reciprocal is
/// the mean of `1/k` over the frequency cell, `xx` and `yy` likewise with the directions weighted, the others by 0.
///
/// What this does to the result: waves shorter than two cells are cut off (up to 15 % of the own cell's value, whatever the
/// extension), and the images of the load, `extension` grids apart, shift all values: 1e-2 of a distant cell's value, 4e-2 and
/// more at the grid's end. With `extension = 1` offsets beyond half the grid are those of the next image; 0 counts as 1.
/// Cost: `extension^2` times as many responses as cells, and a transform as large for each component.
pub fn sampled_coefficients(
    pair: &ContactPair,
    cells: [usize; 2],
    spacing: [f64; 2],
    wanted: Components,
    extension: usize,
) -> InfluenceCoefficients {
    let period = cells.map(|n| n * extension.max(1));
    let mut symbols = periodic_symbols(pair, period, spacing, wanted, 0);
    let origin = Origin::new(pair, [0, 1].map(|axis| TAU / (period[axis] as f64 * spacing[axis])));
    for (symbol, value) in
        [(&mut symbols.zz, origin.zz), (&mut symbols.xx, origin.xx), (&mut symbols.yy, origin.yy)]
    {
        if let Some(symbol) = symbol {
            symbol[[0, 0]] = value;
        }
    }
    let table = |values: &Option<Array2<f64>>, parity| {
        let values = values.as_ref()?;
        Some(inverse_table(&Symbol { values: values.view(), parity }, period, cells))
    };
    InfluenceCoefficients {
        zz: table(&symbols.zz, Parity::EvenEven),
        xx: table(&symbols.xx, Parity::EvenEven),
        yy: table(&symbols.yy, Parity::EvenEven),
        xy: table(&symbols.xy, Parity::OddOdd),
        zx: table(&symbols.zx, Parity::OddEven),
        zy: table(&symbols.zy, Parity::EvenOdd),
    }
}

/// What stands for the response at `k = 0`.
struct Origin {
    zz: f64,
    xx: f64,
    yy: f64,
}

impl Origin {
    /// Means over a frequency cell of the given sides `a`, `b`, by the closed integrals of `kx^2/k^3` and `ky^2/k^3` over it:
    /// `2 b asinh(a/b)` and `2 a asinh(b/a)`.
    fn new(pair: &ContactPair, [a, b]: [f64; 2]) -> Self {
        let along = 2.0 * libm::asinh(a / b) / a;
        let across = 2.0 * libm::asinh(b / a) / b;
        let response = PairResponse::new(pair).times_k(1.0 / (along + across));
        Self {
            zz: response.zz * (along + across),
            xx: response.rr * along + response.tt * across,
            yy: response.rr * across + response.tt * along,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::influence::influence_coefficients;
    use super::super::samples::pair;
    use super::*;

    fn arrays(coefficients: InfluenceCoefficients) -> [Array2<f64>; 6] {
        let InfluenceCoefficients { zz, xx, yy, xy, zx, zy } = coefficients;
        [zz, xx, yy, xy, zx, zy].map(Option::unwrap)
    }

    #[test]
    fn sampling_on_larger_grids_comes_nearer_between_the_ends() {
        let pair = pair(&[(2.0, 0.3, 4.0)], Some((1.0, 0.3)));
        let spacing = [1.0, 1.5];
        let exact = arrays(influence_coefficients(&pair, [32, 24], spacing, Components::ALL));
        let error = |extension, i: usize, j: usize| {
            let found = arrays(sampled_coefficients(&pair, [32, 24], spacing, Components::ALL, extension));
            let worst = found.iter().zip(&exact).map(|(f, e)| (f[[i, j]] - e[[i, j]]).abs());
            worst.fold(0.0, f64::max) / exact[0][[i, j]]
        };
        for (i, j) in [(8, 0), (9, 7), (31, 23)] {
            let errors = [2, 4, 8].map(|extension| error(extension, i, j));
            assert!(errors[2] < errors[0] && errors[2] < 0.1, "({i}, {j}): {errors:?}");
        }
        // the cut spectrum is felt in the own cell at any extension
        assert!(error(8, 0, 0) > 0.05);
    }

    #[test]
    fn smooth_kernels_are_sampled_without_loss() {
        // on a rigid base the coefficients die off within the period: images and origin do no harm, the cut spectrum does not
        // reach the far cells
        let pair = pair(&[(1.0, 0.3, 2.0)], None);
        let exact = arrays(influence_coefficients(&pair, [24, 24], [1.0, 1.0], Components::ALL));
        let found = arrays(sampled_coefficients(&pair, [24, 24], [1.0, 1.0], Components::ALL, 4));
        let own = exact[0][[0, 0]];
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found[[9, 7]] - exact[[9, 7]]).abs() < 3e-3 * own);
        }
    }

    #[test]
    fn only_what_is_wanted_is_there_on_any_grid() {
        let pair = pair(&[], Some((1.0, 0.3)));
        let found = sampled_coefficients(&pair, [5, 1], [1.0, 1.0], Components::TANGENTIAL, 3);
        assert!(found.zz.is_none() && found.zx.is_none());
        assert_eq!(found.xy.unwrap().dim(), (5, 1));
    }
}
