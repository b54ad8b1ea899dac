//! How the surface responds, as far as a grid needs to know it: coefficients or symbols, each component with its parity and its sign.

use ndarray::Array2;

use super::operator::SelfInfluence;
use crate::kernel::{InfluenceCoefficients, PeriodicSymbols};
use crate::model::Symmetry;
use fret_fft::{Block, Mirrors, Parity};

/// How the surface responds, as far as a grid needs to know it.
#[derive(Debug, Clone)]
pub enum SurfaceResponse {
    /// A non-periodic problem: coefficients over cell offsets.
    FreeSpace(InfluenceCoefficients),
    /// A periodic problem: the response at the grid's own wavenumbers.
    Periodic(PeriodicSymbols),
}

impl SurfaceResponse {
    /// Normal displacement by unit pressure whose sign changes from each cell to the next [length/pressure]: on half-spaces the least of
    /// all patterns of pressure. Of line contacts, too, it does not know the datum.
    pub fn alternating_normal(&self) -> f64 {
        match self {
            Self::FreeSpace(coefficients) => coefficients.zz.as_ref().map_or(0.0, alternating_sum),
            Self::Periodic(symbols) => symbols.zz.as_ref().and_then(|zz| zz.last().copied()).unwrap_or(0.0),
        }
    }

    /// Coefficients or symbols zz, xx, yy, xy, zx, zy.
    pub fn parts(&self) -> [&Option<Array2<f64>>; 6] {
        match self {
            Self::FreeSpace(c) => [&c.zz, &c.xx, &c.yy, &c.xy, &c.zx, &c.zy],
            Self::Periodic(s) => [&s.zz, &s.xx, &s.yy, &s.xy, &s.zx, &s.zy],
        }
    }

    /// Whether the problem is periodic.
    pub fn is_periodic(&self) -> bool {
        matches!(self, Self::Periodic(_))
    }
}

pub(super) const fn block(output: usize, input: usize, kernel: usize, sign: f64) -> Block {
    Block { output, input, kernel, sign }
}

/// Inputs and outputs z, x, y; kernels zz, xx, yy, xy, zx, zy. `u_x` from pressure is minus `u_z` from `q_x` (reciprocity of odd kernels).
pub(super) const FULL_BLOCKS: [Block; 9] = [
    block(0, 0, 0, 1.0),
    block(1, 1, 1, 1.0),
    block(2, 2, 2, 1.0),
    block(1, 2, 3, 1.0),
    block(2, 1, 3, 1.0),
    block(0, 1, 4, 1.0),
    block(1, 0, 4, -1.0),
    block(0, 2, 5, 1.0),
    block(2, 0, 5, -1.0),
];

/// The kernels that the blocks of [`FULL_BLOCKS`] name, each with its parity.
pub(super) fn signed_kernels(c: &InfluenceCoefficients) -> [(&Option<Array2<f64>>, Parity); 6] {
    [
        (&c.zz, Parity::EvenEven),
        (&c.xx, Parity::EvenEven),
        (&c.yy, Parity::EvenEven),
        (&c.xy, Parity::OddOdd),
        (&c.zx, Parity::OddEven),
        (&c.zy, Parity::EvenOdd),
    ]
}

/// Influence of a cell on itself; zero where the coefficient is absent.
pub(super) fn own_of(c: &InfluenceCoefficients) -> SelfInfluence {
    let own = |values: &Option<Array2<f64>>| values.as_ref().map_or(0.0, |values| values[[0, 0]]);
    SelfInfluence { normal: own(&c.zz), tangential: own(&c.xx).min(own(&c.yy)) }
}

/// Sum over all offsets of both signs, each cell with the opposite sign of its neighbours. The last two along an axis count a quarter
/// and three quarters: what lies beyond alternates and falls smoothly, and all but its curvature cancels.
fn alternating_sum(coefficients: &Array2<f64>) -> f64 {
    let weight = |index: usize, count: usize| match count - index {
        _ if index == 0 => 1.0,
        1 if count == 2 => 1.0,
        1 => 0.5,
        2 => 1.5,
        _ => 2.0,
    };
    let [nx, ny] = [0, 1].map(|axis| coefficients.shape()[axis]);
    let sign = |i: usize, j: usize| if (i + j).is_multiple_of(2) { 1.0 } else { -1.0 };
    coefficients
        .indexed_iter()
        .map(|((i, j), value)| sign(i, j) * weight(i, nx) * weight(j, ny) * value)
        .sum()
}

