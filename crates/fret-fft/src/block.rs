//! What is convolved with what: kernels, symbols and the blocks that connect fields.

use ndarray::ArrayView2;

use super::Parity;

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
