//! Products in single precision, for numbers of which six digits are enough.

use super::Workspace;
use super::lanes::LaneProduct;

/// A [`Convolution`](super::Convolution) or [`PeriodicProduct`](super::PeriodicProduct) in single precision.
///
/// Its rounding is about 1e-7 of the largest output. Outputs are in units of [`unit`](Self::unit); inputs are best brought to
/// a size near one, since single precision ends at 1e-38 and 1e38.
pub struct SingleProduct {
    product: LaneProduct<f32>,
    unit: f64,
}

impl SingleProduct {
    pub(super) fn new((product, unit): (LaneProduct<f32>, f64)) -> Self {
        Self { product, unit }
    }

    /// Computes all outputs (what they held before is lost), divided by [`unit`](Self::unit). Fields are those of the product
    /// this one was made of; bitwise the same for any number of threads.
    pub fn apply(&self, workspace: &mut Workspace, input: &[&[f32]], output: &mut [&mut [f32]]) {
        let count = self.product.work_len(rayon::current_num_threads());
        self.product.apply(workspace.single_lanes(count), input, output);
    }

    /// What the outputs must be multiplied with: a power of two.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Memory held by the transformed kernels, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.product.memory_bytes()
    }
}
