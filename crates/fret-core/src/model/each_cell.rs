//! Arithmetic on all cells of fields at once, with the vector instructions of the machine.

use std::ops::{Add, Div, Mul, Sub};

use pulp::{Arch, Scalar, Simd, WithSimd};

/// Numbers of several neighbouring cells, in one register.
#[derive(Debug, Clone, Copy)]
pub struct Reals<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

impl<S: Simd> Reals<S> {
    /// Square roots.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        Self { numbers: self.simd.sqrt_f64s(self.numbers), ..self }
    }

    /// The larger number of each cell.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { numbers: self.simd.max_f64s(self.numbers, other.numbers), ..self }
    }

    /// The smaller number of each cell.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self { numbers: self.simd.min_f64s(self.numbers, other.numbers), ..self }
    }

    /// `yes` in cells where this is at most `bound`, `no` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn if_at_most(self, bound: Self, yes: Self, no: Self) -> Self {
        let mask = self.simd.less_than_or_equal_f64s(self.numbers, bound.numbers);
        Self { numbers: self.simd.select_f64s(mask, yes.numbers, no.numbers), ..self }
    }

    /// The same number in every cell.
    #[inline(always)]
    #[must_use]
    pub fn all(self, number: f64) -> Self {
        Self { numbers: self.simd.splat_f64s(number), ..self }
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl<S: Simd> $operator for Reals<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { numbers: self.simd.$instruction(self.numbers, other.numbers), ..self }
            }
        }

        impl<S: Simd> $operator<f64> for Reals<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, number: f64) -> Self {
                Self { numbers: self.simd.$instruction(self.numbers, self.simd.splat_f64s(number)), ..self }
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

/// What happens in a cell: reads `READ` fields, changes `WRITE` fields, contributes to `SUMS` sums over all cells.
pub trait CellRule<const READ: usize, const WRITE: usize, const SUMS: usize> {
    /// The rule. A sum must not be touched by a number that is not finite, in any cell.
    fn at<S: Simd>(&self, read: [Reals<S>; READ], write: &mut [Reals<S>; WRITE]) -> [Reals<S>; SUMS];
}

/// Applies a rule to every cell; returns its sums, taken in an order that is fixed on a machine.
///
/// # Panics
/// When the fields differ in length.
pub fn each_cell<R, const READ: usize, const WRITE: usize, const SUMS: usize>(
    rule: &R,
    read: [&[f64]; READ],
    write: [&mut [f64]; WRITE],
) -> [f64; SUMS]
where
    R: CellRule<READ, WRITE, SUMS>,
{
    Arch::new().dispatch(Pass::<R, READ, WRITE, SUMS> { rule, read, write })
}

struct Pass<'a, R, const READ: usize, const WRITE: usize, const SUMS: usize> {
    rule: &'a R,
    read: [&'a [f64]; READ],
    write: [&'a mut [f64]; WRITE],
}

impl<R, const READ: usize, const WRITE: usize, const SUMS: usize> WithSimd for Pass<'_, R, READ, WRITE, SUMS>
where
    R: CellRule<READ, WRITE, SUMS>,
{
    type Output = [f64; SUMS];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; SUMS] {
        let Self { rule, read, write } = self;
        let len = read.first().map(|field| field.len()).or(write.first().map(|field| field.len()));
        let len = len.unwrap_or(0);
        let mut whole: [&[S::f64s]; READ] = [&[]; READ];
        let mut rest: [&[f64]; READ] = [&[]; READ];
        for field in 0..READ {
            assert_eq!(read[field].len(), len, "fields of one length");
            (whole[field], rest[field]) = S::as_simd_f64s(read[field]);
        }
        let written = write.map(|field| {
            assert_eq!(field.len(), len, "fields of one length");
            S::as_mut_simd_f64s(field)
        });
        let mut sums = [Reals { simd, numbers: simd.splat_f64s(0.0) }; SUMS];
        for index in 0..len / (size_of::<S::f64s>() / size_of::<f64>()) {
            let read: [_; READ] = std::array::from_fn(|field| Reals { simd, numbers: whole[field][index] });
            let mut changed: [_; WRITE] =
                std::array::from_fn(|field| Reals { simd, numbers: written[field].0[index] });
            let terms = rule.at(read, &mut changed);
            for field in 0..WRITE {
                written[field].0[index] = changed[field].numbers;
            }
            for sum in 0..SUMS {
                sums[sum] = sums[sum] + terms[sum];
            }
        }
        let mut totals = sums.map(|sum| simd.reduce_sum_f64s(sum.numbers));
        for index in 0..len % (size_of::<S::f64s>() / size_of::<f64>()) {
            let simd = Scalar;
            let read: [_; READ] = std::array::from_fn(|field| Reals { simd, numbers: rest[field][index] });
            let mut changed: [_; WRITE] =
                std::array::from_fn(|field| Reals { simd, numbers: written[field].1[index] });
            let terms = rule.at(read, &mut changed);
            for field in 0..WRITE {
                written[field].1[index] = changed[field].numbers;
            }
            for sum in 0..SUMS {
                totals[sum] += terms[sum].numbers;
            }
        }
        totals
    }
}
