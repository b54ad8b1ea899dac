//! AVX2 and AVX-512.

use core::arch::x86_64::{__m256, __m512, __m512d};

use pulp::core_arch::x86::Avx512f;
use pulp::x86::{V3, V4};
use pulp::{NullaryFnOnce, cast, f32x8, f32x16, f64x4, f64x8};

use super::simd::{Lanes, Task};

/// A task waiting to be called inside its instruction set.
struct Entered<L, T>(L, T);

impl<L: Lanes, T: Task<L>> NullaryFnOnce for Entered<L, T> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.1.run(self.0);
    }
}

/// An instruction set on numbers of single precision.
#[derive(Debug, Clone, Copy)]
pub struct Single<A>(A);

impl<A> From<A> for Single<A> {
    fn from(set: A) -> Self {
        Self(set)
    }
}

/// Lanes on the vectors of one instruction set: how to reach its operations, and their names.
macro_rules! lanes {
    ($lanes:ty, |$self:ident| $set:expr, $number:ty, $width:literal, $vector:ty, $transposed:ident,
     [$splat:ident, $add:ident, $sub:ident, $mul:ident, $mul_add:ident, $negate_mul_add:ident]) => {
        impl Lanes for $lanes {
            const WIDTH: usize = $width;
            type Number = $number;
            type Reals = $vector;
            type Block = [$vector; $width];

            #[inline(always)]
            fn enter<T: Task<Self>>($self, task: T) {
                $set.vectorize(Entered($self, task));
            }

            #[inline(always)]
            fn splat($self, value: $number) -> $vector {
                $set.$splat(value)
            }

            #[inline(always)]
            fn block($self, value: $vector) -> Self::Block {
                [value; $width]
            }

            #[inline(always)]
            fn add($self, a: $vector, b: $vector) -> $vector {
                $set.$add(a, b)
            }

            #[inline(always)]
            fn sub($self, a: $vector, b: $vector) -> $vector {
                $set.$sub(a, b)
            }

            #[inline(always)]
            fn mul($self, a: $vector, b: $vector) -> $vector {
                $set.$mul(a, b)
            }

            #[inline(always)]
            fn mul_add($self, a: $vector, b: $vector, c: $vector) -> $vector {
                $set.$mul_add(a, b, c)
            }

            #[inline(always)]
            fn negate_mul_add($self, a: $vector, b: $vector, c: $vector) -> $vector {
                $set.$negate_mul_add(a, b, c)
            }

            #[inline(always)]
            fn transpose($self, block: &mut Self::Block) {
                *block = $transposed($set, *block);
            }
        }
    };
}

lanes!(
    V3,
    |self| self,
    f64,
    4,
    f64x4,
    transposed_4,
    [splat_f64x4, add_f64x4, sub_f64x4, mul_f64x4, mul_add_f64x4, negate_mul_add_f64x4]
);
lanes!(
    V4,
    |self| self,
    f64,
    8,
    f64x8,
    transposed_8,
    [splat_f64x8, add_f64x8, sub_f64x8, mul_f64x8, mul_add_f64x8, negate_mul_add_f64x8]
);
lanes!(
    Single<V3>,
    |self| self.0,
    f32,
    8,
    f32x8,
    transposed_8_single,
    [splat_f32x8, add_f32x8, sub_f32x8, mul_f32x8, mul_add_f32x8, negate_mul_add_f32x8]
);
lanes!(
    Single<V4>,
    |self| self.0,
    f32,
    16,
    f32x16,
    transposed_16_single,
    [splat_f32x16, add_f32x16, sub_f32x16, mul_f32x16, mul_add_f32x16, negate_mul_add_f32x16]
);

#[inline(always)]
fn transposed_4(set: V3, [a, b, c, d]: [f64x4; 4]) -> [f64x4; 4] {
    let avx = set.avx;
    let [a, b, c, d] = [cast(a), cast(b), cast(c), cast(d)];
    let [ab0, ab1] = [avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b)];
    let [cd0, cd1] = [avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d)];
    [
        cast(avx._mm256_permute2f128_pd::<0x20>(ab0, cd0)),
        cast(avx._mm256_permute2f128_pd::<0x20>(ab1, cd1)),
        cast(avx._mm256_permute2f128_pd::<0x31>(ab0, cd0)),
        cast(avx._mm256_permute2f128_pd::<0x31>(ab1, cd1)),
    ]
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

#[inline(always)]
fn transposed_8(set: V4, [a, b, c, d, e, f, g, h]: [f64x8; 8]) -> [f64x8; 8] {
    let avx = set.avx512f;
    let [a, b, c, d] = [cast(a), cast(b), cast(c), cast(d)];
    let [e, f, g, h] = [cast(e), cast(f), cast(g), cast(h)];
    let [ab0, ab1] = [avx._mm512_unpacklo_pd(a, b), avx._mm512_unpackhi_pd(a, b)];
    let [cd0, cd1] = [avx._mm512_unpacklo_pd(c, d), avx._mm512_unpackhi_pd(c, d)];
    let [ef0, ef1] = [avx._mm512_unpacklo_pd(e, f), avx._mm512_unpackhi_pd(e, f)];
    let [gh0, gh1] = [avx._mm512_unpacklo_pd(g, h), avx._mm512_unpackhi_pd(g, h)];
    let [abcd0, abcd2] = [even(avx, ab0, cd0), odd(avx, ab0, cd0)];
    let [abcd1, abcd3] = [even(avx, ab1, cd1), odd(avx, ab1, cd1)];
    let [efgh0, efgh2] = [even(avx, ef0, gh0), odd(avx, ef0, gh0)];
    let [efgh1, efgh3] = [even(avx, ef1, gh1), odd(avx, ef1, gh1)];
    [
        cast(even(avx, abcd0, efgh0)),
        cast(even(avx, abcd1, efgh1)),
        cast(even(avx, abcd2, efgh2)),
        cast(even(avx, abcd3, efgh3)),
        cast(odd(avx, abcd0, efgh0)),
        cast(odd(avx, abcd1, efgh1)),
        cast(odd(avx, abcd2, efgh2)),
        cast(odd(avx, abcd3, efgh3)),
    ]
}

