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

#[cfg(test)]
mod tests {
    use super::*;

    const CACHE_LINE: usize = 64;

    #[test]
    fn it_grows_and_never_shrinks() {
        let mut workspace = Workspace::default();
        assert_eq!(workspace.memory_bytes(), 0);
        for (count, held) in [(100, 100), (50, 100), (101, 101), (1000, 1000)] {
            let numbers = workspace.lanes(count);
            assert!(numbers.len() >= count);
            assert_eq!(numbers.as_ptr().addr() % CACHE_LINE, 0, "numbers start on a cache line");
            let memory = workspace.memory_bytes();
            assert!((8 * held..=8 * held + CACHE_LINE).contains(&memory), "{count}: {memory}");
        }
        let before = workspace.memory_bytes();
        for (count, held) in [(10, 10), (3, 10), (12, 12)] {
            assert_eq!(workspace.lines(count).len(), count);
            let memory = workspace.memory_bytes() - before;
            assert!((16 * held..=32 * held).contains(&memory), "{count}: {memory}"); // a vector may grow by doubling
        }
    }

    #[test]
    fn single_precision_takes_half_the_memory() {
        for count in [100, 101] {
            let mut workspace = Workspace::default();
            assert!(workspace.single_lanes(count).len() >= count);
            assert!((4 * count..=4 * count + 8 + CACHE_LINE).contains(&workspace.memory_bytes()));
        }
    }
}
