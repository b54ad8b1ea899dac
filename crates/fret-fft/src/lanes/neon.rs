//! NEON, two registers of 16 bytes at a time.

use pulp::aarch64::Neon;
use pulp::{NullaryFnOnce, cast, f32x4, f64x2};

use super::simd::{Lanes, Single, Task};
use super::vectors::{Entered, lanes};

/// NEON on pairs of registers.
#[derive(Debug, Clone, Copy)]
struct Pairs(Neon);

impl Pairs {
    #[inline(always)]
    fn vectorize(self, work: impl NullaryFnOnce<Output = ()>) {
        self.0.vectorize(work);
    }
}

/// Lanes on pairs of registers: the operations on one register, by their names, done on both.
macro_rules! paired_lanes {
    ($lanes:ty, |$self:ident| $set:expr, $number:ty, $width:literal, $register:ty, $transpose:ident,
     [$splat:ident, $add:ident, $sub:ident, $mul:ident, $mul_add:ident, $negate_mul_add:ident]) => {
        impl Pairs {
            #[inline(always)]
            fn $splat(self, value: $number) -> [$register; 2] {
                [self.0.$splat(value); 2]
            }

            #[inline(always)]
            fn $add(self, [a, b]: [$register; 2], [c, d]: [$register; 2]) -> [$register; 2] {
                [self.0.$add(a, c), self.0.$add(b, d)]
            }

            #[inline(always)]
            fn $sub(self, [a, b]: [$register; 2], [c, d]: [$register; 2]) -> [$register; 2] {
                [self.0.$sub(a, c), self.0.$sub(b, d)]
            }

            #[inline(always)]
            fn $mul(self, [a, b]: [$register; 2], [c, d]: [$register; 2]) -> [$register; 2] {
                [self.0.$mul(a, c), self.0.$mul(b, d)]
            }

            #[inline(always)]
            fn $mul_add(
                self,
                [a, b]: [$register; 2],
                [c, d]: [$register; 2],
                [e, f]: [$register; 2],
            ) -> [$register; 2] {
                [self.0.$mul_add(a, c, e), self.0.$mul_add(b, d, f)]
            }

            #[inline(always)]
            fn $negate_mul_add(
                self,
                [a, b]: [$register; 2],
                [c, d]: [$register; 2],
                [e, f]: [$register; 2],
            ) -> [$register; 2] {
                [self.0.$negate_mul_add(a, c, e), self.0.$negate_mul_add(b, d, f)]
            }
        }

        lanes!(
            $lanes,
            |$self| $set,
            $number,
            $width,
            [$register; 2],
            $transpose,
            [$splat, $add, $sub, $mul, $mul_add, $negate_mul_add]
        );
    };
}

paired_lanes!(
    Neon,
    |self| Pairs(self),
    f64,
    4,
    f64x2,
    transpose_4,
    [splat_f64x2, add_f64x2, sub_f64x2, mul_f64x2, mul_add_f64x2, negate_mul_add_f64x2]
);
paired_lanes!(
    Single<Neon>,
    |self| Pairs(self.0),
    f32,
    8,
    f32x4,
    transpose_8_single,
    [splat_f32x4, add_f32x4, sub_f32x4, mul_f32x4, mul_add_f32x4, negate_mul_add_f32x4]
);

/// Two rows of two columns, transposed.
#[inline(always)]
fn two_rows(Pairs(set): Pairs, a: f64x2, b: f64x2) -> [f64x2; 2] {
    let [a, b] = [cast(a), cast(b)];
    [cast(set.neon.vtrn1q_f64(a, b)), cast(set.neon.vtrn2q_f64(a, b))]
}

#[inline(always)]
fn transpose_4(set: Pairs, block: &mut [[f64x2; 2]; 4]) {
    let [[a, e], [b, f], [c, g], [d, h]] = *block;
    let [ab0, ab1] = two_rows(set, a, b);
    let [cd0, cd1] = two_rows(set, c, d);
    let [ef2, ef3] = two_rows(set, e, f);
    let [gh2, gh3] = two_rows(set, g, h);
    *block = [[ab0, cd0], [ab1, cd1], [ef2, gh2], [ef3, gh3]];
}

/// Four rows of four columns, transposed.
#[inline(always)]
fn four_rows(set: Pairs, [a, b, c, d]: [f32x4; 4]) -> [f32x4; 4] {
    let neon = set.0.neon;
    let [a, b, c, d] = [cast(a), cast(b), cast(c), cast(d)];
    // Of the two rows columns 0 and 2, and 1 and 3.
    let [ab02, ab13] = [neon.vtrn1q_f32(a, b), neon.vtrn2q_f32(a, b)];
    let [cd02, cd13] = [neon.vtrn1q_f32(c, d), neon.vtrn2q_f32(c, d)];
    let [abcd0, abcd2] = two_rows(set, cast(ab02), cast(cd02));
    let [abcd1, abcd3] = two_rows(set, cast(ab13), cast(cd13));
    [cast(abcd0), cast(abcd1), cast(abcd2), cast(abcd3)]
}

#[inline(always)]
fn transpose_8_single(set: Pairs, block: &mut [[f32x4; 2]; 8]) {
    let [[a, i], [b, j], [c, k], [d, l], [e, m], [f, n], [g, o], [h, p]] = *block;
    let [abcd0, abcd1, abcd2, abcd3] = four_rows(set, [a, b, c, d]);
    let [efgh0, efgh1, efgh2, efgh3] = four_rows(set, [e, f, g, h]);
    let [ijkl4, ijkl5, ijkl6, ijkl7] = four_rows(set, [i, j, k, l]);
    let [mnop4, mnop5, mnop6, mnop7] = four_rows(set, [m, n, o, p]);
    *block = [
        [abcd0, efgh0],
        [abcd1, efgh1],
        [abcd2, efgh2],
        [abcd3, efgh3],
        [ijkl4, mnop4],
        [ijkl5, mnop5],
        [ijkl6, mnop6],
        [ijkl7, mnop7],
    ];
}
