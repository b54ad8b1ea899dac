//! The few vector operations the transforms are written in, for each instruction set and for both precisions.
//!
//! Everything built on [`Lanes`] must be `#[inline(always)]` down to here and be entered through [`Lanes::enter`]:
//! code that is not inlined into it is compiled without the instruction set, and several times slower. Each pass over
//! lines is a [`Task`] of its own, so that it is compiled once, however many stages use it.

use std::ops::IndexMut;

use pulp::bytemuck::Pod;

/// Most lanes of any instruction set.
pub const MAX_WIDTH: usize = 16;

/// Work to be compiled for the instruction set `L`.
pub trait Task<L: Lanes> {
    /// Does the work; to be marked `#[inline(always)]`.
    fn run(self, lanes: L);
}

/// A real number of double or single precision, and the lanes of each instruction set for it.
pub trait Number: Pod + Default + PartialEq + Send + Sync {
    /// Plain arrays.
    type Portable: Lanes<Number = Self> + Default;
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Number = Self> + From<pulp::x86::V3>;
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Number = Self> + From<pulp::x86::V4>;
    /// NEON.
    #[cfg(target_arch = "aarch64")]
    type Neon: Lanes<Number = Self> + From<pulp::aarch64::Neon>;

    /// Rounded to this precision.
    fn of(value: f64) -> Self;
}

/// An instruction set that is known to be present, working on [`WIDTH`](Self::WIDTH) numbers at a time.
pub trait Lanes: Copy + Send + Sync + 'static {
    /// Number of lanes, a multiple of 4.
    const WIDTH: usize;
    /// What is in a lane.
    type Number: Number;
    /// One vector of numbers.
    type Reals: Pod + Send + Sync;
    /// As many vectors as there are lanes.
    type Block: Copy + IndexMut<usize, Output = Self::Reals>;

    /// Runs a task compiled for this instruction set.
    fn enter<T: Task<Self>>(self, task: T);
    /// The same number in all lanes.
    fn splat(self, value: Self::Number) -> Self::Reals;
    /// The same vector as often as there are lanes.
    fn block(self, value: Self::Reals) -> Self::Block;
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
    /// Exchanges rows and columns.
    fn transpose(self, block: &mut Self::Block);

    /// The same number in all lanes, rounded to their precision.
    #[inline(always)]
    fn constant(self, value: f64) -> Self::Reals {
        self.splat(Self::Number::of(value))
    }

    /// Zero in all lanes.
    #[inline(always)]
    fn zero(self) -> Self::Reals {
        self.constant(0.0)
    }
}

/// An instruction set on numbers of single precision.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
#[derive(Debug, Clone, Copy)]
pub struct Single<A>(pub A);

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
impl<A> From<A> for Single<A> {
    fn from(set: A) -> Self {
        Self(set)
    }
}

/// Plain arrays, for every machine.
#[derive(Debug, Clone, Copy, Default)]
pub struct Portable;

/// Plain arrays of single precision, for every machine.
#[derive(Debug, Clone, Copy, Default)]
pub struct PortableSingle;

const PORTABLE_WIDTH: usize = 4;

macro_rules! plain_arrays {
    ($lanes:ty, $number:ty) => {
        impl Lanes for $lanes {
            const WIDTH: usize = PORTABLE_WIDTH;
            type Number = $number;
            type Reals = [$number; PORTABLE_WIDTH];
            type Block = [Self::Reals; PORTABLE_WIDTH];

            #[inline(never)]
            fn enter<T: Task<Self>>(self, task: T) {
                task.run(self);
            }

            #[inline(always)]
            fn splat(self, value: $number) -> Self::Reals {
                [value; PORTABLE_WIDTH]
            }

            #[inline(always)]
            fn block(self, value: Self::Reals) -> Self::Block {
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
            fn transpose(self, block: &mut Self::Block) {
                for row in 0..PORTABLE_WIDTH {
                    for column in row + 1..PORTABLE_WIDTH {
                        let above = block[row][column];
                        block[row][column] = block[column][row];
                        block[column][row] = above;
                    }
                }
            }
        }
    };
}

plain_arrays!(Portable, f64);
plain_arrays!(PortableSingle, f32);

impl Number for f64 {
    type Portable = Portable;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = pulp::x86::V3;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = pulp::x86::V4;
    #[cfg(target_arch = "aarch64")]
    type Neon = pulp::aarch64::Neon;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
}

impl Number for f32 {
    type Portable = PortableSingle;
    #[cfg(target_arch = "x86_64")]
    type Avx2 = Single<pulp::x86::V3>;
    #[cfg(target_arch = "x86_64")]
    type Avx512 = Single<pulp::x86::V4>;
    #[cfg(target_arch = "aarch64")]
    type Neon = Single<pulp::aarch64::Neon>;

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "this is what single precision is")]
    fn of(value: f64) -> Self {
        value as Self
    }
}
