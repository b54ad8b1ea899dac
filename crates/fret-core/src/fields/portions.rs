//! Fields divided among the threads of the current pool: in portions whose borders do not depend on how many threads there are, so that
//! sums over cells, taken portion by portion, do not either.

use std::ops::Range;

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

/// Does `work` on so many cells portion by portion, on all threads of the current pool where it pays for so many `numbers` read and written in
/// each cell. `work` gets the cells of a portion, and of several fields the part with these cells, to be changed. Its results are in the order
/// of the cells.
pub fn in_portions<N: Send, T: Send, const COUNT: usize>(
    (cells, numbers): (usize, usize),
    fields: [&mut [N]; COUNT],
    work: &(impl Fn(Range<usize>, [&mut [N]; COUNT]) -> T + Sync),
) -> Vec<T> {
    in_pieces(pieces(cells, numbers), 0..cells, fields, work)
}

fn in_pieces<N: Send, T: Send, const COUNT: usize>(
    pieces: usize,
    mut cells: Range<usize>,
    mut fields: [&mut [N]; COUNT],
    work: &(impl Fn(Range<usize>, [&mut [N]; COUNT]) -> T + Sync),
) -> Vec<T> {
    let portions = cells.len().div_ceil(PORTION);
    if pieces > 1 {
        let before = portions * (pieces / 2) / pieces * PORTION;
        let middle = cells.start + before;
        let [fields, fields_behind] = split(fields, before);
        let (mut found, found_behind) = fret_fft::join(
            || in_pieces(pieces / 2, cells.start..middle, fields, work),
            || in_pieces(pieces - pieces / 2, middle..cells.end, fields_behind, work),
        );
        found.extend(found_behind);
        return found;
    }
    let mut found = Vec::with_capacity(portions);
    for _ in 0..portions {
        let end = cells.end.min(cells.start + PORTION);
        let [here, behind] = split(fields, PORTION);
        found.push(work(cells.start..end, here));
        (cells.start, fields) = (end, behind);
    }
    found
}

/// Splits each of several fields before a cell; fields that are empty stay so.
fn split<N, const COUNT: usize>(fields: [&mut [N]; COUNT], at: usize) -> [[&mut [N]; COUNT]; 2] {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// On any number of threads every cell is passed once, with what a field holds of it, and portions come in their order.
    #[test]
    fn portions_do_not_depend_on_the_threads() {
        let cells = 40 * PORTION + 5;
        let expected: Vec<Range<usize>> =
            (0..41).map(|portion| portion * PORTION..cells.min((portion + 1) * PORTION)).collect();
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let (mut passed, mut empty) = (vec![0; cells], Vec::new());
            let fields = [&mut passed[..], &mut empty];
            let portions = pool.install(|| {
                in_portions((cells, 2), fields, &|cells, [passed, empty]| {
                    assert!(empty.is_empty() && passed.len() == cells.len());
                    passed.iter_mut().zip(cells.clone()).for_each(|(passed, cell)| *passed += 1 + cell);
                    cells
                })
            });
            assert_eq!(portions, expected);
            assert!(passed.iter().enumerate().all(|(cell, passed)| *passed == 1 + cell));
        }
    }
}
