//! AVX2 and AVX-512.

use core::arch::x86_64::{__m256, __m512, __m512d};

use pulp::core_arch::x86::Avx512f;
use pulp::x86::{V3, V4};
use pulp::{cast, f32x8, f32x16, f64x4, f64x8};

use super::simd::{Lanes, Single, Task};
use super::vectors::{Entered, lanes};

lanes!(
    V3,
    |self| self,
    f64,
    4,
    f64x4,
    transpose_4,
    [splat_f64x4, add_f64x4, sub_f64x4, mul_f64x4, mul_add_f64x4, negate_mul_add_f64x4]
);
lanes!(
    V4,
    |self| self,
    f64,
    8,
    f64x8,
    transpose_8,
    [splat_f64x8, add_f64x8, sub_f64x8, mul_f64x8, mul_add_f64x8, negate_mul_add_f64x8]
);
lanes!(
    Single<V3>,
    |self| self.0,
    f32,
    8,
    f32x8,
    transpose_8_single,
    [splat_f32x8, add_f32x8, sub_f32x8, mul_f32x8, mul_add_f32x8, negate_mul_add_f32x8]
);
lanes!(
    Single<V4>,
    |self| self.0,
    f32,
    16,
    f32x16,
    transpose_16_single,
    [splat_f32x16, add_f32x16, sub_f32x16, mul_f32x16, mul_add_f32x16, negate_mul_add_f32x16]
);

// Written out: closures and `array::map` would stay calls, and blocks would travel through memory.

#[inline(always)]
fn transpose_4(set: V3, block: &mut [f64x4; 4]) {
    let avx = set.avx;
    let [a, b, c, d] = [cast(block[0]), cast(block[1]), cast(block[2]), cast(block[3])];
    let [ab0, ab1] = [avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b)];
    let [cd0, cd1] = [avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d)];
    block[0] = cast(avx._mm256_permute2f128_pd::<0x20>(ab0, cd0));
    block[1] = cast(avx._mm256_permute2f128_pd::<0x20>(ab1, cd1));
    block[2] = cast(avx._mm256_permute2f128_pd::<0x31>(ab0, cd0));
    block[3] = cast(avx._mm256_permute2f128_pd::<0x31>(ab1, cd1));
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
fn transpose_8(set: V4, block: &mut [f64x8; 8]) {
    let avx = set.avx512f;
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

/// Four vectors of two halves each, transposed half by half.
#[inline(always)]
fn halves(set: V3, a: f32x8, b: f32x8, c: f32x8, d: f32x8) -> [__m256; 4] {
    let avx = set.avx;
    let [a, b, c, d] = [cast(a), cast(b), cast(c), cast(d)];
    let [ab0, ab1] = [avx._mm256_unpacklo_ps(a, b), avx._mm256_unpackhi_ps(a, b)];
    let [cd0, cd1] = [avx._mm256_unpacklo_ps(c, d), avx._mm256_unpackhi_ps(c, d)];
    [
        avx._mm256_shuffle_ps::<0x44>(ab0, cd0),
        avx._mm256_shuffle_ps::<0xee>(ab0, cd0),
        avx._mm256_shuffle_ps::<0x44>(ab1, cd1),
        avx._mm256_shuffle_ps::<0xee>(ab1, cd1),
    ]
}

#[inline(always)]
fn transpose_8_single(set: V3, block: &mut [f32x8; 8]) {
    let avx = set.avx;
    let [a0, a1, a2, a3] = halves(set, block[0], block[1], block[2], block[3]);
    let [b0, b1, b2, b3] = halves(set, block[4], block[5], block[6], block[7]);
    block[0] = cast(avx._mm256_permute2f128_ps::<0x20>(a0, b0));
    block[1] = cast(avx._mm256_permute2f128_ps::<0x20>(a1, b1));
    block[2] = cast(avx._mm256_permute2f128_ps::<0x20>(a2, b2));
    block[3] = cast(avx._mm256_permute2f128_ps::<0x20>(a3, b3));
    block[4] = cast(avx._mm256_permute2f128_ps::<0x31>(a0, b0));
    block[5] = cast(avx._mm256_permute2f128_ps::<0x31>(a1, b1));
    block[6] = cast(avx._mm256_permute2f128_ps::<0x31>(a2, b2));
    block[7] = cast(avx._mm256_permute2f128_ps::<0x31>(a3, b3));
}

/// Four vectors of four quarters each, transposed quarter by quarter.
#[inline(always)]
fn quarters(set: V4, a: f32x16, b: f32x16, c: f32x16, d: f32x16) -> [__m512; 4] {
    let avx = set.avx512f;
    let [a, b, c, d] = [cast(a), cast(b), cast(c), cast(d)];
    let [ab0, ab1] = [avx._mm512_unpacklo_ps(a, b), avx._mm512_unpackhi_ps(a, b)];
    let [cd0, cd1] = [avx._mm512_unpacklo_ps(c, d), avx._mm512_unpackhi_ps(c, d)];
    [
        avx._mm512_shuffle_ps::<0x44>(ab0, cd0),
        avx._mm512_shuffle_ps::<0xee>(ab0, cd0),
        avx._mm512_shuffle_ps::<0x44>(ab1, cd1),
        avx._mm512_shuffle_ps::<0xee>(ab1, cd1),
    ]
}

/// The quarters of four vectors as rows and columns, transposed.
#[inline(always)]
fn of_quarters(set: V4, a: __m512, b: __m512, c: __m512, d: __m512) -> [f32x16; 4] {
    let avx = set.avx512f;
    let [ab_even, ab_odd] = [avx._mm512_shuffle_f32x4::<0x88>(a, b), avx._mm512_shuffle_f32x4::<0xdd>(a, b)];
    let [cd_even, cd_odd] = [avx._mm512_shuffle_f32x4::<0x88>(c, d), avx._mm512_shuffle_f32x4::<0xdd>(c, d)];
    [
        cast(avx._mm512_shuffle_f32x4::<0x88>(ab_even, cd_even)),
        cast(avx._mm512_shuffle_f32x4::<0x88>(ab_odd, cd_odd)),
        cast(avx._mm512_shuffle_f32x4::<0xdd>(ab_even, cd_even)),
        cast(avx._mm512_shuffle_f32x4::<0xdd>(ab_odd, cd_odd)),
    ]
}

#[inline(always)]
fn transpose_16_single(set: V4, block: &mut [f32x16; 16]) {
    // Of each four rows: vector m holds column 4q + m in quarter q.
    let [a0, a1, a2, a3] = quarters(set, block[0], block[1], block[2], block[3]);
    let [b0, b1, b2, b3] = quarters(set, block[4], block[5], block[6], block[7]);
    let [c0, c1, c2, c3] = quarters(set, block[8], block[9], block[10], block[11]);
    let [d0, d1, d2, d3] = quarters(set, block[12], block[13], block[14], block[15]);
    [block[0], block[4], block[8], block[12]] = of_quarters(set, a0, b0, c0, d0);
    [block[1], block[5], block[9], block[13]] = of_quarters(set, a1, b1, c1, d1);
    [block[2], block[6], block[10], block[14]] = of_quarters(set, a2, b2, c2, d2);
    [block[3], block[7], block[11], block[15]] = of_quarters(set, a3, b3, c3, d3);
}
