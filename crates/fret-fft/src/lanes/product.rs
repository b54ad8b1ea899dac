//! The products of the lane engine: tables, kernels, and the order of the stages.

mod boundary;
mod cross;
mod kernels;
mod mirrored;
mod single;

use super::super::lengths::good_length;
use super::super::line_product::folded_indices;
use super::super::terms::Terms;
use super::super::{Kernel, Parity};
use super::columns::{Columns, Term};
use super::instruction_set::{InstructionSet, enter};
use super::memory::{AlignedNumbers, numbers_in_cache_line};
use super::mirrored_columns::MirroredColumns;
use super::paired_rows::{PairsForward, PairsInverse, places};
use super::plan::LinePlan;
use super::reflection::{Reflection, tables};
use super::row_groups::{Layout, RowGroups};
use super::rows::{RowsForward, RowsInverse, Side};
use super::simd::{Lanes, Number};
use super::threads::{Divisible, MAX_FIELDS, Scratch, divide, divide_runs, pieces};
use boundary::Boundary;
use kernels::KernelTransform;

/// Shortest line: an outermost and an innermost pass.
const SHORTEST: usize = 8;

/// Row groups of one field, so many of which are transformed together.
struct Together<'a, N> {
    groups: RowGroups<'a, N>,
    paired: usize,
}

impl<N: Number> Divisible for Together<'_, N> {
    fn chunks(&self) -> usize {
        self.groups.len().div_ceil(self.paired)
    }

    fn divided_after(self, chunks: usize) -> (Self, Self) {
        let Self { groups, paired } = self;
        let (first, others) = groups.split_at(chunks * paired);
        (Self { groups: first, paired }, Self { groups: others, paired })
    }
}

/// A product on the lane engine, on fields of numbers `N`.
pub struct LaneProduct<N> {
    set: InstructionSet,
    boundary: Boundary,
    layout: Layout,
    along_x: LinePlan<N>,
    along_y: LinePlan<N>,
    inputs: usize,
    outputs: usize,
    /// Per output.
    terms: Vec<Vec<Term<N>>>,
    /// What mirrors change.
    reflection: Option<Reflection<N>>,
    /// Of each place: kernels, or their tables with mirrors.
    kernel_count: usize,
    kernels: AlignedNumbers<N>,
}

impl LaneProduct<f64> {
    /// Whether the engine takes as many fields.
    pub fn takes(terms: &Terms) -> bool {
        terms.inputs <= MAX_FIELDS && terms.outputs <= MAX_FIELDS
    }

