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
    /// Normal displacement of a cell by unit pressure on itself [length/pressure]; `cells` of the grid.
    pub fn own_normal(&self, cells: [usize; 2]) -> f64 {
        match self {
            Self::FreeSpace(coefficients) => own_of(coefficients).normal,
            Self::Periodic(symbols) => own_in_period(symbols, cells).normal,
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
