//! Both products computed line by line with the transforms of [`fourier`](super::fourier), for grids of any size.
//!
//! This is the plain statement of what the lane engine does in another order, and its judge; it also serves single lines, along
//! which it has nothing to pad, and the periodic grids whose lengths the lane engine does not do.

use ndarray::{Array2, ArrayView2, s};
use rustfft::num_complex::Complex;

use super::fourier::{Frequencies, LineTransform};
use super::terms::Terms;
use super::{Kernel, Parity};

/// Columns transformed together, so that each cache line of the spectrum is read once.
const STRIP: usize = 8;

/// Product on the frequencies of a [`LineTransform`] in each direction.
pub(super) struct LineProduct {
    terms: Terms,
    frequencies: Frequencies,
    along_x: LineTransform,
    along_y: LineTransform,
    /// Real factor per frequency `[kx][ky]`, normalisation included; one array per kernel.
    kernels: Vec<Vec<f64>>,
}

impl LineProduct {
    /// Free-space product from the quadrants of the kernels.
    pub fn free_space(terms: Terms, kernels: &[Kernel<'_>]) -> Self {
        let [along_x, along_y] = terms.shape.map(|n| LineTransform::new(n, Frequencies::HalfShifted));
        let scale = 1.0 / (2.0 * terms.cells() as f64);
        let kernels = kernels
            .iter()
            .map(|kernel| half_shifted_spectrum(kernel, [&along_x, &along_y], terms.shape, scale));
        Self { kernels: kernels.collect(), terms, frequencies: Frequencies::HalfShifted, along_x, along_y }
    }

    /// Periodic product from the quadrants of the symbols.
    pub fn periodic(terms: Terms, symbols: &[Kernel<'_>]) -> Self {
        let [along_x, along_y] = terms.shape.map(|n| LineTransform::new(n, Frequencies::Whole));
        let scale = 1.0 / terms.cells() as f64;
        let shape = terms.shape;
        let kernels = symbols.iter().map(|symbol| {
            let [folded_x, folded_y] =
                [0, 1].map(|axis| folded_indices(shape[axis], symbol.parity.odd()[axis]));
            let quarter_turns = if symbol.parity == Parity::EvenEven { scale } else { -scale };
            folded_x
                .iter()
                .flat_map(|&(a, sign_a)| {
                    folded_y.iter().map(move |&(b, sign_b)| (a, b, sign_a * sign_b * quarter_turns))
                })
                .map(|(a, b, factor)| factor * symbol.values[[a, b]])
                .collect()
        });
        Self { kernels: kernels.collect(), terms, frequencies: Frequencies::Whole, along_x, along_y }
    }

    /// Memory of the factors, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.kernels.iter().map(|kernel| size_of_val(kernel.as_slice())).sum()
    }

    /// Complex numbers of work space.
    pub fn scratch_len(&self) -> usize {
        let fields = self.terms.inputs + self.terms.outputs;
        fields * (self.terms.cells() + 2 * STRIP * self.terms.shape[0]) + self.transform_scratch_len()
    }

    fn transform_scratch_len(&self) -> usize {
        self.along_x.scratch_len().max(self.along_y.scratch_len())
    }

    /// `output = sum of blocks`, with `work` of [`scratch_len`](Self::scratch_len).
    pub fn apply(&self, work: &mut [Complex<f64>], input: &[&[f64]], output: &mut [&mut [f64]]) {
        let ny = self.terms.shape[1];
        let (spectra, work) = work.split_at_mut(self.terms.inputs * self.terms.cells());
        let (results, work) = work.split_at_mut(self.terms.outputs * self.terms.cells());
        let (strips, scratch) = work.split_at_mut(work.len() - self.transform_scratch_len());
        for (field, spectrum) in input.iter().zip(spectra.chunks_exact_mut(self.terms.cells())) {
            for (to, &from) in spectrum.iter_mut().zip(*field) {
                *to = Complex::new(from, 0.0);
            }
            self.along_y.forward(spectrum, scratch);
        }
        for first in (0..ny).step_by(STRIP) {
            self.columns(first..ny.min(first + STRIP), spectra, results, strips, scratch);
        }
        for (field, result) in output.iter_mut().zip(results.chunks_exact_mut(self.terms.cells())) {
            self.along_y.inverse(result, scratch);
            for (to, from) in field.iter_mut().zip(result.iter()) {
                *to = from.re;
            }
        }
    }

    /// Parts of each column that are transformed: of a single real column the second would repeat the first.
    fn parts(&self) -> usize {
        if self.frequencies == Frequencies::HalfShifted && self.terms.shape[1] > 1 { 2 } else { 1 }
    }

    /// Forward transform, kernels and inverse transform of some columns of all fields.
    ///
    /// Half-shifted lines have two parts: the columns at `w_k`, and those at `-w_k`, which are the columns at `w_k` of
    /// the field with real and imaginary part exchanged; of a single column, which is real, each gives half of the result.
    fn columns(
        &self,
        columns: std::ops::Range<usize>,
        spectra: &[Complex<f64>],
        results: &mut [Complex<f64>],
        strips: &mut [Complex<f64>],
        scratch: &mut [Complex<f64>],
    ) {
        let [nx, ny] = self.terms.shape;
        let parts = self.parts();
        let part_len = nx * columns.len();
        let (before, after) = strips.split_at_mut(self.terms.inputs * parts * part_len);
        let after = &mut after[..self.terms.outputs * parts * part_len];
        for (spectrum, strip) in spectra.chunks_exact(nx * ny).zip(before.chunks_exact_mut(parts * part_len))
        {
            for (column, ky) in columns.clone().enumerate() {
                for kx in 0..nx {
                    let value = spectrum[kx * ny + ky];
                    strip[column * nx + kx] = value;
                    if parts == 2 {
                        strip[part_len + column * nx + kx] = Complex::new(value.im, value.re);
                    }
                }
            }
        }
        self.along_x.forward(before, scratch);
        after.fill(Complex::default());
        for block in &self.terms.blocks {
            let parity = self.terms.parities[block.kernel];
            for part in 0..parts {
                let sign = if part == 1 && parity.odd()[1] { -block.sign } else { block.sign };
                let from = &before[(block.input * parts + part) * part_len..][..part_len];
                let to = &mut after[(block.output * parts + part) * part_len..][..part_len];
                for (column, ky) in columns.clone().enumerate() {
                    for kx in 0..nx {
                        let factor = sign * self.kernels[block.kernel][kx * ny + ky];
                        let value = from[column * nx + kx] * factor;
                        to[column * nx + kx] +=
                            if parity.is_imaginary() { Complex::new(-value.im, value.re) } else { value };
                    }
                }
            }
        }
        self.along_x.inverse(after, scratch);
        for (result, strip) in results.chunks_exact_mut(nx * ny).zip(after.chunks_exact(parts * part_len)) {
            for (column, ky) in columns.clone().enumerate() {
                for kx in 0..nx {
                    let mut value = strip[column * nx + kx];
                    if parts == 2 {
                        let mirrored = strip[part_len + column * nx + kx];
                        value += Complex::new(mirrored.im, mirrored.re);
                    }
                    if self.frequencies == Frequencies::HalfShifted && parts == 1 {
                        value *= 2.0;
                    }
                    result[kx * ny + ky] = value;
                }
            }
        }
    }
}

/// Real factors of a kernel on the half-shifted grid, `[kx][ky]`: the transform is this, times `i` for each odd axis.
fn half_shifted_spectrum(
    kernel: &Kernel<'_>,
    lines: [&LineTransform; 2],
    shape: [usize; 2],
    scale: f64,
) -> Vec<f64> {
    let odd = kernel.parity.odd();
    let quadrant = kernel.values.slice(s![..shape[0], ..shape[1]]);
    let along_y = one_sided(&quadrant, lines[1], odd[1]);
    let both = one_sided(&along_y.t(), lines[0], odd[0]);
    let sign = if kernel.parity == Parity::OddOdd { -scale } else { scale };
    both.t().iter().map(|value| value * sign).collect()
}

/// `2 Re` (even) or `2 Im` (odd) of the transforms of all rows, each taken once at offset 0 and twice elsewhere.
fn one_sided(rows: &ArrayView2<'_, f64>, transform: &LineTransform, odd: bool) -> Array2<f64> {
    let mut line = vec![Complex::default(); rows.ncols()];
    let mut scratch = vec![Complex::default(); transform.scratch_len()];
    let mut result = Array2::zeros(rows.dim());
    for (row, mut out) in rows.rows().into_iter().zip(result.rows_mut()) {
        for (to, from) in line.iter_mut().zip(row) {
            *to = Complex::new(2.0 * from, 0.0);
        }
        line[0] *= 0.5;
        transform.forward(&mut line, &mut scratch);
        for (to, from) in out.iter_mut().zip(&line) {
            *to = if odd { from.im } else { from.re };
        }
    }
    result
}

/// For each wavenumber index `0..n` its absolute value `|a| <= n/2` and, for odd symbols, its sign.
pub(super) fn folded_indices(n: usize, odd: bool) -> Vec<(usize, f64)> {
    (0..n)
        .map(|index| {
            let absolute = index.min(n - index);
            let sign = match (odd, index.cmp(&(n - index))) {
                (false, _) => 1.0,
                _ if index == 0 => 0.0,
                (true, std::cmp::Ordering::Less) => 1.0,
                (true, std::cmp::Ordering::Equal) => 0.0,
                (true, std::cmp::Ordering::Greater) => -1.0,
            };
            (absolute, sign)
        })
        .collect()
}

/// Symbol values of a periodised kernel, in the convention of [`Symbol`](super::Symbol).
pub(super) fn symbol_of(shape: [usize; 2], kernel: &Kernel<'_>) -> Array2<f64> {
    let along_y = real_symbol_rows(&kernel.values, shape[1], kernel.parity.odd()[1]);
    let rows = along_y.slice(s![..=shape[0] / 2, ..]);
    real_symbol_rows(&rows.t(), shape[0], kernel.parity.odd()[0]).reversed_axes()
}

/// `sum_x K(x) cos(k x)` or `sum_x K(x) sin(k x)` over one period, for the leading `n/2 + 1` values of each row.
fn real_symbol_rows(rows: &ArrayView2<'_, f64>, n: usize, odd: bool) -> Array2<f64> {
    let transform = LineTransform::new(n, Frequencies::Whole);
    let folded = folded_indices(n, odd);
    let mut line = vec![Complex::default(); n];
    let mut scratch = vec![Complex::default(); transform.scratch_len()];
    let mut result = Array2::zeros((rows.nrows(), n / 2 + 1));
    for (row, mut out) in rows.rows().into_iter().zip(result.rows_mut()) {
        for (to, &(offset, sign)) in line.iter_mut().zip(&folded) {
            *to = Complex::new(sign * row[offset], 0.0);
        }
        transform.forward(&mut line, &mut scratch);
        for (to, from) in out.iter_mut().zip(&line) {
            *to = if odd { -from.im } else { from.re };
        }
    }
    result
}
