//! Products of fields with kernels in free space.

use super::engine::PlannedProduct;
use super::terms::Terms;
use super::{Block, ConvolutionError, Engine, Kernel, Mirrors, SingleProduct, Workspace};

/// Free-space product of fields with translation-invariant kernels:
///
/// `output_o[i, j] = sum over blocks (o, f, k, s) of s * sum_{m, n} K_k[i - m, j - n] input_f[m, n]`
///
/// over a grid of `nx x ny` cells, with nothing outside. Immutable and shareable between threads; the memory it works
/// in is a [`Workspace`].
///
/// ```
/// # use fretting_fft::{Block, Convolution, Kernel, Parity};
/// let values = ndarray::array![[4.0, 2.0], [1.0, 0.5]]; // offsets (0, 0), (0, 1); (1, 0), (1, 1)
/// let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
/// let block = Block { output: 0, input: 0, kernel: 0, sign: 1.0 };
/// let convolution = Convolution::new([2, 2], &[kernel], &[block])?;
/// let mut workspace = convolution.workspace();
/// let mut output = vec![0.0; 4];
/// convolution.apply(&mut workspace, &[&[0.0, 0.0, 0.0, 1.0]], &mut [&mut output]);
/// for (found, expected) in output.iter().zip([0.5, 1.0, 2.0, 4.0]) {
///     assert!((found - expected).abs() < 1e-14);
/// }
/// # Ok::<(), fretting_fft::ConvolutionError>(())
/// ```
pub struct Convolution {
    pub(super) terms: Terms,
    pub(super) product: PlannedProduct,
}

impl Convolution {
    /// Plans the product on a grid of `shape = [nx, ny]` cells, any size from `1 x 1`.
    ///
    /// Of each kernel the leading `nx x ny` values are used. Costs about half an application per kernel.
    ///
    /// # Errors
    /// When the shape is empty, there are no blocks, a kernel is too small or not finite, or a block names a kernel
    /// that is not there.
    pub fn new(
        shape: [usize; 2],
        kernels: &[Kernel<'_>],
        blocks: &[Block],
    ) -> Result<Self, ConvolutionError> {
        Self::on(Engine::fastest(), shape, kernels, blocks, Mirrors::NONE)
    }

    /// The product of fields that go on behind mirrors, on the cells in front of them: `shape` counts these, and of each kernel
    /// as many values are used as the whole grid has. A mirror halves the work.
    ///
    /// # Errors
    /// As [`new`](Self::new), and when the blocks would make an output even and odd at once.
    pub fn mirrored(
        shape: [usize; 2],
        kernels: &[Kernel<'_>],
        blocks: &[Block],
        mirrors: Mirrors,
    ) -> Result<Self, ConvolutionError> {
        Self::on(Engine::fastest(), shape, kernels, blocks, mirrors)
    }

    /// Like [`mirrored`](Self::mirrored), on a chosen engine.
    ///
    /// # Errors
    /// As [`mirrored`](Self::mirrored).
    pub fn on(
        engine: Engine,
        shape: [usize; 2],
        kernels: &[Kernel<'_>],
        blocks: &[Block],
        mirrors: Mirrors,
    ) -> Result<Self, ConvolutionError> {
        let quadrant = mirrors.whole(shape);
        let terms = Terms::new(shape, quadrant, kernels, blocks, mirrors)?;
        let product = PlannedProduct::free_space(engine, &terms, kernels);
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

    /// Memory held by the transformed kernels, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.product.memory_bytes()
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::super::tests::block;
    use super::super::{Parity, PeriodicProduct, Symbol};
    use super::*;

    /// Applies a product to a field in the memory that it made.
    fn check(
        mut workspace: Workspace,
        shape: [usize; 2],
        apply: impl Fn(&mut Workspace, &[f64], &mut [f64]),
    ) {
        let memory = workspace.memory_bytes();
        assert!(memory >= 8 * shape[0] * shape[1], "room for a field at least");
        let input = vec![1.0; shape[0] * shape[1]];
        apply(&mut workspace, &input, &mut vec![0.0; input.len()]);
        assert_eq!(workspace.memory_bytes(), memory);
    }

    /// What `workspace()` makes is what a product works in: it grows only when another product or a larger pool comes.
    #[test]
    fn a_product_works_in_the_workspace_that_it_made() -> Result<(), rayon::ThreadPoolBuildError> {
        let values = Array2::<f64>::ones([128, 120]);
        let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
        let symbol = Symbol { values: values.view(), parity: Parity::EvenEven };
        let blocks = [block(0, 0, 0, 1.0)];
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            pool.install(|| {
                for engine in Engine::available() {
                    for (axes, shape) in
                        [([false, false], [128, 120]), ([true, true], [64, 60]), ([false, true], [45, 50])]
                    {
                        let mirrors = Mirrors { axes, inputs: vec![Parity::OddEven] };
                        let product =
                            Convolution::on(engine, shape, &[kernel], &blocks, mirrors.clone()).unwrap();
                        check(product.workspace(), shape, |workspace, input, output| {
                            product.apply(workspace, &[input], &mut [output]);
                        });
                        let product =
                            PeriodicProduct::on(engine, shape, &[symbol], &blocks, mirrors).unwrap();
                        check(product.workspace(), shape, |workspace, input, output| {
                            product.apply(workspace, &[input], &mut [output]);
                        });
                    }
                }
            });
        }
        Ok(())
    }
}
