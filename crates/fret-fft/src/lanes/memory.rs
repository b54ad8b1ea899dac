//! Numbers that start on a cache line, seen as vectors.

use pulp::bytemuck;

use super::simd::{Lanes, Number};

/// Bytes in one cache line.
const CACHE_LINE: usize = 64;

/// Numbers in one cache line.
pub const fn numbers_in_cache_line<N>() -> usize {
    CACHE_LINE / size_of::<N>()
}

/// One complex number of all lanes in memory: real parts, then imaginary parts.
pub type Line<L> = [<L as Lanes>::Reals; 2];

/// A value that starts on a cache line: vectors have the alignment of their numbers only, and an array of them on the stack
/// would straddle lines.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct OnCacheLine<T>(pub T);

/// Numbers whose first one starts a cache line.
#[derive(Debug, Clone, Default)]
pub struct AlignedNumbers<N> {
    numbers: Vec<N>,
    len: usize,
}

impl<N: Number> AlignedNumbers<N> {
    pub fn zeros(len: usize) -> Self {
        Self { numbers: vec![N::default(); len + numbers_in_cache_line::<N>()], len }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    fn start(&self) -> usize {
        // Alignment is a matter of speed only.
        self.numbers.as_ptr().align_offset(CACHE_LINE).min(self.numbers.len() - self.len)
    }

    pub fn as_slice(&self) -> &[N] {
        let start = self.start();
        &self.numbers[start..start + self.len]
    }

    pub fn as_mut_slice(&mut self) -> &mut [N] {
        let start = self.start();
        &mut self.numbers[start..start + self.len]
    }

    /// Memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.numbers.capacity() * size_of::<N>()
    }
}

/// Numbers as vectors; the length must be a multiple of the width.
#[inline(always)]
pub fn as_vectors<L: Lanes>(numbers: &[L::Number]) -> &[L::Reals] {
    bytemuck::cast_slice(numbers)
}

#[inline(always)]
pub fn as_vectors_mut<L: Lanes>(numbers: &mut [L::Number]) -> &mut [L::Reals] {
    bytemuck::cast_slice_mut(numbers)
}

/// Numbers as complex vectors; the length must be a multiple of twice the width.
#[inline(always)]
pub fn as_lines<L: Lanes>(numbers: &[L::Number]) -> &[Line<L>] {
    bytemuck::cast_slice(numbers)
}

#[inline(always)]
pub fn as_lines_mut<L: Lanes>(numbers: &mut [L::Number]) -> &mut [Line<L>] {
    bytemuck::cast_slice_mut(numbers)
}

/// Asks the caches for numbers that are read soon, if there are any: pieces of a few cache lines far apart the machine does not see coming, and
/// kernels arrive late. Changes nothing but time.
#[inline(always)]
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(unused_variables, reason = "other machines are left to themselves")
)]
pub fn fetch<T>(soon: Option<&[T]>) {
    #[cfg(target_arch = "x86_64")]
    for number in soon.unwrap_or_default().iter().step_by((CACHE_LINE / size_of::<T>()).max(1)) {
        #[expect(
            unsafe_code,
            reason = "a hint about memory that is borrowed here; it reads and writes nothing"
        )]
        // SAFETY: prefetching is allowed at any address, and this one is valid.
        unsafe {
            use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(number).cast());
        }
    }
}
