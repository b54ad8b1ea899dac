//! What the waves that a grid cannot tell from its own add to the response of its cells.
//!
//! A field of cells is not of the grid's waves alone: with a wave `k` go its aliases `k + G`, `G = 2 pi (m/dx, n/dy)`, and what stands at
//! the cells' centres is
//!
//! ```text
//! S(k) = Sum_G T(k + G) a(k + G),        a(k) = sin(kx dx/2)/(kx dx/2) sin(ky dy/2)/(ky dy/2)
//! ```
//!
//! The sum of all but the wave itself, `S(k) - T(k) a(k)`, is smooth: the nearest wavenumber where it is not, is that of an alias at rest, as
//! far from the last wave of the grid as that from 0. So it is taken from a small period of the same cells, whose sum `S` over all images is
//! known in space, and interpolated between the wavenumbers of that: by polynomials through [`REACH`] of them on either side, which go on
//! beyond the last wave of the grid since `S` repeats. Its cost does not grow with the grid.

use fret_fft::{Kernel, Parity, PeriodicProduct};
use ndarray::{Array2, ArrayView2};

use super::interpolation::{REACH, lagrange};

/// Cells in the small period, of the longer side. A pole of the response at a right angle, or an alias at rest, is 16 wavenumbers from the last.
const CELLS: usize = 32;
/// Cells that a small period has at the least: a window that falls over some periods is to see single cells from afar.
const LEAST: usize = 8;

/// Cells in the small period: as long along both axes, since aliases along one change with the wave along the other over their own wavenumber. A
/// grid that is no longer serves itself, as many times as it must.
pub(super) fn small_period(cells: [usize; 2], spacing: [f64; 2]) -> [usize; 2] {
    let longer = spacing[0].max(spacing[1]);
    [0, 1].map(|axis| {
        let enough = CELLS as f64 * (longer / spacing[axis]).ceil();
        if enough < cells[axis] as f64 { enough as usize } else { cells[axis] * LEAST.div_ceil(cells[axis]) }
    })
}

/// How many wavenumbers of the small period are used, from 0 on.
pub(super) fn nodes(period: [usize; 2]) -> [usize; 2] {
    period.map(|period| period / 2 + REACH + 1)
}

/// What aliases add at the wavenumbers of a grid of `cells`, from what they add at those of a small period: `all`, over the offsets of that, is
/// what a cell and all its images do; `own`, over its [nodes], what the waves themselves do.
pub(super) fn aliases(
    all: &Array2<f64>,
    own: &ArrayView2<'_, f64>,
    odd: [bool; 2],
    cells: [usize; 2],
) -> Array2<f64> {
    let period = [all.nrows(), all.ncols()];
    let parity = match odd {
        [false, false] => Parity::EvenEven,
        [true, false] => Parity::OddEven,
        [false, true] => Parity::EvenOdd,
        [true, true] => Parity::OddOdd,
    };
    let sums = PeriodicProduct::symbol_of(period, &Kernel { values: all.view(), parity });
    let folded = [0, 1].map(|axis| {
        let fold = |node: usize| {
            let index = node % period[axis];
            let mirrored = 2 * index > period[axis];
            let sign = if mirrored && odd[axis] { -1.0 } else { 1.0 };
            (if mirrored { period[axis] - index } else { index }, sign)
        };
        (0..nodes(period)[axis]).map(fold).collect::<Vec<_>>()
    });
    let rest = Array2::from_shape_fn(own.dim(), |(a, b)| {
        let ((x, sign_x), (y, sign_y)) = (folded[0][a], folded[1][b]);
        // of a uniform traction averaging over a cell leaves no alias
        if a + b == 0 { 0.0 } else { sign_x * sign_y * sums[[x, y]] - own[[a, b]] }
    });
    let along_x = between(&rest.view(), odd[0], period[0], cells[0]);
    between(&along_x.t(), odd[1], period[1], cells[1]).reversed_axes()
}

/// Rows at the wavenumbers of so many cells, from rows at those of a small period.
fn between(nodes: &ArrayView2<'_, f64>, is_odd: bool, period: usize, cells: usize) -> Array2<f64> {
    let mut rows = Array2::zeros((cells / 2 + 1, nodes.ncols()));
    for (index, mut row) in rows.rows_mut().into_iter().enumerate() {
        let (start, weights) = lagrange((index * period) as f64 / cells as f64 + (REACH - 1) as f64);
        for (place, weight) in weights.into_iter().enumerate().filter(|(_, weight)| *weight != 0.0) {
            let node = (start + place).abs_diff(REACH - 1);
            let mirrored = start + place < REACH - 1;
            row.scaled_add(if mirrored && is_odd { -weight } else { weight }, &nodes.row(node));
        }
    }
    rows
}
