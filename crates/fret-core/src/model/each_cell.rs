//! Arithmetic on all cells of fields at once, with the vector instructions of the machine, in double or single precision.

use std::ops::{Add, Div, Mul, Sub};

use pulp::{Arch, Scalar, Simd, WithSimd};

/// Registers after which sums go on in double precision.
const STRIDE: usize = 64;

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
mod registers {
    use super::{Add, Div, Mul, Number, Reals, Scalar, Simd, Sub};

    numbers!(f64, to_double, Double, f64s, as_simd_f64s, as_mut_simd_f64s, splat_f64s, reduce_sum_f64s, reduce_max_f64s;
        Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s; sqrt sqrt_f64s;
        max max_f64s, min min_f64s; less_than_or_equal_f64s, select_f64s);
    numbers!(f32, to_single, Single, f32s, as_simd_f32s, as_mut_simd_f32s, splat_f32s, reduce_sum_f32s, reduce_max_f32s;
        Add add add_f32s, Sub sub sub_f32s, Mul mul mul_f32s, Div div div_f32s; sqrt sqrt_f32s;
        max max_f32s, min min_f32s; less_than_or_equal_f32s, select_f32s);
}

/// What happens in a cell: reads `READ` fields, changes `WRITE` fields, contributes to `SUMS` sums over all cells.
pub trait CellRule<const READ: usize, const WRITE: usize, const SUMS: usize> {
    /// So many of the fields that are read, the last ones, may be empty: then they count as zero in every cell.
    const OPTIONAL: usize = 0;

    /// The rule. A sum must not be touched by a number that is not finite, in any cell.
    fn at<R: Reals>(&self, read: [R; READ], write: &mut [R; WRITE]) -> [R; SUMS];
}

/// `to = factor * from`, in the precision of `to`.
pub fn convert<A: Number, B: Number>(from: &[A], factor: f64, to: &mut [B]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for (to, from) in to.iter_mut().zip(from) {
                *to = B::of(*from, factor);
            }
        },
    );
}

/// Applies a rule to every cell; returns its sums, taken in an order that is fixed on a machine.
///
/// # Panics
/// When the fields differ in length, but for [optional](CellRule::OPTIONAL) ones that are all empty.
pub fn each_cell<N, R, const READ: usize, const WRITE: usize, const SUMS: usize>(
    rule: &R,
    read: [&[N]; READ],
    write: [&mut [N]; WRITE],
) -> [f64; SUMS]
where
    N: Number,
    R: CellRule<READ, WRITE, SUMS>,
{
    if R::OPTIONAL > 0 && read[READ - R::OPTIONAL..].iter().all(|field| field.is_empty()) {
        Arch::new().dispatch(Pass::<N, R, READ, WRITE, SUMS, true> { rule, read, write })
    } else {
        Arch::new().dispatch(Pass::<N, R, READ, WRITE, SUMS, false> { rule, read, write })
    }
}

/// Fields as groups of numbers, and what is left of each.
type Grouped<'a, N, S, const READ: usize> = ([&'a [<N as Number>::Group<S>]; READ], [&'a [N]; READ]);

/// Groups of the first `given` fields, of `len` numbers, `count` of each, and what is left.
#[inline(always)]
fn grouped<N: Number, S: Simd, const READ: usize>(
    read: [&[N]; READ],
    given: usize,
    len: usize,
    count: usize,
) -> Grouped<'_, N, S, READ> {
    let (mut groups, mut rest) = ([&[] as &[N::Group<S>]; READ], [&[] as &[N]; READ]);
    for (field, values) in read.into_iter().take(given).enumerate() {
        assert_eq!(values.len(), len, "fields of one length");
        let (whole, left) = N::groups::<S>(values);
        (groups[field], rest[field]) = (&whole[..count], left);
    }
    (groups, rest)
}

