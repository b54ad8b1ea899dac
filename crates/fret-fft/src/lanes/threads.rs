//! Dividing independent work among the threads of the current pool.

use super::simd::Number;

/// Most fields that are worked on together.
pub const MAX_FIELDS: usize = 3;

/// Pieces worth making on a grid of `shape`, at most `most`: one, unless the caller already is inside a pool with more
/// threads and the grid is large enough to pay for waking them.
pub fn pieces(shape: [usize; 2], most: usize) -> usize {
    const SMALLEST: usize = 96;
    if shape[0] * shape[1] < SMALLEST * SMALLEST || rayon::current_thread_index().is_none() {
        return 1;
    }
    rayon::current_num_threads().clamp(1, most)
}

/// Scratch memory of all pieces, and how much of it one piece gets.
pub struct Scratch<'a, N> {
    pub numbers: &'a mut [N],
    pub piece_len: usize,
}

/// Divides whole chunks of `chunk_len` of several fields (the last chunk of one may be shorter) into `pieces`, and calls
/// `work(field, index of its first chunk, run, scratch)` for each run of chunks of a field, pieces in parallel: all fields at once, since
/// waking a thread takes as long as the rows of a small one.
///
/// What is computed for a chunk must not depend on the run it is in; then nothing depends on the number of pieces.
pub fn divide<N, W>(
    fields: [&mut [N]; MAX_FIELDS],
    chunk_len: usize,
    scratch: Scratch<'_, N>,
    pieces: usize,
    work: &W,
) where
    N: Number,
    W: Fn(usize, usize, &mut [N], &mut [N]) + Sync,
{
    divide_from(fields.map(|data| (0, data)), chunk_len, scratch, pieces, work);
}

/// Of each field a run, after the index of its first chunk.
fn divide_from<N, W>(
    fields: [(usize, &mut [N]); MAX_FIELDS],
    chunk_len: usize,
    scratch: Scratch<'_, N>,
    pieces: usize,
    work: &W,
) where
    N: Number,
    W: Fn(usize, usize, &mut [N], &mut [N]) + Sync,
{
    let Scratch { numbers, piece_len } = scratch;
    if pieces <= 1 {
        for (field, (first, data)) in fields.into_iter().enumerate().filter(|(_, (_, data))| !data.is_empty())
        {
            work(field, first, data, &mut numbers[..piece_len]);
        }
        return;
    }
    let left_pieces = pieces / 2;
    let chunks: usize = fields.iter().map(|(_, data)| data.len().div_ceil(chunk_len)).sum();
    let mut left_chunks = chunks * left_pieces / pieces;
    let mut right: [(usize, &mut [N]); MAX_FIELDS] = Default::default();
    let mut right_of = right.iter_mut();
    let left = fields.map(|(first, data)| {
        let taken = left_chunks.min(data.len().div_ceil(chunk_len));
        left_chunks -= taken;
        let (before, behind) = data.split_at_mut((taken * chunk_len).min(data.len()));
        if let Some(right) = right_of.next() {
            *right = (first + taken, behind);
        }
        (first, before)
    });
    let (numbers, right_numbers) = numbers.split_at_mut(left_pieces * piece_len);
    let right_scratch = Scratch { numbers: right_numbers, piece_len };
    let left_scratch = Scratch { numbers, piece_len };
    crate::join(
        || divide_from(left, chunk_len, left_scratch, left_pieces, work),
        || divide_from(right, chunk_len, right_scratch, pieces - left_pieces, work),
    );
}
