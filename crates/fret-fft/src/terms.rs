//! The terms of a product, checked once at the door.

use ndarray::{ArrayView1, ArrayView2, s};

use super::block::{Block, ConvolutionError, Kernel};
use super::lanes::pieces;
use super::{Mirrors, Parity};

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
    pub fn check_fields(&self, input: &[&[f64]], output: &[impl AsRef<[f64]>]) {
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
        let outputs = output.iter().map(|field| field.as_ref().len());
        for found in input.iter().map(|field| field.len()).chain(outputs) {
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