/// A rule over fields; with `LACKS` the optional ones are empty.
struct Pass<'a, N, R, const READ: usize, const WRITE: usize, const SUMS: usize, const LACKS: bool> {
    rule: &'a R,
    read: [&'a [N]; READ],
    write: [&'a mut [N]; WRITE],
}

impl<N, R, const READ: usize, const WRITE: usize, const SUMS: usize, const LACKS: bool> WithSimd
    for Pass<'_, N, R, READ, WRITE, SUMS, LACKS>
where
    N: Number,
    R: CellRule<READ, WRITE, SUMS>,
{
    type Output = [f64; SUMS];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; SUMS] {
        let Self { rule, read, write } = self;
        let len = read.first().map(|field| field.len()).or(write.first().map(|field| field.len()));
        let len = len.unwrap_or(0);
        let width = size_of::<N::Group<S>>() / size_of::<N>();
        let count = len / width;
        let given = if LACKS { READ - R::OPTIONAL } else { READ };
        let (groups, rest) = grouped::<N, S, READ>(read, given, len, count);
        let written = write.map(|field| {
            assert_eq!(field.len(), len, "fields of one length");
            let (whole, left) = N::groups_mut::<S>(field);
            (&mut whole[..count], left)
        });
        let mut totals = [0.0; SUMS];
        let mut first = 0;
        while first < count {
            let end = count.min(first + STRIDE);
            let mut sums: Option<[N::Register<S>; SUMS]> = None;
            for index in first..end {
                let read: [_; READ] = std::array::from_fn(|field| {
                    if field < given { N::load(simd, groups[field][index]) } else { N::zero(simd) }
                });
                let mut changed: [_; WRITE] =
                    std::array::from_fn(|field| N::load(simd, written[field].0[index]));
                let terms = rule.at(read, &mut changed);
                for field in 0..WRITE {
                    written[field].0[index] = N::store(changed[field]);
                }
                sums = Some(match sums {
                    Some(sums) => std::array::from_fn(|sum| sums[sum] + terms[sum]),
                    None => terms,
                });
            }
            if let Some(sums) = sums {
                for (total, sum) in totals.iter_mut().zip(sums) {
                    *total += N::sum(sum);
                }
            }
            first = end;
        }
        for index in 0..len % width {
            let read: [_; READ] = std::array::from_fn(|field| {
                if field < given { rest[field][index].load_one() } else { N::zero(Scalar) }
            });
            let mut changed: [_; WRITE] = std::array::from_fn(|field| written[field].1[index].load_one());
            let terms = rule.at(read, &mut changed);
            for field in 0..WRITE {
                written[field].1[index] = N::store_one(changed[field]);
            }
            for (total, term) in totals.iter_mut().zip(terms) {
                *total += N::store_one(term).to_double(1.0);
            }
        }
        totals
    }
}

/// A size of what is in a cell, not negative: of `READ` fields.
pub trait CellSize<const READ: usize> {
    /// The size. It must be a number in every cell.
    fn of<R: Reals>(&self, read: [R; READ]) -> R;
}

/// The largest size of any cell, 0 where there is none.
///
/// # Panics
/// When the fields differ in length.
pub fn largest_of<N: Number, R: CellSize<READ>, const READ: usize>(size: &R, read: [&[N]; READ]) -> f64 {
    Arch::new().dispatch(Largest { size, read })
}

struct Largest<'a, N, R, const READ: usize> {
    size: &'a R,
    read: [&'a [N]; READ],
}

impl<N: Number, R: CellSize<READ>, const READ: usize> WithSimd for Largest<'_, N, R, READ> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { size, read } = self;
        let len = read[0].len();
        let width = size_of::<N::Group<S>>() / size_of::<N>();
        let count = len / width;
        let (groups, rest) = grouped::<N, S, READ>(read, READ, len, count);
        let mut most: Option<N::Register<S>> = None;
        for index in 0..count {
            let here = size.of(std::array::from_fn(|field| N::load(simd, groups[field][index])));
            most = Some(most.map_or(here, |most| most.max(here)));
        }
        let most = most.map_or(0.0, N::largest);
        (0..len % width).fold(most, |most, index| {
            let here = size.of(std::array::from_fn(|field| rest[field][index].load_one()));
            most.max(N::store_one(here).to_double(1.0))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds `a` and three times an optional field; sums both.
    struct AddThrice;

    impl CellRule<2, 1, 2> for AddThrice {
        const OPTIONAL: usize = 1;

        fn at<R: Reals>(&self, [a, optional]: [R; 2], [to]: &mut [R; 1]) -> [R; 2] {
            *to = *to + a + optional * 3.0;
            [a, optional]
        }
    }

    fn empty_is_zero<N: Number + PartialEq + std::fmt::Debug>(len: usize) {
        let a: Vec<N> = (0..len).map(|cell| N::of(cell as f64, 0.5)).collect();
        let (zeros, ones) = (vec![N::of(0.0, 1.0); len], vec![N::of(1.0, 1.0); len]);
        let [mut with_none, mut with_zeros, mut with_ones] = [zeros.clone(), zeros.clone(), zeros.clone()];
        let none = each_cell(&AddThrice, [&a, &[]], [&mut with_none]);
        assert_eq!(none, each_cell(&AddThrice, [&a, &zeros], [&mut with_zeros]));
        assert_eq!(with_none, with_zeros);
        assert_eq!(with_none, a);
        // Halves of whole numbers: their sum is exact.
        let sum = len as f64 * (len as f64 - 1.0) / 4.0;
        assert_eq!(none, [if len > 0 { sum } else { 0.0 }, 0.0]);
        assert_eq!(each_cell(&AddThrice, [&a, &ones], [&mut with_ones]), [none[0], len as f64]);
        assert!(with_ones.iter().zip(&a).all(|(with, a)| with.to_double(1.0) == a.to_double(1.0) + 3.0));
    }

    #[test]
    fn an_optional_field_that_is_empty_is_zero_everywhere() {
        for len in [0, 1, 7, 16, 515, 1024 + 9] {
            empty_is_zero::<f64>(len);
            empty_is_zero::<f32>(len);
        }
    }

    #[test]
    #[should_panic(expected = "fields of one length")]
    fn an_optional_field_of_another_length_is_refused() {
        each_cell(&AddThrice, [&[1.0; 9], &[1.0; 8]], [&mut [0.0; 9]]);
    }
}
