//! Arithmetic on all cells of fields at once, with the vector instructions of the machine, in double or single precision.

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::portions::{PORTION, in_portions};
use super::registers::{Number, Reals};

/// Registers after which sums go on in double precision.
const STRIDE: usize = 64;

/// What happens in a cell: reads `READ` fields, changes `WRITE` fields, contributes to `SUMS` sums over all cells.
pub trait CellRule<const READ: usize, const WRITE: usize, const SUMS: usize> {
    /// So many of the fields that are read, the last ones, may be empty: then they count as zero in every cell.
    const OPTIONAL: usize = 0;

    /// The rule. A sum must not be touched by a number that is not finite, in any cell.
    fn at<R: Reals>(&self, read: [R; READ], write: &mut [R; WRITE]) -> [R; SUMS];
}

/// `to = factor * from`, in the precision of `to`.
pub fn convert<A: Number, B: Number>(from: &[A], factor: f64, to: &mut [B]) {
    in_portions((to.len(), 2), [to], &|cells, [to]| {
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for (to, from) in to.iter_mut().zip(&from[cells]) {
                    *to = B::of(*from, factor);
                }
            },
        );
    });
}

/// Applies a rule to every cell, on all threads of the current pool where there are many; returns its sums, taken in an order that is
/// fixed on a machine.
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
    R: CellRule<READ, WRITE, SUMS> + Sync,
{
    let len = read.first().map(|field| field.len()).or(write.first().map(|field| field.len())).unwrap_or(0);
    if len <= PORTION {
        return pass(rule, read, write);
    }
    let lacks = |field: usize| READ - R::OPTIONAL <= field && read[field].is_empty();
    let are_whole = (0..READ).all(|field| read[field].len() == len || lacks(field));
    assert!(are_whole && write.iter().all(|field| field.len() == len), "fields of one length");
    let sums = in_portions((len, READ + WRITE), write, &|cells, write| {
        pass(rule, read.map(|field| if field.is_empty() { field } else { &field[cells.clone()] }), write)
    });
    sums.iter().fold([0.0; SUMS], |total, part| std::array::from_fn(|sum| total[sum] + part[sum]))
}

/// Applies a rule to every cell, here.
fn pass<N, R, const READ: usize, const WRITE: usize, const SUMS: usize>(
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
pub fn largest_of<N: Number, R: CellSize<READ> + Sync, const READ: usize>(
    size: &R,
    read: [&[N]; READ],
) -> f64 {
    let len = read[0].len();
    assert!(read.iter().all(|field| field.len() == len), "fields of one length");
    let largest = in_portions((len, READ), [], &|cells, _: [&mut [N]; 0]| {
        Arch::new().dispatch(Largest { size, read: read.map(|field| &field[cells.clone()]) })
    });
    largest.into_iter().fold(0.0, f64::max)
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

    /// A sum over cells of many portions has the same bits on any number of threads, and is that of the cells to rounding; every cell is
    /// passed once.
    #[test]
    fn sums_do_not_depend_on_the_threads() {
        let len = 9 * PORTION + 1234;
        let a: Vec<f64> = (0..len).map(|cell| (cell as f64 * 0.7).sin() + 0.1).collect();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut to = vec![1.0; len];
                let [sum, none] = each_cell(&AddThrice, [&a, &[]], [&mut to]);
                assert!(none == 0.0 && to.iter().zip(&a).all(|(to, a)| *to == 1.0 + a));
                let mut single = vec![0.0_f32; len];
                convert(&a, 2.0, &mut single);
                assert!(single.iter().zip(&a).all(|(to, a)| *to == (2.0 * a) as f32));
                (sum, largest_of(&Own, [&a]))
            })
        };
        let (sum, largest) = on(1);
        let exact: f64 = a.iter().sum();
        assert!((sum - exact).abs() < 1e-10 * len as f64, "{sum} {exact}");
        assert_eq!(largest, a.iter().copied().fold(0.0, f64::max));
        for threads in [2, 3, 8] {
            assert_eq!(on(threads), (sum, largest), "{threads}");
        }
    }

    struct Own;

    impl CellSize<1> for Own {
        fn of<R: Reals>(&self, [a]: [R; 1]) -> R {
            a
        }
    }

    #[test]
    #[should_panic(expected = "fields of one length")]
    fn an_optional_field_of_another_length_is_refused() {
        each_cell(&AddThrice, [&[1.0; 9], &[1.0; 8]], [&mut [0.0; 9]]);
    }
}
