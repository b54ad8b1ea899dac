//! The same product in single precision.

use std::array::from_fn;

use super::super::super::terms::Terms;
use super::super::memory::AlignedNumbers;
use super::super::paired_rows::places;
use super::super::reflection::Reflection;
use super::super::simd::Number;
use super::super::threads::{Scratch, divide, pieces};
use super::{Boundary, LaneProduct};

impl LaneProduct<f64> {
    /// This product, of `terms`, on numbers of single precision; and the unit of its outputs, a power of two beside which no
    /// kernel is too large or too small for them.
    pub fn in_single_precision(&self, terms: &Terms) -> (LaneProduct<f32>, f64) {
        let lengths = [self.along_x.length(), self.along_y.length()];
        let boundary = match self.boundary {
            Boundary::FreeSpace => Boundary::FreeSpace,
            Boundary::Periodic { .. } => Boundary::Periodic { places: Vec::new() },
        };
        let mut product = LaneProduct::<f32>::planned(self.set, terms, boundary, lengths);
        let (width, wide) = (self.set.width::<f64>(), self.set.width::<f32>());
        let strips = product.layout.strips;
        if let Boundary::Periodic { places: rows } = &mut product.boundary {
            *rows = places(&product.along_y.order(), strips * wide);
        }
        let reflection = self.reflection.as_ref();
        product.reflection = reflection.map(|reflection| Reflection::new(terms, reflection.places.clone()));
        let kernels = self.kernels.as_slice();
        let (vectors, rest) = kernels.as_chunks::<8>();
        let larger = |most: [f64; 8], values: &[f64; 8]| from_fn(|lane| most[lane].max(values[lane].abs()));
        let lanes = vectors.iter().fold([0.0; 8], larger);
        let largest = lanes.iter().chain(rest).fold(0.0_f64, |most, value| most.max(value.abs()));
        let unit = if largest > 0.0 { largest.log2().floor().exp2() } else { 1.0 };
        // Of each strip the same rows, as many frequencies a row as there are lanes.
        let rows = kernels.len() / (self.layout.strips * width);
        product.kernels = AlignedNumbers::zeros(strips * rows * wide);
        let frequencies = self.boundary.frequencies(lengths[1]);
        let fields = [product.kernels.as_mut_slice(), &mut [], &mut []];
        let scratch = Scratch { numbers: &mut [], piece_len: 0 };
        let pieces = pieces(terms.shape, usize::MAX);
        divide(fields, rows * wide, scratch, pieces, &|_, first, values: &mut [f32], _: &mut [f32]| {
            for (strip, values) in (first..).zip(values.chunks_exact_mut(rows * wide)) {
                for (row, values) in values.chunks_exact_mut(wide).enumerate() {
                    for (value, frequency) in values.iter_mut().zip(strip * wide..frequencies) {
                        let at = (frequency / width * rows + row) * width + frequency % width;
                        *value = f32::of(kernels[at] / unit);
                    }
                }
            }
        });
        (product, unit)
    }
}
