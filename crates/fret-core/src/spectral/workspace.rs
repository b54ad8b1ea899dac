//! The memory a product works in.

use rustfft::num_complex::Complex;

/// Scratch memory of a [`Convolution`](super::Convolution) or [`PeriodicProduct`](super::PeriodicProduct).
///
/// Made once by `workspace()`, passed to every `apply`; its content after a call is nobody's. One made for another
/// product works too: it grows, once, to what is needed.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    pub(super) lines: Vec<Complex<f64>>,
}

impl Workspace {
    /// At least `count` complex numbers of unknown content.
    pub(super) fn lines(&mut self, count: usize) -> &mut [Complex<f64>] {
        if self.lines.len() < count {
            self.lines.resize(count, Complex::default());
        }
        &mut self.lines[..count]
    }

    /// Memory held [bytes].
    pub fn memory_bytes(&self) -> usize {
        self.lines.capacity() * size_of::<Complex<f64>>()
    }
}
