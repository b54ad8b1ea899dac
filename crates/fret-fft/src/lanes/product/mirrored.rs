//! Planning of products in front of mirrors: where each frequency of the half and of the quarter finds its kernel.

use super::super::super::terms::Terms;
use super::super::super::{Kernel, Parity};
use super::super::memory::AlignedNumbers;
use super::super::paired_rows::places;
use super::super::plan::LinePlan;
use super::super::reflection::{Reflection, second_of_table, table_of_second, tables};
use super::kernels::KernelTransform;
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
        let whole = terms.mirrors.whole(lengths);
        let transform = KernelTransform::new(set, terms.mirrors.whole(terms.shape), whole);
        // Where the numbers at each place of the whole line go: whether to a table of second frequencies, and their place there.
        let goals = |axis: usize, part: &LinePlan<f64>, wide: &LinePlan<f64>| -> Vec<(bool, usize)> {
            let mut places = vec![0; part.length()];
            for (place, frequency) in part.order().into_iter().enumerate() {
                places[frequency] = place;
            }
            let goal = |frequency: usize| match frequency.checked_sub(lengths[axis]) {
                Some(behind) => (true, places[behind]),
                None => (false, places[frequency]),
            };
            wide.order().into_iter().map(goal).collect()
        };
        let along_x = goals(0, &product.along_x, &transform.along_x);
        let along_y = goals(1, &product.along_y, &transform.along_y);
        let (width, count) = (set.width::<f64>(), product.kernel_count);
        let along_x: Vec<_> =
            along_x.into_iter().map(|(second, x)| (second, (x / 4 * count * 4 + x % 4) * width)).collect();
        let strip_len = lengths[0] * count * width;
        let scale = 0.25 / (lengths[0] as f64 * lengths[1] as f64);
        transform.each_kernel(kernels, scale, |kernel, strips| {
            let (parity, first) = (kernels[kernel].parity, kernel * tables(axes));
            strips.in_turn(|strip, values| {
                let columns = &along_y[strip * width..along_y.len().min((strip + 1) * width)];
                for (lane, &(second_y, y)) in columns.iter().enumerate() {
                    let to = &mut product.kernels.as_mut_slice()[y / width * strip_len + y % width..];
                    let tables = [false, true].map(|second_x| {
                        let second = [second_x, second_y];
                        ((first + table_of_second(axes, second)) * 4 * width, sign_of(parity, second))
                    });
                    for (values, &(second_x, at)) in values.chunks_exact(width).zip(&along_x) {
                        let (table, sign) = tables[usize::from(second_x)];
                        to[at + table] = sign * values[lane];
                    }
                }
            });
        });
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

/// Sign of a kernel's table: of an odd one minus at the first frequencies, and again along each odd axis with the second.
fn sign_of(parity: Parity, second: [bool; 2]) -> f64 {
    let odd = parity.odd();
    let turns =
        usize::from(parity != Parity::EvenEven) + (0..2).filter(|axis| second[*axis] && odd[*axis]).count();
    if turns.is_multiple_of(2) { 1.0 } else { -1.0 }
}