/// The symbols that the blocks of [`FULL_BLOCKS`] name, each with its parity.
pub(super) fn signed_symbols(symbols: &PeriodicSymbols) -> [(&Option<Array2<f64>>, Parity); 6] {
    [
        (&symbols.zz, Parity::EvenEven),
        (&symbols.xx, Parity::EvenEven),
        (&symbols.yy, Parity::EvenEven),
        (&symbols.xy, Parity::OddOdd),
        (&symbols.zx, Parity::OddEven),
        (&symbols.zy, Parity::EvenOdd),
    ]
}

/// Influence of a cell and of its periodic images on itself: the mean of the symbol over all wavenumbers.
pub(super) fn own_in_period(symbols: &PeriodicSymbols, shape: [usize; 2]) -> SelfInfluence {
    let times = |index: usize, count: usize| if index == 0 || 2 * index == count { 1.0 } else { 2.0 };
    let own = |values: &Option<Array2<f64>>| {
        values.as_ref().map_or(0.0, |values| {
            let sum: f64 = values
                .indexed_iter()
                .map(|((a, b), value)| times(a, shape[0]) * times(b, shape[1]) * value)
                .sum();
            sum / (shape[0] * shape[1]) as f64
        })
    };
    SelfInfluence { normal: own(&symbols.zz), tangential: own(&symbols.xx).min(own(&symbols.yy)) }
}

/// How fields (0: normal, 1 and 2: along x and y) go on behind the mirrors.
pub(crate) fn mirrors(symmetry: Symmetry, fields: &[usize]) -> Mirrors {
    if !symmetry.any() {
        return Mirrors::NONE;
    }
    let parity = |field: &usize| match field.checked_sub(1).map(|component| symmetry.shear_is_odd(component))
    {
        None | Some([false, false]) => Parity::EvenEven,
        Some([true, false]) => Parity::OddEven,
        Some([false, true]) => Parity::EvenOdd,
        Some([true, true]) => Parity::OddOdd,
    };
    Mirrors { axes: symmetry.axes(), inputs: fields.iter().map(parity).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Components, influence_coefficients, line_coefficients, periodic_symbols};
    use crate::model::{Body, ContactPair, ElasticMaterial, HalfSpace};

    /// Alternating strips of side 1 on a half-space of `E* = 1`: pressure `Sum 4/(pi m) cos(pi m x)` over odd m, displacement
    /// `2/(E* pi m)` times each, `8/pi^2` times Catalan's constant in the middle of a strip. Alternating squares likewise, from a double
    /// series, `m` and `n` odd: `Sum (16/(pi^2 m n)) (+-1) 2/(pi sqrt(m^2 + n^2))`, summed by averages of its partial sums.
    #[test]
    fn alternating_pressure_displaces_by_its_fourier_series_whatever_the_datum() {
        let elastic = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.0).unwrap());
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(elastic)).unwrap();
        let strips = 8.0 / std::f64::consts::PI.powi(2) * 0.915_965_594_177_219;
        for (cells, datum) in [(64, 10.0), (65, 1e4)] {
            let lines = line_coefficients(&pair, cells, 1.0, datum, Components::NORMAL);
            let found = SurfaceResponse::FreeSpace(lines).alternating_normal();
            // The curvature of a logarithm at 64 cells.
            assert!((found - strips).abs() < 1e-4, "{found} {strips}");
        }
        let odd =
            |count: usize| (0..count).map(|k| ((2 * k + 1) as f64, if k % 2 == 0 { 1.0 } else { -1.0 }));
        let partial = |count: usize| -> f64 {
            odd(count)
                .flat_map(|(m, sign)| odd(count).map(move |(n, other)| sign * other / (m * n * m.hypot(n))))
                .sum::<f64>()
                * 32.0
                / std::f64::consts::PI.powi(3)
        };
        let squares = 0.5 * (partial(400) + partial(401));
        let coefficients = influence_coefficients(&pair, [64, 64], [1.0, 1.0], Components::NORMAL);
        let found = SurfaceResponse::FreeSpace(coefficients).alternating_normal();
        assert!((found - squares).abs() < 1e-4, "{found} {squares}");
    }

    /// In a period a wave of unit pressure displaces by `2/(E* k)` times the cell's factor `2/pi` along each axis that it alternates along.
    #[test]
    fn in_a_period_alternating_pressure_is_one_wave() {
        let elastic = HalfSpace::homogeneous(ElasticMaterial::new(1.0, 0.0).unwrap());
        let pair = ContactPair::new(Body::Rigid, Body::Elastic(elastic)).unwrap();
        let factor = 2.0 / std::f64::consts::PI;
        let squares = factor.powi(3) * std::f64::consts::FRAC_1_SQRT_2;
        for (cells, expected) in [([64, 1], factor.powi(2)), ([64, 32], squares)] {
            let symbols = periodic_symbols(&pair, cells, [1.0, 1.0], Components::NORMAL, 0);
            let found = SurfaceResponse::Periodic(symbols).alternating_normal();
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }
}
