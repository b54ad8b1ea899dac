//! Kernels of free-space products as transforms, strip by strip of the frequencies along `y`.

use ndarray::{aview_mut1, s};

use super::super::super::{Kernel, Parity};
use super::super::instruction_set::{InstructionSet, enter};
use super::super::memory::{AlignedNumbers, numbers_in_cache_line};
use super::super::plan::LinePlan;
use super::super::row_groups::Layout;
use super::super::rows::{RowsForward, Side};
use super::super::simd::{Lanes, Number};
use super::super::spectrum::{KeptPart, KernelColumn};
use super::super::threads::{Scratch, divide, pieces};
use super::boundary::Boundary;

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
            group_len: 2 * width * width,
            groups: 1,
            strip_stride: 2 * width * width,
        };
        Self { set, layout, along_x, along_y: LinePlan::new(ny, fraction) }
    }

    /// Hands out kernels times `scale` one by one: the number of each, and its strips.
    pub fn each_kernel(
        &self,
        kernels: &[Kernel<'_>],
        scale: f64,
        mut take: impl FnMut(usize, &mut Strips<'_>),
    ) {
        let Self { set, layout, along_x, along_y } = self;
        let (set, width) = (*set, self.set.width::<f64>());
        let line = numbers_in_cache_line::<f64>();
        // Of each row group the part that is kept, `[strip][row of the group]`, and a cache line or two against powers of two.
        let stride = layout.strips * width * width + line.max(width);
        let mut rows = AlignedNumbers::zeros(along_x.length().div_ceil(width) * stride);
        let lines = width * (3 * along_y.padded_length()).max(2 * along_x.length());
        let room = layout.spectra_len() + lines + along_x.length() * width + width * layout.shape[1];
        let piece_len = room.next_multiple_of(line) + line;
        let pieces = pieces(layout.shape, usize::MAX);
        let mut memory = AlignedNumbers::zeros(pieces * piece_len);
        // The others hold no cells.
        let groups = layout.shape[0].div_ceil(width);
        for (index, kernel) in kernels.iter().enumerate() {
            let odd = kernel.parity.odd().map(usize::from);
            let fields = [&mut rows.as_mut_slice()[..groups * stride], &mut [], &mut []];
            let scratch = Scratch { numbers: memory.as_mut_slice(), piece_len };
            divide(fields, stride, scratch, pieces, &|_, first, rows: &mut [f64], scratch: &mut [f64]| {
                let (spectrum, scratch) = scratch.split_at_mut(layout.spectra_len());
                let (scratch, field) = scratch.split_at_mut(lines);
                let field = &mut field[..width * layout.shape[1]];
                for (group, to) in (first..).zip(rows.chunks_exact_mut(stride)) {
                    let Some(cells) = self.quadrant(kernel, scale, group, field) else { break };
                    let layout = &Layout { shape: [cells, layout.shape[1]], ..*layout };
                    let (plan, side, field) = (along_y, Side::Plain, &*field);
                    let groups = layout.groups_in(spectrum, 1);
                    let (scratch, first) = (&mut *scratch, 0);
                    enter!(set, f64, RowsForward { layout, plan, side, field, first, groups, scratch });
                    let (spectrum, part) = (&*spectrum, odd[1]);
                    enter!(set, f64, KeptPart { spectrum, part, to });
                }
            });
            let scratch = Scratch { numbers: memory.as_mut_slice(), piece_len };
            let column =
                KernelColumns { transform: self, rows: rows.as_slice(), stride, part: odd[0], lines };
            take(index, &mut Strips { columns: column, scratch, pieces });
        }
    }

    /// Writes a group of rows of a quadrant times `scale`, as often as its transform stands for values of all four quadrants: four times the
    /// values, on an axis twice, at the origin once; negative where a kernel is odd along both axes, `i` times `i`. Tells how many rows
    /// there are; none behind the last.
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

/// The strips of a kernel whose rows have been transformed.
pub(super) struct Strips<'a> {
    columns: KernelColumns<'a>,
    scratch: Scratch<'a, f64>,
    pieces: usize,
}

impl Strips<'_> {
    /// Hands out the number of each strip and its values, `[place along x][lane]`, in turn.
    pub fn in_turn(&mut self, mut take: impl FnMut(usize, &[f64])) {
        for strip in 0..self.columns.transform.layout.strips {
            take(strip, self.columns.of(strip, self.scratch.numbers));
        }
    }

    /// Hands out the values of each strip with its part of `to`, which has parts of `part_len`; on all threads.
    pub fn each_part(&mut self, to: &mut [f64], part_len: usize, take: impl Fn(&[f64], &mut [f64]) + Sync) {
        let Self { columns, scratch, pieces } = self;
        let scratch = Scratch { numbers: &mut *scratch.numbers, piece_len: scratch.piece_len };
        divide(
            [to, &mut [], &mut []],
            part_len,
            scratch,
            *pieces,
            &|_, first, parts: &mut [f64], scratch: &mut [f64]| {
                for (strip, part) in (first..).zip(parts.chunks_exact_mut(part_len)) {
                    take(columns.of(strip, scratch), part);
                }
            },
        );
    }
}

/// Transforms along x.
struct KernelColumns<'a> {
    transform: &'a KernelTransform,
    rows: &'a [f64],
    /// Numbers from one row group to the next.
    stride: usize,
    /// 0 where the real part is kept, else 1.
    part: usize,
    /// Numbers of scratch memory of a line.
    lines: usize,
}

impl KernelColumns<'_> {
    /// Values of a strip, made in `memory`.
    fn of<'m>(&self, strip: usize, memory: &'m mut [f64]) -> &'m [f64] {
        let Self { transform: KernelTransform { set, layout, along_x: plan, .. }, stride, part, .. } = *self;
        let (set, width) = (*set, set.width::<f64>());
        let (scratch, values) = memory.split_at_mut(self.lines);
        let values = &mut values[..plan.length() * width];
        let rows = &self.rows[strip * width * width..];
        enter!(set, f64, KernelColumn { layout, plan, rows, stride, part, values: &mut *values, scratch });
        values
    }
}
