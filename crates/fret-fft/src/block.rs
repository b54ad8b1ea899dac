//! What is convolved with what: kernels, symbols and the blocks that connect fields, checked once at the door.

use ndarray::{ArrayView1, ArrayView2, s};

use super::lanes::pieces;
use super::{Mirrors, Parity};

/// One kernel, given by its quadrant of offsets: `values[[i, j]]` belongs to the offset of `i >= 0` cells in `x`
/// and `j >= 0` cells in `y`; the parity gives the other three quadrants.
///
/// Along an odd axis the values at offset 0 are taken as zero. The array may be larger than needed: the leading
/// block is used, so a problem on a smaller box of the same cells passes the same array.
#[derive(Debug, Clone, Copy)]
pub struct Kernel<'a> {
    /// Values of the quadrant, shape at least that of the grid.
    pub values: ArrayView2<'a, f64>,
    /// Continuation to negative offsets.
    pub parity: Parity,
}

/// One real transfer function by its quadrant of wavenumber indices, shape `(nx/2 + 1, ny/2 + 1)`.
///
/// With `K^(k) = sum_x K(x) exp(-i k x)`, the transfer function at the indices `(a, b)` of either sign is
/// `values[[|a|, |b|]] * sign(a) (if odd in x) * sign(b) (if odd in y) * (-i)^(number of odd axes)`.
/// Along an odd axis the values at index 0 and, for even lengths, at the Nyquist index count as zero.
#[derive(Debug, Clone, Copy)]
pub struct Symbol<'a> {
    /// Values over `0..=nx/2` and `0..=ny/2`; a larger array is cut to that.
    pub values: ArrayView2<'a, f64>,
    /// Continuation to negative wavenumbers, and whether the transfer function is real or imaginary.
    pub parity: Parity,
}

/// One term of the product: `output += sign * (kernel * input)`, all three by index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Index of the output field.
    pub output: usize,
    /// Index of the input field.
    pub input: usize,
    /// Index of the kernel (or symbol).
    pub kernel: usize,
    /// Factor, usually `+1` or `-1`.
    pub sign: f64,
}

/// Why a product was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConvolutionError {
    /// A grid without cells.
    #[error("shape {0} x {1}: each side needs at least one cell")]
    EmptyShape(usize, usize),
    /// Nothing to do.
    #[error("no blocks: at least one term `output += sign * (kernel * input)` is needed")]
    NoBlocks,
    /// A kernel or symbol that does not cover the grid.
    #[error("kernel {kernel} has {found_x} x {found_y} values, needs at least {needed_x} x {needed_y}")]
    TooSmall {
        /// Index of the kernel.
        kernel: usize,
        /// Values found along `x`.
        found_x: usize,
        /// Values found along `y`.
        found_y: usize,
        /// Values needed along `x`.
        needed_x: usize,
        /// Values needed along `y`.
        needed_y: usize,
    },
    /// A block names a kernel that was not given.
    #[error("block {block} uses kernel {kernel}, but only {kernels} were given")]
    NoSuchKernel {
        /// Index of the block.
        block: usize,
        /// Kernel it names.
        kernel: usize,
        /// Number of kernels given.
        kernels: usize,
    },
    /// A value that is not a finite number, among those that are used.
    #[error("kernel {kernel}: value {value} at [{x}, {y}] is not finite")]
    NotFinite {
        /// Index of the kernel.
        kernel: usize,
        /// The value.
        value: f64,
        /// Index along `x`.
        x: usize,
        /// Index along `y`.
        y: usize,
    },
    /// Blocks that make an output even and odd at once.
    #[error("block {block}: behind the mirrors its output goes on otherwise than that of another block")]
    Parity {
        /// Index of the block.
        block: usize,
    },
    /// A block with a factor that is not a finite number.
    #[error("block {block}: factor {sign} is not finite")]
    Factor {
        /// Index of the block.
        block: usize,
        /// The factor.
        sign: f64,
    },
}

/// The checked shape of a product: which fields go in and out, and through what.
#[derive(Debug, Clone)]
pub(super) struct Terms {
    pub shape: [usize; 2],
    pub inputs: usize,
    pub outputs: usize,
    pub parities: Vec<Parity>,
    pub blocks: Vec<Block>,
    pub mirrors: Mirrors,
    /// Whether each output is odd along `[x, y]`, at mirrors.
    pub outputs_odd: Vec<[bool; 2]>,
}

