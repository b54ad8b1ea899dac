//! Products of fields with transfer functions on a periodic grid.

use ndarray::Array2;

use super::engine::PlannedProduct;
use super::line_product;
use super::terms::Terms;
use super::{Block, ConvolutionError, Engine, Kernel, Mirrors, SingleProduct, Symbol, Workspace};

/// Product of periodic fields with real transfer functions:
///
/// `output_o = sum over blocks (o, f, k, s) of s * F^-1( S_k F(input_f) )`
///
/// with the discrete Fourier transform `F` on a grid of `nx x ny` cells and the transfer functions `S_k` given as
/// [`Symbol`]s. Immutable and shareable between threads; the memory it works in is a [`Workspace`].
pub struct PeriodicProduct {
    terms: Terms,
    product: PlannedProduct,
}

impl PeriodicProduct {
    /// Plans the product on a grid of `shape = [nx, ny]` cells, any size from `1 x 1`. Lengths that
    /// [`good_length`](super::good_length) leaves as they are, are several times faster.
    ///
    /// # Errors
    /// When the shape is empty, there are no blocks, a symbol is too small or not finite, or a block names a symbol
    /// that is not there.
    pub fn new(
        shape: [usize; 2],
        symbols: &[Symbol<'_>],
        blocks: &[Block],
    ) -> Result<Self, ConvolutionError> {
        Self::on(Engine::fastest(), shape, symbols, blocks, Mirrors::NONE)
    }

    /// The product of fields that go on behind mirrors, on the cells in front of them: `shape` counts these, the symbols are
    /// those of the whole grid. A mirror halves the work.
    ///
    /// # Errors
    /// As [`new`](Self::new), and when the blocks would make an output even and odd at once.
    pub fn mirrored(
        shape: [usize; 2],
        symbols: &[Symbol<'_>],
        blocks: &[Block],
        mirrors: Mirrors,
    ) -> Result<Self, ConvolutionError> {
        Self::on(Engine::fastest(), shape, symbols, blocks, mirrors)
    }

    /// Like [`mirrored`](Self::mirrored), on a chosen engine.
    ///
    /// # Errors
    /// As [`mirrored`](Self::mirrored).
    pub fn on(
        engine: Engine,
        shape: [usize; 2],
        symbols: &[Symbol<'_>],
        blocks: &[Block],
        mirrors: Mirrors,
    ) -> Result<Self, ConvolutionError> {
        let kernels: Vec<_> =
            symbols.iter().map(|symbol| Kernel { values: symbol.values, parity: symbol.parity }).collect();
        let quadrant = mirrors.whole(shape).map(|n| n / 2 + 1);
        let terms = Terms::new(shape, quadrant, &kernels, blocks, mirrors)?;
        let product = PlannedProduct::periodic(engine, &terms, &kernels);
        Ok(Self { terms, product })
    }

    /// Memory to apply this product in.
    pub fn workspace(&self) -> Workspace {
        self.product.workspace()
    }

    /// Computes all outputs (what they held before is lost). Fields are contiguous, `nx * ny` values, index
    /// `i * ny + j`.
    ///
    /// Allocates nothing; the result is bitwise the same for any number of threads.
    ///
    /// # Panics
    /// When the number of fields or their length is not what the product was made for.
    pub fn apply(&self, workspace: &mut Workspace, input: &[&[f64]], output: &mut [&mut [f64]]) {
        self.terms.check_fields(input, output);
        self.product.apply(workspace, input, output);
    }

    /// The same product in single precision, at about half the time; `None` where this machine's engine does not take it.
    pub fn in_single_precision(&self) -> Option<SingleProduct> {
        self.product.in_single_precision(&self.terms)
    }

    /// Number of cells `[nx, ny]`.
    pub fn shape(&self) -> [usize; 2] {
        self.terms.shape
    }

    /// Memory held by the symbols, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.product.memory_bytes()
    }

    /// Symbol values `(nx/2 + 1, ny/2 + 1)` of a kernel in real space that is repeated with the period of the grid, in
    /// the convention of [`Symbol`] (with the kernel's parity).
    ///
    /// Of the kernel the values at offsets `0..=nx/2`, `0..=ny/2` are used; the others follow by parity and period.
    /// Along an odd axis those at 0 and, for even lengths, at half the period count as zero.
    ///
    /// # Panics
    /// When the kernel has fewer values than that.
    pub fn symbol_of(shape: [usize; 2], kernel: &Kernel<'_>) -> Array2<f64> {
        let (found, needed) = (kernel.values.dim(), shape.map(|n| n / 2 + 1));
        assert!(
            found.0 >= needed[0] && found.1 >= needed[1],
            "kernel of {found:?} values periodised on a {shape:?} grid, which needs {needed:?}"
        );
        line_product::symbol_of(shape, kernel)
    }
}
