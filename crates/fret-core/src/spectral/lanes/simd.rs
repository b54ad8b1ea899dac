//! The few vector operations the transforms are written in, for each instruction set.
//!
//! Everything built on [`Lanes`] must be `#[inline(always)]` down to here and be entered through [`Lanes::enter`]:
//! code that is not inlined into it is compiled without the instruction set, and several times slower. Each pass over
//! lines is a [`Task`] of its own, so that it is compiled once, however many stages use it.

use pulp::bytemuck::Pod;

/// Most lanes of any instruction set.
pub const MAX_WIDTH: usize = 8;

/// Work to be compiled for the instruction set `L`.
pub trait Task<L: Lanes> {
    /// Does the work; to be marked `#[inline(always)]`.
    fn run(self, lanes: L);
}

/// An instruction set that is known to be present, working on [`WIDTH`](Self::WIDTH) numbers at a time.
pub trait Lanes: Copy + Send + Sync + 'static {
    /// Number of lanes, a multiple of 4.
    const WIDTH: usize;
    /// One vector of numbers.
    type Reals: Pod + Send + Sync;

    /// Runs a task compiled for this instruction set.
    fn enter<T: Task<Self>>(self, task: T);
    /// The same number in all lanes.
    fn splat(self, value: f64) -> Self::Reals;
    /// `a + b`
    fn add(self, a: Self::Reals, b: Self::Reals) -> Self::Reals;
    /// `a - b`
    fn sub(self, a: Self::Reals, b: Self::Reals) -> Self::Reals;
    /// `a * b`
    fn mul(self, a: Self::Reals, b: Self::Reals) -> Self::Reals;
    /// `a * b + c`, fused where that is fast.
    fn mul_add(self, a: Self::Reals, b: Self::Reals, c: Self::Reals) -> Self::Reals;
    /// `c - a * b`, fused where that is fast.
    fn negate_mul_add(self, a: Self::Reals, b: Self::Reals, c: Self::Reals) -> Self::Reals;
    /// Exchanges rows and columns of the first [`WIDTH`](Self::WIDTH) vectors.
    fn transpose(self, block: &mut [Self::Reals; MAX_WIDTH]);
}

/// Plain arrays, for every machine.
#[derive(Debug, Clone, Copy)]
pub struct Portable;

const PORTABLE_WIDTH: usize = 4;

impl Lanes for Portable {
    const WIDTH: usize = PORTABLE_WIDTH;
    type Reals = [f64; PORTABLE_WIDTH];

    #[inline(never)]
    fn enter<T: Task<Self>>(self, task: T) {
        task.run(self);
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Reals {
        [value; PORTABLE_WIDTH]
    }

    #[inline(always)]
    fn add(self, [a, b, c, d]: Self::Reals, [e, f, g, h]: Self::Reals) -> Self::Reals {
        [a + e, b + f, c + g, d + h]
    }

    #[inline(always)]
    fn sub(self, [a, b, c, d]: Self::Reals, [e, f, g, h]: Self::Reals) -> Self::Reals {
        [a - e, b - f, c - g, d - h]
    }

    #[inline(always)]
    fn mul(self, [a, b, c, d]: Self::Reals, [e, f, g, h]: Self::Reals) -> Self::Reals {
        [a * e, b * f, c * g, d * h]
    }

    #[inline(always)]
    fn mul_add(self, a: Self::Reals, b: Self::Reals, c: Self::Reals) -> Self::Reals {
        self.add(self.mul(a, b), c)
    }

    #[inline(always)]
    fn negate_mul_add(self, a: Self::Reals, b: Self::Reals, c: Self::Reals) -> Self::Reals {
        self.sub(c, self.mul(a, b))
    }

    #[inline(always)]
    fn transpose(self, block: &mut [Self::Reals; MAX_WIDTH]) {
        for row in 0..PORTABLE_WIDTH {
            for column in row + 1..PORTABLE_WIDTH {
                let above = block[row][column];
                block[row][column] = block[column][row];
                block[column][row] = above;
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use core::arch::x86_64::__m512d;

    use pulp::core_arch::x86::Avx512f;
    use pulp::x86::{V3, V4};
    use pulp::{NullaryFnOnce, cast, f64x4, f64x8};

    use super::{Lanes, MAX_WIDTH, Task};

    /// A task waiting to be called inside its instruction set.
    struct Entered<L, T>(L, T);

    impl<L: Lanes, T: Task<L>> NullaryFnOnce for Entered<L, T> {
        type Output = ();

        #[inline(always)]
        fn call(self) {
            self.1.run(self.0);
        }
    }

    /// AVX2 with fused multiply-add.
    impl Lanes for V3 {
        const WIDTH: usize = 4;
        type Reals = f64x4;

        #[inline(always)]
        fn enter<T: Task<Self>>(self, task: T) {
            self.vectorize(Entered(self, task));
        }

        #[inline(always)]
        fn splat(self, value: f64) -> f64x4 {
            self.splat_f64x4(value)
        }

        #[inline(always)]
        fn add(self, a: f64x4, b: f64x4) -> f64x4 {
            self.add_f64x4(a, b)
        }

        #[inline(always)]
        fn sub(self, a: f64x4, b: f64x4) -> f64x4 {
            self.sub_f64x4(a, b)
        }

        #[inline(always)]
        fn mul(self, a: f64x4, b: f64x4) -> f64x4 {
            self.mul_f64x4(a, b)
        }

        #[inline(always)]
        fn mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
            self.mul_add_f64x4(a, b, c)
        }

        #[inline(always)]
        fn negate_mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
            self.negate_mul_add_f64x4(a, b, c)
        }

        #[inline(always)]
        fn transpose(self, block: &mut [f64x4; MAX_WIDTH]) {
            let avx = self.avx;
            let [a, b, c, d] = [cast(block[0]), cast(block[1]), cast(block[2]), cast(block[3])];
            let [ab0, ab1] = [avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b)];
            let [cd0, cd1] = [avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d)];
            block[0] = cast(avx._mm256_permute2f128_pd::<0x20>(ab0, cd0));
            block[1] = cast(avx._mm256_permute2f128_pd::<0x20>(ab1, cd1));
            block[2] = cast(avx._mm256_permute2f128_pd::<0x31>(ab0, cd0));
            block[3] = cast(avx._mm256_permute2f128_pd::<0x31>(ab1, cd1));
        }
    }