    /// Free-space product from the quadrants of the kernels; any shape.
    pub fn free_space(set: InstructionSet, terms: &Terms, kernels: &[Kernel<'_>]) -> Self {
        let lengths = terms.shape.map(|n| good_length(n).max(SHORTEST));
        if terms.mirrors.any() {
            return Self::free_space_mirrored(set, terms, kernels, lengths);
        }
        let mut product = Self::planned(set, terms, Boundary::FreeSpace, lengths);
        let transform = KernelTransform::new(set, terms.shape, lengths);
        let scale = 1.0 / (2.0 * lengths[0] as f64 * lengths[1] as f64);
        let (width, count) = (set.width::<f64>(), product.kernel_count);
        transform.each_kernel(kernels, scale, |kernel, strips| {
            let all = product.kernels.as_mut_slice();
            strips.each_part(all, lengths[0] * count * width, |values, to| {
                let groups = to.chunks_exact_mut(4 * width).skip(kernel).step_by(count);
                groups
                    .zip(values.chunks_exact(4 * width))
                    .for_each(|(to, values)| to.copy_from_slice(values));
            });
        });
        product
    }

    /// Periodic product from the quadrants of the symbols; lengths must be good and at least 8.
    pub fn periodic(set: InstructionSet, terms: &Terms, symbols: &[Kernel<'_>]) -> Self {
        if terms.mirrors.any() {
            return Self::periodic_mirrored(set, terms, symbols);
        }
        let [nx, ny] = terms.shape;
        let boundary = Boundary::Periodic { places: Vec::new() };
        let mut product = Self::planned(set, terms, boundary, [nx, ny]);
        let count = product.layout.strips * set.width::<f64>();
        product.boundary = Boundary::Periodic { places: places(&product.along_y.order(), count) };
        let order = product.along_x.order();
        let width = set.width::<f64>();
        // The transforms of paired rows come out doubled.
        let scale = 0.5 / (nx as f64 * ny as f64);
        let count = product.kernel_count;
        let kernels = product.kernels.as_mut_slice();
        for (index, symbol) in symbols.iter().enumerate() {
            let scale = if symbol.parity == Parity::EvenEven { scale } else { -scale };
            let odd = symbol.parity.odd();
            let [folded_x, folded_y] = [folded_indices(nx, odd[0]), folded_indices(ny, odd[1])];
            for (strip, kernels) in kernels.chunks_exact_mut(nx * count * width).enumerate() {
                for (place, &kx) in order.iter().enumerate() {
                    let (a, sign_a) = folded_x[kx];
                    let values =
                        &mut kernels[((place / 4 * count + index) * 4 + place % 4) * width..][..width];
                    for (value, ky) in values.iter_mut().zip(strip * width..=ny / 2) {
                        let (b, sign_b) = folded_y[ky];
                        *value = scale * sign_a * sign_b * symbol.values[[a, b]];
                    }
                }
            }
        }
        product
    }
}

impl<N: Number> LaneProduct<N> {
    fn planned(set: InstructionSet, terms: &Terms, boundary: Boundary, [nx, ny]: [usize; 2]) -> Self {
        let width = set.width::<N>();
        let fraction = boundary.fraction();
        let strips = boundary.frequencies(ny).div_ceil(width);
        // A cache line or two between strips, against strides that are powers of two.
        let padding = 2 * numbers_in_cache_line::<N>().max(width);
        let (paired, group_len) = (boundary.paired(), 2 * width * width);
        let groups = nx.div_ceil(width).next_multiple_of(paired);
        let along_x = LinePlan::new(nx, fraction);
        // A mirrored line has cells in every part.
        let places = if terms.mirrors.axes[0] { nx } else { along_x.inner_length() };
        let layout = Layout {
            shape: terms.shape,
            column_len: nx,
            rows_read: terms.shape[0].next_multiple_of(places).min(nx),
            strips,
            group_len,
            groups,
            strip_stride: terms.inputs.max(terms.outputs) * groups * group_len + padding,
        };
        let order = |output| {
            let blocks = terms.blocks.iter().filter(move |block| block.output == output);
            let terms = blocks.map(|block| {
                let parity = terms.parities[block.kernel];
                let mirrored = if parity.odd()[1] { -block.sign } else { block.sign };
                let imaginary = parity.is_imaginary();
                let factors = [N::of(block.sign), N::of(mirrored)];
                Term { input: block.input, kernel: block.kernel, factors, imaginary }
            });
            terms.collect()
        };
        let kernel_count = terms.parities.len() * tables(terms.mirrors.axes);
        Self {
            set,
            boundary,
            layout,
            along_x,
            along_y: LinePlan::new(ny, fraction),
            inputs: terms.inputs,
            outputs: terms.outputs,
            terms: (0..terms.outputs).map(order).collect(),
            reflection: None,
            kernel_count,
            kernels: AlignedNumbers::zeros(strips * nx * kernel_count * width),
        }
    }

    /// Memory of the kernels, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.kernels.memory_bytes()
    }

    fn scratch_len(&self) -> usize {
        let width = self.set.width::<N>();
        let rows = (2 + self.boundary.paired()) * self.along_y.padded_length();
        let fields = self.inputs.max(self.outputs);
        let columns = 2 * fields * self.boundary.parts() * self.along_x.length();
        let line = numbers_in_cache_line::<N>();
        (rows.max(columns) * width).next_multiple_of(line) + 2 * line
    }

    /// Numbers of work space for as many threads.
    pub fn work_len(&self, threads: usize) -> usize {
        self.layout.spectra_len() + threads.max(1) * self.scratch_len()
    }

    /// `output = sum of blocks`, with work space for at least one thread.
    pub fn apply(&self, work: &mut [N], input: &[&[N]], output: &mut [&mut [N]]) {
        match self.inputs.max(self.outputs) {
            1 => self.apply_to::<1>(work, input, output),
            2 => self.apply_to::<2>(work, input, output),
            _ => self.apply_to::<3>(work, input, output),
        }
    }

    fn apply_to<const F: usize>(&self, work: &mut [N], input: &[&[N]], output: &mut [&mut [N]]) {
        let (spectra, numbers) = work.split_at_mut(self.layout.spectra_len());
        let piece_len = self.scratch_len();
        let pieces = pieces(self.layout.shape, numbers.len() / piece_len);
        let sides = self.reflection.as_ref().map(|reflection| reflection.rows);
        let side = |sides: Option<[Side; 3]>| {
            move |index: usize| sides.and_then(|sides| sides.get(index).copied()).unwrap_or(Side::Plain)
        };
        let inputs = side(sides.map(|sides| sides.inputs));
        self.rows_forward(input, &inputs, spectra, Scratch { numbers, piece_len }, pieces);
        let scratch = Scratch { numbers, piece_len };
        match self.boundary {
            Boundary::FreeSpace => self.columns::<F, 2>(spectra, scratch, pieces),
            Boundary::Periodic { .. } => self.columns::<F, 1>(spectra, scratch, pieces),
        }
        let outputs = side(sides.map(|sides| sides.outputs));
        self.rows_inverse(spectra, &outputs, output, Scratch { numbers, piece_len }, pieces);
    }

    fn rows_forward(
        &self,
        input: &[&[N]],
        sides: &(impl Fn(usize) -> Side + Sync),
        spectra: &mut [N],
        scratch: Scratch<'_, N>,
        pieces: usize,
    ) {
        let Self { layout, along_y: plan, .. } = self;
        let paired = self.boundary.paired();
        let (first_field, rest) = layout.groups_in(spectra, input.len()).split_at(layout.groups);
        let (second_field, third_field) = rest.split_at(layout.groups);
        let fields = [first_field, second_field, third_field].map(|groups| Together { groups, paired });
        let rows = |index: usize, first, run: Together<'_, N>, scratch: &mut [N]| {
            let (field, side, groups) = (input[index], sides(index), run.groups);
            match &self.boundary {
                Boundary::FreeSpace => {
                    enter!(self.set, N, RowsForward { layout, plan, side, field, first, groups, scratch });
                }
                Boundary::Periodic { places } => {
                    enter!(
                        self.set,
                        N,
                        PairsForward { layout, plan, side, places, field, first, groups, scratch }
                    );
                }
            }
        };
        divide_runs(fields, scratch, pieces, &rows);
    }

