//! Numbers of several cells in one vector register of the machine, in double or single precision.

use std::ops::{Add, Div, Mul, Sub};

use pulp::{Scalar, Simd};

/// Numbers of several neighbouring cells, in one register.
pub trait Reals:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Square roots.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The larger number of each cell.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller number of each cell.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// `yes` in cells where this is at most `bound`, `no` elsewhere.
    #[must_use]
    fn if_at_most(self, bound: Self, yes: Self, no: Self) -> Self;
    /// The same number in every cell.
    #[must_use]
    fn all(self, number: f64) -> Self;
}

/// A number of a field: of double or of single precision.
pub trait Number: Copy + Default + Send + Sync + 'static {
    /// Several of them, as they lie in memory.
    type Group<S: Simd>: Copy;
    /// Several of them, as rules see them.
    type Register<S: Simd>: Reals;

    /// Groups of a field, and what is left.
    fn groups<S: Simd>(field: &[Self]) -> (&[Self::Group<S>], &[Self]);
    /// Groups of a field, and what is left.
    fn groups_mut<S: Simd>(field: &mut [Self]) -> (&mut [Self::Group<S>], &mut [Self]);
    /// A register of zeros.
    fn zero<S: Simd>(simd: S) -> Self::Register<S>;
    /// A register of a group.
    fn load<S: Simd>(simd: S, group: Self::Group<S>) -> Self::Register<S>;
    /// The group of a register.
    fn store<S: Simd>(register: Self::Register<S>) -> Self::Group<S>;
    /// The sum of a register.
    fn sum<S: Simd>(register: Self::Register<S>) -> f64;
    /// The largest number of a register.
    fn largest<S: Simd>(register: Self::Register<S>) -> f64;
    /// A register of one number.
    fn load_one(self) -> Self::Register<Scalar>;
    /// The number of a register of one.
    fn store_one(register: Self::Register<Scalar>) -> Self;

    /// `factor * value`.
    fn of<A: Number>(value: A, factor: f64) -> Self;
    /// `factor` times this.
    fn to_single(self, factor: f64) -> f32;
    /// `factor` times this.
    fn to_double(self, factor: f64) -> f64;
}

macro_rules! numbers {
    ($number:ident, $to:ident, $register:ident, $group:ident, $groups:ident, $groups_mut:ident, $splat:ident, $sum:ident, $largest:ident;
     $($operator:ident $operate:ident $instruction:ident),*; $($unary:ident $root:ident),*; $($binary:ident $choose:ident),*;
     $at_most:ident, $select:ident) => {
        /// Numbers of one precision in a register.
        #[derive(Debug, Clone, Copy)]
        pub struct $register<S: Simd> {
            simd: S,
            numbers: S::$group,
        }

        $(impl<S: Simd> $operator for $register<S> {
            type Output = Self;
            #[inline(always)]
            fn $operate(self, other: Self) -> Self {
                Self { numbers: self.simd.$instruction(self.numbers, other.numbers), ..self }
            }
        }

        impl<S: Simd> $operator<f64> for $register<S> {
            type Output = Self;
            #[inline(always)]
            fn $operate(self, number: f64) -> Self {
                self.$operate(self.all(number))
            }
        })*

        impl<S: Simd> Reals for $register<S> {
            $(#[inline(always)]
            fn $unary(self) -> Self {
                Self { numbers: self.simd.$root(self.numbers), ..self }
            })*
            $(#[inline(always)]
            fn $binary(self, other: Self) -> Self {
                Self { numbers: self.simd.$choose(self.numbers, other.numbers), ..self }
            })*
            #[inline(always)]
            fn if_at_most(self, bound: Self, yes: Self, no: Self) -> Self {
                let mask = self.simd.$at_most(self.numbers, bound.numbers);
                Self { numbers: self.simd.$select(mask, yes.numbers, no.numbers), ..self }
            }
            #[inline(always)]
            fn all(self, number: f64) -> Self {
                Self { numbers: self.simd.$splat($number::of(number, 1.0)), ..self }
            }
        }

        impl Number for $number {
            type Group<S: Simd> = S::$group;
            type Register<S: Simd> = $register<S>;

            #[inline(always)]
            fn groups<S: Simd>(field: &[Self]) -> (&[S::$group], &[Self]) {
                S::$groups(field)
            }
            #[inline(always)]
            fn groups_mut<S: Simd>(field: &mut [Self]) -> (&mut [S::$group], &mut [Self]) {
                S::$groups_mut(field)
            }
            #[inline(always)]
            fn zero<S: Simd>(simd: S) -> $register<S> {
                $register { simd, numbers: simd.$splat(0.0) }
            }
            #[inline(always)]
            fn load<S: Simd>(simd: S, numbers: S::$group) -> $register<S> {
                $register { simd, numbers }
            }
            #[inline(always)]
            fn store<S: Simd>(register: $register<S>) -> S::$group {
                register.numbers
            }
            #[inline(always)]
            fn sum<S: Simd>($register { simd, numbers }: $register<S>) -> f64 {
                simd.$sum(numbers).into()
            }
            #[inline(always)]
            fn largest<S: Simd>($register { simd, numbers }: $register<S>) -> f64 {
                simd.$largest(numbers).into()
            }
            #[inline(always)]
            fn load_one(self) -> $register<Scalar> {
                $register { simd: Scalar, numbers: self }
            }
            #[inline(always)]
            fn store_one(register: $register<Scalar>) -> Self {
                register.numbers
            }

            #[inline(always)]
            fn of<A: Number>(value: A, factor: f64) -> Self {
                value.$to(factor)
            }
            #[inline(always)]
            fn to_single(self, factor: f64) -> f32 {
                (factor as Self * self) as f32
            }
            #[inline(always)]
            fn to_double(self, factor: f64) -> f64 {
                factor * f64::from(self)
            }
        }
    };
}

#[expect(clippy::cast_possible_truncation, reason = "this is what precisions are")]
mod precisions {
    use super::{Add, Div, Mul, Number, Reals, Scalar, Simd, Sub};

    numbers!(f64, to_double, Double, f64s, as_simd_f64s, as_mut_simd_f64s, splat_f64s, reduce_sum_f64s, reduce_max_f64s;
        Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s; sqrt sqrt_f64s;
        max max_f64s, min min_f64s; less_than_or_equal_f64s, select_f64s);
    numbers!(f32, to_single, Single, f32s, as_simd_f32s, as_mut_simd_f32s, splat_f32s, reduce_sum_f32s, reduce_max_f32s;
        Add add add_f32s, Sub sub sub_f32s, Mul mul mul_f32s, Div div div_f32s; sqrt sqrt_f32s;
        max max_f32s, min min_f32s; less_than_or_equal_f32s, select_f32s);
}
