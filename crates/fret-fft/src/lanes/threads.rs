//! Dividing independent work among the threads of the current pool.

use super::simd::Number;

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

/// Divides `data` into `pieces` runs of whole chunks of `chunk_len` (the last chunk may be shorter), and calls
/// `work(index of the first chunk, run, scratch)` for each, in parallel.
///
/// What is computed for a chunk must not depend on the run it is in; then nothing depends on the number of pieces.
pub fn divide<N, W>(data: &mut [N], chunk_len: usize, scratch: Scratch<'_, N>, pieces: usize, work: &W)
where
    N: Number,
    W: Fn(usize, &mut [N], &mut [N]) + Sync,
{
    divide_from(0, data, chunk_len, scratch, pieces, work);
}

fn divide_from<N, W>(
    first: usize,
    data: &mut [N],
    chunk_len: usize,
    scratch: Scratch<'_, N>,
    pieces: usize,
    work: &W,
) where
    N: Number,
    W: Fn(usize, &mut [N], &mut [N]) + Sync,
{
    let Scratch { numbers, piece_len } = scratch;
    if pieces <= 1 {
        work(first, data, &mut numbers[..piece_len]);
        return;
    }
    let left_pieces = pieces / 2;
    let left_chunks = data.len().div_ceil(chunk_len) * left_pieces / pieces;
    let (left, right) = data.split_at_mut((left_chunks * chunk_len).min(data.len()));
    let (numbers, right_numbers) = numbers.split_at_mut(left_pieces * piece_len);
    let right_scratch = Scratch { numbers: right_numbers, piece_len };
    let left_scratch = Scratch { numbers, piece_len };
    rayon::join(
        || divide_from(first, left, chunk_len, left_scratch, left_pieces, work),
        || divide_from(first + left_chunks, right, chunk_len, right_scratch, pieces - left_pieces, work),
    );
}