    fn columns<const F: usize, const P: usize>(
        &self,
        spectra: &mut [N],
        scratch: Scratch<'_, N>,
        pieces: usize,
    ) {
        let chunk = self.layout.strip_stride;
        let strips = [spectra, &mut [], &mut []];
        divide(strips, chunk, scratch, pieces, &|_, first, strips: &mut [N], scratch: &mut [N]| {
            if let Some(reflection) = &self.reflection {
                let columns = MirroredColumns::<N, F, P> {
                    layout: &self.layout,
                    plan: &self.along_x,
                    sides: reflection.columns,
                    inputs: self.inputs,
                    kernels: self.kernels.as_slice(),
                    table_count: self.kernel_count,
                    places: &reflection.places,
                    terms: &reflection.terms,
                    first,
                    strips,
                    scratch,
                };
                enter!(self.set, N, columns);
                return;
            }
            let columns = Columns::<N, F, P> {
                layout: &self.layout,
                plan: &self.along_x,
                inputs: self.inputs,
                kernels: self.kernels.as_slice(),
                kernel_count: self.kernel_count,
                terms: &self.terms,
                first,
                strips,
                scratch,
            };
            enter!(self.set, N, columns);
        });
    }

    fn rows_inverse(
        &self,
        spectra: &[N],
        sides: &(impl Fn(usize) -> Side + Sync),
        output: &mut [&mut [N]],
        scratch: Scratch<'_, N>,
        pieces: usize,
    ) {
        let Self { layout, along_y: plan, .. } = self;
        let chunk = self.boundary.paired() * self.set.width::<N>() * layout.shape[1];
        let mut fields = output.iter_mut().map(|field| &mut **field);
        let fields = [(); MAX_FIELDS].map(|()| fields.next().unwrap_or_default());
        let rows = |index: usize, first, rows: &mut [N], scratch: &mut [N]| {
            let (spectrum, side) = (&spectra[index * layout.field_len()..], sides(index));
            match &self.boundary {
                Boundary::FreeSpace => {
                    enter!(self.set, N, RowsInverse { layout, plan, side, spectrum, first, rows, scratch });
                }
                Boundary::Periodic { places } => {
                    enter!(
                        self.set,
                        N,
                        PairsInverse { layout, plan, side, places, spectrum, first, rows, scratch }
                    );
                }
            }
        };
        divide(fields, chunk, scratch, pieces, &rows);
    }
}
