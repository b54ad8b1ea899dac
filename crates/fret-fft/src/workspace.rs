//! The memory a product works in.

use pulp::bytemuck;
use rustfft::num_complex::Complex;

use super::lanes::AlignedNumbers;

/// Scratch memory of a [`Convolution`](super::Convolution) or [`PeriodicProduct`](super::PeriodicProduct).
///
/// Made once by `workspace()`, passed to every `apply`; its content after a call is nobody's. One serves any number of products, one after
/// the other, in either precision: where it is too small for a product or for the threads of the pool it grows, once.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    lanes: AlignedNumbers<f64>,
    lines: Vec<Complex<f64>>,
}

impl Workspace {
    /// At least `count` numbers of unknown content, from the start of a cache line on.
    pub(super) fn lanes(&mut self, count: usize) -> &mut [f64] {
        if self.lanes.len() < count {
            self.lanes = AlignedNumbers::zeros(count);
        }
        self.lanes.as_mut_slice()
    }

    /// As [`lanes`](Self::lanes), in single precision.
    pub(super) fn single_lanes(&mut self, count: usize) -> &mut [f32] {
        bytemuck::cast_slice_mut(self.lanes(count.div_ceil(2)))
    }

    /// `count` complex numbers of unknown content.
    pub(super) fn lines(&mut self, count: usize) -> &mut [Complex<f64>] {
        if self.lines.len() < count {
            self.lines.resize(count, Complex::default());
        }
        &mut self.lines[..count]
    }

    /// Memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.lanes.memory_bytes() + self.lines.capacity() * size_of::<Complex<f64>>()
    }
}