    /// Pairs of lanes 0 and 2 of both operands.
    #[inline(always)]
    fn even(avx: Avx512f, a: __m512d, b: __m512d) -> __m512d {
        avx._mm512_shuffle_f64x2::<0x88>(a, b)
    }

    /// Pairs of lanes 1 and 3 of both operands.
    #[inline(always)]
    fn odd(avx: Avx512f, a: __m512d, b: __m512d) -> __m512d {
        avx._mm512_shuffle_f64x2::<0xdd>(a, b)
    }

    /// AVX-512.
    impl Lanes for V4 {
        const WIDTH: usize = 8;
        type Reals = f64x8;

        #[inline(always)]
        fn enter<T: Task<Self>>(self, task: T) {
            self.vectorize(Entered(self, task));
        }

        #[inline(always)]
        fn splat(self, value: f64) -> f64x8 {
            self.splat_f64x8(value)
        }

        #[inline(always)]
        fn add(self, a: f64x8, b: f64x8) -> f64x8 {
            self.add_f64x8(a, b)
        }

        #[inline(always)]
        fn sub(self, a: f64x8, b: f64x8) -> f64x8 {
            self.sub_f64x8(a, b)
        }

        #[inline(always)]
        fn mul(self, a: f64x8, b: f64x8) -> f64x8 {
            self.mul_f64x8(a, b)
        }

        #[inline(always)]
        fn mul_add(self, a: f64x8, b: f64x8, c: f64x8) -> f64x8 {
            self.mul_add_f64x8(a, b, c)
        }

        #[inline(always)]
        fn negate_mul_add(self, a: f64x8, b: f64x8, c: f64x8) -> f64x8 {
            self.negate_mul_add_f64x8(a, b, c)
        }

        #[inline(always)]
        fn transpose(self, block: &mut [f64x8; MAX_WIDTH]) {
            let avx = self.avx512f;
            let [a, b, c, d] = [cast(block[0]), cast(block[1]), cast(block[2]), cast(block[3])];
            let [e, f, g, h] = [cast(block[4]), cast(block[5]), cast(block[6]), cast(block[7])];
            let [ab0, ab1] = [avx._mm512_unpacklo_pd(a, b), avx._mm512_unpackhi_pd(a, b)];
            let [cd0, cd1] = [avx._mm512_unpacklo_pd(c, d), avx._mm512_unpackhi_pd(c, d)];
            let [ef0, ef1] = [avx._mm512_unpacklo_pd(e, f), avx._mm512_unpackhi_pd(e, f)];
            let [gh0, gh1] = [avx._mm512_unpacklo_pd(g, h), avx._mm512_unpackhi_pd(g, h)];
            let [abcd0, abcd2] = [even(avx, ab0, cd0), odd(avx, ab0, cd0)];
            let [abcd1, abcd3] = [even(avx, ab1, cd1), odd(avx, ab1, cd1)];
            let [efgh0, efgh2] = [even(avx, ef0, gh0), odd(avx, ef0, gh0)];
            let [efgh1, efgh3] = [even(avx, ef1, gh1), odd(avx, ef1, gh1)];
            block[0] = cast(even(avx, abcd0, efgh0));
            block[1] = cast(even(avx, abcd1, efgh1));
            block[2] = cast(even(avx, abcd2, efgh2));
            block[3] = cast(even(avx, abcd3, efgh3));
            block[4] = cast(odd(avx, abcd0, efgh0));
            block[5] = cast(odd(avx, abcd1, efgh1));
            block[6] = cast(odd(avx, abcd2, efgh2));
            block[7] = cast(odd(avx, abcd3, efgh3));
        }
    }
}
