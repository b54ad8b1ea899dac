//! Groups of as many rows as there are lanes: turned into vectors across the rows, and back; and where they lie.

use ndarray::{ArrayViewMut2, ArrayViewMut3, Axis, ShapeBuilder};

use super::memory::{Line, as_lines, as_lines_mut, as_vectors, as_vectors_mut};
use super::simd::{Lanes, MAX_WIDTH, Number, Task};

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
    /// Numbers of a row group in one strip.
    pub group_len: usize,
    /// Row groups of a field.
    pub groups: usize,
    /// Numbers from one strip to the next in the spectra: `[strip][field][group][row of the group]`.
    pub strip_stride: usize,
}

impl Layout {
    /// Numbers of a field in one strip.
    pub fn field_len(&self) -> usize {
        self.groups * self.group_len
    }

    /// Numbers of the spectra.
    pub fn spectra_len(&self) -> usize {
        self.strips * self.strip_stride
    }

    /// The row groups of so many fields in their spectra.
    ///
    /// # Panics
    /// When there are fewer than [`spectra_len`](Self::spectra_len) numbers.
    pub fn groups_in<'a, N: Number>(&self, spectra: &'a mut [N], fields: usize) -> RowGroups<'a, N> {
        let shape = (self.strips, fields * self.groups, self.group_len);
        let strides = (self.strip_stride, self.group_len, 1);
        let strips = ArrayViewMut3::from_shape(shape.strides(strides), &mut spectra[..self.spectra_len()]);
        RowGroups {
            strips: strips.unwrap_or_else(|error| panic!("the spectra have another layout: {error}")),
        }
    }
}

/// Row groups of spectra, each with a part in every strip.
pub struct RowGroups<'a, N> {
    /// `[strip][group][number]`
    strips: ArrayViewMut3<'a, N>,
}

impl<N: Number> RowGroups<'_, N> {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.strips.len_of(Axis(1))
    }

    /// The first `count`, or all, and the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.len());
        let (first, others) = self.strips.split_at(Axis(1), count);
        (Self { strips: first }, Self { strips: others })
    }

    /// One after the other.
    pub fn each(&mut self) -> impl Iterator<Item = RowGroup<'_, N>> {
        self.strips.axis_iter_mut(Axis(1)).map(|strips| RowGroup { strips })
    }
}

/// One row group of a spectrum.
pub struct RowGroup<'a, N> {
    /// `[strip][number]`
    strips: ArrayViewMut2<'a, N>,
}

impl<N: Number> RowGroup<'_, N> {
    /// Zero everywhere.
    pub fn clear(&mut self) {
        self.strips.fill(N::default());
    }

    /// Its part of each strip, `[row of the group]`.
    #[inline(always)]
    pub fn parts<L: Lanes<Number = N>>(&mut self) -> impl Iterator<Item = &mut [Line<L>]> {
        self.strips
            .rows_mut()
            .into_iter()
            .map(|part| as_lines_mut::<L>(part.into_slice().unwrap_or_default()))
    }
}

/// Real and imaginary parts of the rows of one group in one strip of the spectra, from a field on; zero for rows that are not there.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Two fields of two row groups of 8 numbers, in 3 strips with 4 more numbers each: each row group gets a number, wherever they are
    /// divided; what lies between the strips stays.
    #[test]
    fn a_row_group_has_its_place_in_every_strip() {
        let layout = Layout {
            shape: [4, 6],
            column_len: 4,
            rows_read: 4,
            strips: 3,
            group_len: 8,
            groups: 2,
            strip_stride: 36,
        };
        assert_eq!((layout.field_len(), layout.spectra_len()), (16, 108));
        for first in 0..=5 {
            let mut spectra = vec![9.0; 110];
            let (before, behind) = layout.groups_in(&mut spectra, 2).split_at(first);
            assert_eq!((before.len(), behind.len()), (first.min(4), 4 - first.min(4)));
            let mut place = 0.0;
            for mut groups in [before, behind] {
                for mut group in groups.each() {
                    group.clear();
                    group.strips.mapv_inplace(|number| number + place);
                    place += 1.0;
                }
            }
            for (index, number) in spectra.iter().enumerate() {
                let (strip, within) = (index / 36, index % 36);
                assert_eq!(*number, if strip < 3 && within < 32 { (within / 8) as f64 } else { 9.0 });
            }
        }
    }
}
