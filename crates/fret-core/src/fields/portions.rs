//! Fields divided among the threads of the current pool: in portions whose borders do not depend on how many threads there are, so that
//! sums over cells, taken portion by portion, do not either.

/// Cells of a portion.
pub const PORTION: usize = 1 << 12;
/// Portions that pay for a second thread that is awake. Measured, a pass over three fields in single precision, one thread and two: 2.8 and 2.2
/// microseconds for 32,768 cells, 6.6 and 4.0 for 65,536, 58 and 31 for 524,288; with fewer than 20,000 a contact of 128 x 128 cells gets slower.
const FEWEST: usize = 5;

/// Pieces worth making of so many portions: one outside of a pool, and where they are few.
pub fn pieces(portions: usize) -> usize {
    if portions < FEWEST || rayon::current_thread_index().is_none() {
        1
    } else {
        rayon::current_num_threads().min(portions)
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
