//! Fields divided among the threads of the current pool: in portions whose borders do not depend on how many threads there are, so that
//! sums over cells, taken portion by portion, do not either.

/// Cells of a portion.
pub const PORTION: usize = 1 << 11;
/// Numbers that a pass must read and write to pay for a second thread that is awake. Measured, a pass over three fields in single precision,
/// one thread and two: 2.8 and 2.2 microseconds for 32,768 cells, 6.6 and 4.0 for 65,536, 58 and 31 for 524,288; three fields of 16,384 cells,
/// which are the whole of a grid of 128 x 128, get slower.
const FEWEST_NUMBERS: usize = 52_000;

/// Pieces worth making of so many cells when a pass takes up so many numbers in each: one outside of a pool, and where they are few.
pub fn pieces(cells: usize, numbers: usize) -> usize {
    if cells * numbers < FEWEST_NUMBERS || rayon::current_thread_index().is_none() {
        1
    } else {
        rayon::current_num_threads().min(cells / PORTION).max(1)
    }
}

/// Splits each of several fields before a cell; fields that are empty stay so.
pub fn split<'a, N, const COUNT: usize>(fields: [&'a [N]; COUNT], at: usize) -> [[&'a [N]; COUNT]; 2] {
    let mut behind: [&'a [N]; COUNT] = [&[]; COUNT];
    let mut behind_of = behind.iter_mut();
    let before = fields.map(|field| {
        let (before, rest) = field.split_at(at.min(field.len()));
        if let Some(behind) = behind_of.next() {
            *behind = rest;
        }
        before
    });
    [before, behind]
}

/// Splits each of several fields before a cell, to be changed.
pub fn split_mut<N, const COUNT: usize>(fields: [&mut [N]; COUNT], at: usize) -> [[&mut [N]; COUNT]; 2] {
    let mut behind: [&mut [N]; COUNT] = std::array::from_fn(|_| Default::default());
    let mut behind_of = behind.iter_mut();
    let before = fields.map(|field| {
        let (before, rest) = field.split_at_mut(at.min(field.len()));
        if let Some(behind) = behind_of.next() {
            *behind = rest;
        }
        before
    });
    [before, behind]
}
