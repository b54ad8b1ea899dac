//! Groups of as many rows as there are lanes: turned into vectors across the rows, and back; and where they lie.

use super::memory::{as_lines, as_vectors, as_vectors_mut};
use super::simd::{Lanes, MAX_WIDTH, Task};

/// Where things are: see the fields.
#[derive(Debug, Clone, Copy)]
pub struct Layout {
    /// Cells of the fields, `[nx, ny]`.
    pub shape: [usize; 2],
    /// Lines of a column: the transform length along `x`.
    pub column_len: usize,
    /// Rows that the column stage reads: the cells and, up to a whole part of its outermost pass, zeros.
    pub rows_read: usize,
    /// Strips of frequencies along `y`.
    pub strips: usize,
    /// Numbers from one row group to the next, in the spectrum of one input: `[group][strip][row of the group]`.
    pub group_stride: usize,
    /// Numbers from one strip to the next in the spectra of the outputs: `[strip][output][row]`.
    pub strip_stride: usize,
}

/// Real and imaginary parts of the rows of one group in one strip of the outputs' spectra; zero for rows that are not there.
#[inline(always)]
pub fn rows_of_strip<L: Lanes>(
    lanes: L,
    layout: &Layout,
    spectrum: &[L::Number],
    strip: usize,
    group: usize,
    re: &mut L::Block,
    im: &mut L::Block,
) {
    let first = group * L::WIDTH;
    let rows = layout.column_len.saturating_sub(first).min(L::WIDTH);
    if rows == L::WIDTH {
        let begin = strip * layout.strip_stride + first * 2 * L::WIDTH;
        let column = as_lines::<L>(&spectrum[begin..][..2 * L::WIDTH * L::WIDTH]);
        for row in 0..L::WIDTH {
            [re[row], im[row]] = column[row];
        }
        return;
    }
    for row in 0..L::WIDTH {
        [re[row], im[row]] = [lanes.zero(); 2];
    }
    if rows > 0 {
        let begin = strip * layout.strip_stride + first * 2 * L::WIDTH;
        let column = as_lines::<L>(&spectrum[begin..][..rows * 2 * L::WIDTH]);
        for (row, line) in column.iter().enumerate() {
            [re[row], im[row]] = *line;
        }
    }
}

/// Real rows of `ny` numbers to vectors across the rows; what is not there is zero.
#[inline(always)]
pub fn gather_rows<L: Lanes>(lanes: L, rows: &[L::Number], ny: usize, staging: &mut [L::Reals]) {
    lanes.enter(GatherRows::<L> { rows, ny, staging });
}

struct GatherRows<'a, L: Lanes> {
    rows: &'a [L::Number],
    ny: usize,
    staging: &'a mut [L::Reals],
}

impl<L: Lanes> Task<L> for GatherRows<'_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let full = self.ny / L::WIDTH;
        let mut whole: [&[L::Reals]; MAX_WIDTH] = [&[]; MAX_WIDTH];
        let mut rest: [&[L::Number]; MAX_WIDTH] = [&[]; MAX_WIDTH];
        for (row, (whole, rest)) in self.rows.chunks_exact(self.ny).zip(whole.iter_mut().zip(&mut rest)) {
            let (vectors, numbers) = row.split_at(full * L::WIDTH);
            (*whole, *rest) = (as_vectors::<L>(vectors), numbers);
        }
        let mut blocks = self.staging.chunks_exact_mut(L::WIDTH);
        for (index, vectors) in (&mut blocks).take(full).enumerate() {
            let mut block = lanes.block(lanes.zero());
            for row in 0..L::WIDTH {
                if let Some(vector) = whole[row].get(index) {
                    block[row] = *vector;
                }
            }
            lanes.transpose(&mut block);
            for row in 0..L::WIDTH {
                vectors[row] = block[row];
            }
        }
        for vectors in blocks {
            let mut block = lanes.block(lanes.zero());
            for row in 0..L::WIDTH {
                let mut padded = [L::Number::default(); MAX_WIDTH];
                for (to, from) in padded.iter_mut().zip(rest[row]) {
                    *to = *from;
                }
                block[row] = as_vectors::<L>(&padded)[0];
                rest[row] = &[];
            }
            lanes.transpose(&mut block);
            for row in 0..L::WIDTH {
                vectors[row] = block[row];
            }
        }
    }
}

/// Vectors across rows back to rows of `ny` numbers.
#[inline(always)]
pub fn scatter_rows<L: Lanes>(lanes: L, staging: &[L::Reals], rows: &mut [L::Number], ny: usize) {
    lanes.enter(ScatterRows::<L> { staging, rows, ny });
}

struct ScatterRows<'a, L: Lanes> {
    staging: &'a [L::Reals],
    rows: &'a mut [L::Number],
    ny: usize,
}

impl<L: Lanes> Task<L> for ScatterRows<'_, L> {
    #[inline(always)]
    fn run(self, lanes: L) {
        let full = self.ny / L::WIDTH;
        let mut whole: [&mut [L::Reals]; MAX_WIDTH] = std::array::from_fn(|_| Default::default());
        let mut rest: [&mut [L::Number]; MAX_WIDTH] = std::array::from_fn(|_| Default::default());
        for (row, (whole, rest)) in self.rows.chunks_exact_mut(self.ny).zip(whole.iter_mut().zip(&mut rest)) {
            let (vectors, numbers) = row.split_at_mut(full * L::WIDTH);
            (*whole, *rest) = (as_vectors_mut::<L>(vectors), numbers);
        }
        for (index, vectors) in self.staging.chunks_exact(L::WIDTH).enumerate().take(full + 1) {
            let mut block = lanes.block(lanes.zero());
            for row in 0..L::WIDTH {
                block[row] = vectors[row];
            }
            lanes.transpose(&mut block);
            if index < full {
                for row in 0..L::WIDTH {
                    if let Some(vector) = whole[row].get_mut(index) {
                        *vector = block[row];
                    }
                }
            } else {
                for row in 0..L::WIDTH {
                    let mut padded = [L::Number::default(); MAX_WIDTH];
                    as_vectors_mut::<L>(&mut padded)[0] = block[row];
                    for (to, from) in rest[row].iter_mut().zip(&padded) {
                        *to = *from;
                    }
                }
            }
        }
    }
}