#[inline(always)]
fn transposed_8_single(set: V3, block: [f32x8; 8]) -> [f32x8; 8] {
    let avx = set.avx;
    let [a, b, c, d, e, f, g, h]: [__m256; 8] = [
        cast(block[0]),
        cast(block[1]),
        cast(block[2]),
        cast(block[3]),
        cast(block[4]),
        cast(block[5]),
        cast(block[6]),
        cast(block[7]),
    ];
    // Four by four inside each half of the vectors, then the halves.
    let quads = |a: __m256, b: __m256, c: __m256, d: __m256| {
        let [ab0, ab1] = [avx._mm256_unpacklo_ps(a, b), avx._mm256_unpackhi_ps(a, b)];
        let [cd0, cd1] = [avx._mm256_unpacklo_ps(c, d), avx._mm256_unpackhi_ps(c, d)];
        [
            avx._mm256_shuffle_ps::<0x44>(ab0, cd0),
            avx._mm256_shuffle_ps::<0xee>(ab0, cd0),
            avx._mm256_shuffle_ps::<0x44>(ab1, cd1),
            avx._mm256_shuffle_ps::<0xee>(ab1, cd1),
        ]
    };
    let [above, below] = [quads(a, b, c, d), quads(e, f, g, h)];
    [
        cast(avx._mm256_permute2f128_ps::<0x20>(above[0], below[0])),
        cast(avx._mm256_permute2f128_ps::<0x20>(above[1], below[1])),
        cast(avx._mm256_permute2f128_ps::<0x20>(above[2], below[2])),
        cast(avx._mm256_permute2f128_ps::<0x20>(above[3], below[3])),
        cast(avx._mm256_permute2f128_ps::<0x31>(above[0], below[0])),
        cast(avx._mm256_permute2f128_ps::<0x31>(above[1], below[1])),
        cast(avx._mm256_permute2f128_ps::<0x31>(above[2], below[2])),
        cast(avx._mm256_permute2f128_ps::<0x31>(above[3], below[3])),
    ]
}

/// Four vectors of four quarters each, transposed quarter by quarter.
#[inline(always)]
fn quarters(avx: Avx512f, [a, b, c, d]: [__m512; 4]) -> [__m512; 4] {
    let [ab0, ab1] = [avx._mm512_unpacklo_ps(a, b), avx._mm512_unpackhi_ps(a, b)];
    let [cd0, cd1] = [avx._mm512_unpacklo_ps(c, d), avx._mm512_unpackhi_ps(c, d)];
    [
        avx._mm512_shuffle_ps::<0x44>(ab0, cd0),
        avx._mm512_shuffle_ps::<0xee>(ab0, cd0),
        avx._mm512_shuffle_ps::<0x44>(ab1, cd1),
        avx._mm512_shuffle_ps::<0xee>(ab1, cd1),
    ]
}

/// The quarters of four vectors as rows and columns of a block, transposed.
#[inline(always)]
fn of_quarters(avx: Avx512f, [a, b, c, d]: [__m512; 4]) -> [__m512; 4] {
    let [ab_even, ab_odd] = [avx._mm512_shuffle_f32x4::<0x88>(a, b), avx._mm512_shuffle_f32x4::<0xdd>(a, b)];
    let [cd_even, cd_odd] = [avx._mm512_shuffle_f32x4::<0x88>(c, d), avx._mm512_shuffle_f32x4::<0xdd>(c, d)];
    [
        avx._mm512_shuffle_f32x4::<0x88>(ab_even, cd_even),
        avx._mm512_shuffle_f32x4::<0x88>(ab_odd, cd_odd),
        avx._mm512_shuffle_f32x4::<0xdd>(ab_even, cd_even),
        avx._mm512_shuffle_f32x4::<0xdd>(ab_odd, cd_odd),
    ]
}

#[inline(always)]
fn transposed_16_single(set: V4, mut block: [f32x16; 16]) -> [f32x16; 16] {
    let avx = set.avx512f;
    // Rows 4g..4g+4, quarter by quarter: vector m of group g holds column 4q + m of these rows in quarter q.
    for group in 0..4 {
        let rows = [0, 1, 2, 3].map(|row| cast(block[4 * group + row]));
        let rows = quarters(avx, rows);
        for row in 0..4 {
            block[4 * group + row] = cast(rows[row]);
        }
    }
    let mut result = block;
    for m in 0..4 {
        let groups = [0, 1, 2, 3].map(|group| cast(block[4 * group + m]));
        let columns = of_quarters(avx, groups);
        for quarter in 0..4 {
            result[4 * quarter + m] = cast(columns[quarter]);
        }
    }
    result
}
