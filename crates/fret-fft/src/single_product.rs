//! Products in single precision, for numbers of which six digits are enough.

use super::lanes::{AlignedNumbers, LaneProduct};

/// A [`Convolution`](super::Convolution) or [`PeriodicProduct`](super::PeriodicProduct) in single precision, with the memory it
/// works in.
///
/// Its rounding is about 1e-7 of the largest output. Outputs are in units of [`unit`](Self::unit); inputs are best brought to
/// a size near one, since single precision ends at 1e-38 and 1e38.
pub struct SingleProduct {
    product: LaneProduct<f32>,
    unit: f64,
    work: AlignedNumbers<f32>,
}

impl SingleProduct {
    pub(super) fn new((product, unit): (LaneProduct<f32>, f64)) -> Self {
        let work = AlignedNumbers::zeros(product.work_len(rayon::current_num_threads()));
        Self { product, unit, work }
    }

    /// Computes all outputs (what they held before is lost), divided by [`unit`](Self::unit). Fields are those of the product
    /// this one was made of; bitwise the same for any number of threads.
    pub fn apply(&mut self, input: &[&[f32]], output: &mut [&mut [f32]]) {
        self.product.apply(self.work.as_mut_slice(), input, output);
    }

    /// What the outputs must be multiplied with: a power of two.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.product.memory_bytes() + self.work.memory_bytes()
    }
}