impl Terms {
    /// Checks everything a product needs; `quadrant` is the number of values used of each kernel.
    pub fn new(
        shape: [usize; 2],
        quadrant: [usize; 2],
        kernels: &[Kernel<'_>],
        blocks: &[Block],
        mirrors: Mirrors,
    ) -> Result<Self, ConvolutionError> {
        if shape.contains(&0) {
            return Err(ConvolutionError::EmptyShape(shape[0], shape[1]));
        }
        if blocks.is_empty() {
            return Err(ConvolutionError::NoBlocks);
        }
        check_quadrants(kernels, quadrant)?;
        for (index, block) in blocks.iter().enumerate() {
            if block.kernel >= kernels.len() {
                let (block, kernel, kernels) = (index, block.kernel, kernels.len());
                return Err(ConvolutionError::NoSuchKernel { block, kernel, kernels });
            }
            if !block.sign.is_finite() {
                return Err(ConvolutionError::Factor { block: index, sign: block.sign });
            }
        }
        let count = |field: fn(&Block) -> usize| blocks.iter().map(field).max().map_or(0, |last| last + 1);
        Ok(Self {
            shape,
            inputs: count(|block| block.input),
            outputs: count(|block| block.output),
            parities: kernels.iter().map(|kernel| kernel.parity).collect(),
            blocks: blocks.to_vec(),
            outputs_odd: mirrors.outputs_odd(kernels, blocks)?,
            mirrors,
        })
    }

    /// Number of cells of one field.
    pub fn cells(&self) -> usize {
        self.shape[0] * self.shape[1]
    }

    /// Panics with the reason when the fields passed to a product are not those it was made for.
    pub fn check_fields(&self, input: &[&[f64]], output: &[&mut [f64]]) {
        assert!(
            input.len() == self.inputs && output.len() == self.outputs,
            "product of {} inputs and {} outputs called with {} and {}",
            self.inputs,
            self.outputs,
            input.len(),
            output.len()
        );
        let cells = self.cells();
        let [nx, ny] = self.shape;
        for found in input.iter().map(|field| field.len()).chain(output.iter().map(|field| field.len())) {
            assert!(found == cells, "field of {found} values passed to a product on a {nx} x {ny} grid");
        }
    }
}

/// Checks all kernels; the first that fails is told, whatever the threads.
fn check_quadrants(kernels: &[Kernel<'_>], quadrant: [usize; 2]) -> Result<(), ConvolutionError> {
    fn check(
        first: usize,
        kernels: &[Kernel<'_>],
        quadrant: [usize; 2],
        pieces: usize,
    ) -> Result<(), ConvolutionError> {
        if pieces > 1 && kernels.len() > 1 {
            let (one, other) = kernels.split_at(kernels.len() / 2);
            let right = pieces - pieces / 2;
            let (one, other) = crate::join(
                || check(first, one, quadrant, pieces / 2),
                || check(first + kernels.len() / 2, other, quadrant, right),
            );
            return one.and(other);
        }
        (first..).zip(kernels).try_for_each(|(index, kernel)| check_quadrant(index, &kernel.values, quadrant))
    }
    check(0, kernels, quadrant, pieces(quadrant, kernels.len().max(1)))
}

fn check_quadrant(
    kernel: usize,
    values: &ArrayView2<'_, f64>,
    quadrant: [usize; 2],
) -> Result<(), ConvolutionError> {
    let [needed_x, needed_y] = quadrant;
    let (found_x, found_y) = values.dim();
    if found_x < needed_x || found_y < needed_y {
        return Err(ConvolutionError::TooSmall { kernel, found_x, found_y, needed_x, needed_y });
    }
    let used = values.slice(s![..needed_x, ..needed_y]);
    // Row by row and without stopping in between, so that it takes a vector at a time.
    let is_finite = |row: ArrayView1<'_, f64>| match row.as_slice() {
        Some(row) => row.iter().fold(true, |so_far, value| so_far & value.is_finite()),
        None => row.iter().all(|value| value.is_finite()),
    };
    if used.rows().into_iter().all(is_finite) {
        return Ok(());
    }
    match used.indexed_iter().find(|(_, value)| !value.is_finite()) {
        Some(((x, y), &value)) => Err(ConvolutionError::NotFinite { kernel, value, x, y }),
        None => Ok(()),
    }
}
