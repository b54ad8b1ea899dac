//! Kernels of free-space products as transforms, strip by strip of the frequencies along `y`.

use ndarray::{aview_mut1, s};

use super::super::super::{Kernel, Parity};
use super::super::memory::{AlignedNumbers, numbers_in_cache_line};
use super::super::plan::LinePlan;
use super::super::row_groups::Layout;
use super::super::rows::{RowsForward, Side};
use super::super::simd::{Lanes, Number};
use super::super::spectrum::{KeptPart, KernelColumn};
use super::{Boundary, InstructionSet, enter};

/// The transform of kernels given by their quadrants.
pub(super) struct KernelTransform {
    set: InstructionSet,
    layout: Layout,
    pub along_x: LinePlan<f64>,
    pub along_y: LinePlan<f64>,
}

impl KernelTransform {
    /// Of the leading `shape` values of quadrants, to `lengths` frequencies.
    pub fn new(set: InstructionSet, shape: [usize; 2], [nx, ny]: [usize; 2]) -> Self {
        let width = set.width::<f64>();
        let fraction = Boundary::FreeSpace.fraction();
        let along_x = LinePlan::new(nx, fraction);
        let strips = ny.div_ceil(width);
        let layout = Layout {
            shape,
            column_len: nx,
            rows_read: shape[0].next_multiple_of(along_x.inner_length()).min(nx),
            strips,
            group_stride: strips * width * 2 * width,
            strip_stride: nx * width,
        };
        Self { set, layout, along_x, along_y: LinePlan::new(ny, fraction) }
    }

    /// Hands out kernels times `scale`: the numbers of each and of each strip, with its values, `[place along x][lane]`.
    pub fn each_strip(&self, kernels: &[Kernel<'_>], scale: f64, mut take: impl FnMut(usize, usize, &[f64])) {
        let Self { set, layout, along_x, along_y } = self;
        let (set, width) = (*set, self.set.width::<f64>());
        // Of each row group the part that is kept, `[strip][row of the group]`, and a cache line or two against powers of two.
        let stride = layout.strips * width * width + numbers_in_cache_line::<f64>().max(width);
        let mut rows = AlignedNumbers::zeros(along_x.length().div_ceil(width) * stride);
        let mut spectrum = AlignedNumbers::zeros(layout.group_stride);
        let mut scratch =
            AlignedNumbers::zeros(width * (3 * along_y.padded_length()).max(2 * along_x.length()));
        let mut values = AlignedNumbers::zeros(layout.strip_stride);
        let mut field = vec![0.0; width * layout.shape[1]];
        for (index, kernel) in kernels.iter().enumerate() {
            let odd = kernel.parity.odd().map(usize::from);
            for (group, to) in rows.as_mut_slice().chunks_exact_mut(stride).enumerate() {
                let Some(cells) = self.quadrant(kernel, scale, group, &mut field) else { break };
                let layout = &Layout { shape: [cells, layout.shape[1]], ..*layout };
                let (plan, side, field, first) = (along_y, Side::Plain, field.as_slice(), 0);
                let (groups, scratch) = (spectrum.as_mut_slice(), scratch.as_mut_slice());
                enter!(set, f64, RowsForward { layout, plan, side, field, first, groups, scratch });
                let (spectrum, part) = (spectrum.as_slice(), odd[1]);
                enter!(set, f64, KeptPart { spectrum, part, to });
            }
            for strip in 0..layout.strips {
                let (rows, plan, part) = (&rows.as_slice()[strip * width * width..], along_x, odd[0]);
                let (values, scratch) = (values.as_mut_slice(), scratch.as_mut_slice());
                enter!(set, f64, KernelColumn { layout, plan, rows, stride, part, values, scratch });
                take(index, strip, values);
            }
        }
    }

    /// Writes a group of rows of a quadrant: twice the values, but those on the axes once, since its transform stands for all four
    /// quadrants. Tells how many rows there are; none behind the last.
    fn quadrant(&self, kernel: &Kernel<'_>, scale: f64, group: usize, field: &mut [f64]) -> Option<usize> {
        let ([cells_x, cells_y], width) = (self.layout.shape, self.set.width::<f64>());
        let first = group * width;
        if first >= cells_x {
            return None;
        }
        let factor = if kernel.parity == Parity::OddOdd { -4.0 * scale } else { 4.0 * scale };
        let values = kernel.values.slice(s![first..(first + width).min(cells_x), ..cells_y]);
        for (row, values) in field.chunks_exact_mut(cells_y).zip(values.rows()) {
            aview_mut1(row).zip_mut_with(&values, |to, from| *to = factor * from);
            row[0] *= 0.5;
        }
        if group == 0 {
            field[..cells_y].iter_mut().for_each(|value| *value *= 0.5);
        }
        Some(values.nrows())
    }
}
