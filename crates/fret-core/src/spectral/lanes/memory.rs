//! Numbers that start on a cache line, seen as vectors.

use pulp::bytemuck;

use super::simd::Lanes;

/// Numbers in one cache line.
pub const CACHE_LINE: usize = 8;

/// One complex number of all lanes in memory: real parts, then imaginary parts.
pub type Line<L> = [<L as Lanes>::Reals; 2];

/// A value that starts on a cache line: vectors have the alignment of their numbers only, and an array of them on the stack
/// would straddle lines.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct OnCacheLine<T>(pub T);

/// Real numbers whose first one starts a cache line.
#[derive(Debug, Clone, Default)]
pub struct AlignedReals {
    numbers: Vec<f64>,
    len: usize,
}

impl AlignedReals {
    pub fn zeros(len: usize) -> Self {
        Self { numbers: vec![0.0; len + CACHE_LINE], len }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    fn start(&self) -> usize {
        // Alignment is a matter of speed only.
        self.numbers.as_ptr().align_offset(CACHE_LINE * size_of::<f64>()).min(self.numbers.len() - self.len)
    }

    pub fn as_slice(&self) -> &[f64] {
        let start = self.start();
        &self.numbers[start..start + self.len]
    }

    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        let start = self.start();
        &mut self.numbers[start..start + self.len]
    }

    /// Memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.numbers.capacity() * size_of::<f64>()
    }
}

/// Numbers as vectors; the length must be a multiple of the width.
#[inline(always)]
pub fn as_vectors<L: Lanes>(numbers: &[f64]) -> &[L::Reals] {
    bytemuck::cast_slice(numbers)
}

#[inline(always)]
pub fn as_vectors_mut<L: Lanes>(numbers: &mut [f64]) -> &mut [L::Reals] {
    bytemuck::cast_slice_mut(numbers)
}

/// Numbers as complex vectors; the length must be a multiple of twice the width.
#[inline(always)]
pub fn as_lines<L: Lanes>(numbers: &[f64]) -> &[Line<L>] {
    bytemuck::cast_slice(numbers)
}

#[inline(always)]
pub fn as_lines_mut<L: Lanes>(numbers: &mut [f64]) -> &mut [Line<L>] {
    bytemuck::cast_slice_mut(numbers)
}
