//! Planning of products in front of mirrors: where each frequency of the half and of the quarter finds its kernel.

use super::super::super::block::Terms;
use super::super::super::{Kernel, Mirrors, Parity};
use super::super::memory::AlignedNumbers;
use super::super::paired_rows::places;
use super::super::plan::LinePlan;
use super::super::reflection::{Reflection, second_of_table, tables};
use super::{Boundary, InstructionSet, LaneProduct};

impl LaneProduct<f64> {
    /// Free-space product in front of mirrors, from the kernels of the whole grid.
    ///
    /// The frequencies of a line of `n` points before a mirror are half of those of the whole line of `2n` points; the other half,
    /// from `n` on, are two pi minus what `pi - w` would be.
    pub(super) fn free_space_mirrored(
        set: InstructionSet,
        terms: &Terms,
        kernels: &[Kernel<'_>],
        lengths: [usize; 2],
    ) -> Self {
        let axes = terms.mirrors.axes;
        let mut product = Self::planned(set, terms, Boundary::FreeSpace, lengths);
        product.reflection = Some(Reflection::new(terms, Vec::new()));
        let wide = Terms { shape: terms.mirrors.whole(terms.shape), ..terms.clone() };
        let wide = Terms { mirrors: Mirrors::NONE, ..wide };
        let wide_lengths = terms.mirrors.whole(lengths);
        let mut whole = Self::planned(set, &wide, Boundary::FreeSpace, wide_lengths);
        whole.transform(kernels, 0.25 / (lengths[0] as f64 * lengths[1] as f64));
        let position = |plan: &LinePlan<f64>| {
            let mut positions = vec![0; plan.length()];
            for (position, frequency) in plan.order().into_iter().enumerate() {
                positions[frequency] = position;
            }
            positions
        };
        let places = [position(&whole.along_x), position(&whole.along_y)];
        let orders = [product.along_x.order(), product.along_y.order()];
        let (width, count) = (set.width::<f64>(), product.kernel_count);
        let source = whole.kernels.as_slice();
        for (kernel, &Kernel { parity, .. }) in kernels.iter().enumerate() {
            let sign = if parity == Parity::EvenEven { 1.0 } else { -1.0 };
            for table in 0..tables(axes) {
                let second = second_of_table(axes, table);
                let sign =
                    (0..2).filter(|axis| second[*axis] && parity.odd()[*axis]).fold(sign, |sign, _| -sign);
                let of_axis = |axis: usize| -> Vec<usize> {
                    let behind = if second[axis] { lengths[axis] } else { 0 };
                    orders[axis].iter().map(|k| places[axis][k + behind]).collect()
                };
                let (from_x, from_y) = (of_axis(0), of_axis(1));
                let at = kernel * tables(axes) + table;
                let strips = product.kernels.as_mut_slice().chunks_exact_mut(lengths[0] * count * width);
                for (strip, values) in strips.enumerate() {
                    let columns = &from_y[(strip * width).min(from_y.len())..];
                    for (place, &x) in from_x.iter().enumerate() {
                        let values =
                            &mut values[((place / 4 * count + at) * 4 + place % 4) * width..][..width];
                        let first = ((x / 4 * kernels.len() + kernel) * 4 + x % 4) * width;
                        for (value, &y) in values.iter_mut().zip(columns) {
                            let strip = y / width * wide_lengths[0] * kernels.len() * width;
                            *value = sign * source[strip + first + y % width];
                        }
                    }
                }
            }
        }
        product
    }

    /// Periodic product in front of mirrors, from the symbols of the whole grid.
    pub(super) fn periodic_mirrored(set: InstructionSet, terms: &Terms, symbols: &[Kernel<'_>]) -> Self {
        let [nx, ny] = terms.shape;
        let axes = terms.mirrors.axes;
        let boundary = Boundary::Periodic { places: Vec::new() };
        let mut product = Self::planned(set, terms, boundary, [nx, ny]);
        let (width, count) = (set.width::<f64>(), product.kernel_count);
        let strips = product.layout.strips;
        product.boundary = Boundary::Periodic { places: places(&product.along_y.order(), strips * width) };
        let waves = nx / 2 + 1;
        let along_x = places(&product.along_x.order(), waves);
        product.reflection = Some(Reflection::new(terms, along_x));
        product.kernels = AlignedNumbers::zeros(strips * waves * count * width);
        // Rows come out doubled, and so do pairs of opposite frequencies.
        let scale = 0.25 / (nx as f64 * ny as f64);
        for (kernel, symbol) in symbols.iter().enumerate() {
            let odd = symbol.parity.odd();
            let whole = terms.mirrors.whole(terms.shape);
            for table in 0..tables(axes) {
                let second = second_of_table(axes, table);
                // Index of a wave in the symbol; none where an odd one counts as zero.
                let index = |axis: usize, wave: usize| {
                    let index = if second[axis] { terms.shape[axis] - wave } else { wave };
                    (!odd[axis] || (index > 0 && 2 * index < whole[axis])).then_some(index)
                };
                let at = kernel * tables(axes) + table;
                let strips = product.kernels.as_mut_slice().chunks_exact_mut(waves * count * width);
                for (strip, values) in strips.enumerate() {
                    for (a, values) in values.chunks_exact_mut(count * width).enumerate() {
                        let values = &mut values[at * width..][..width];
                        for (value, b) in values.iter_mut().zip(strip * width..=ny / 2) {
                            *value = match (index(0, a), index(1, b)) {
                                (Some(a), Some(b)) => scale * symbol.values[[a, b]],
                                _ => 0.0,
                            };
                        }
                    }
                }
            }
        }
        product
    }
}
