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

/// What can be divided into chunks.
pub trait Divisible: Sized {
    /// Chunks, of which the last may be shorter.
    fn chunks(&self) -> usize;
    /// The first so many chunks, or all, and the others.
    fn divided_after(self, chunks: usize) -> (Self, Self);
}

/// Numbers in chunks of a length.
struct Chunked<'a, N> {
    numbers: &'a mut [N],
    chunk_len: usize,
}

impl<N> Divisible for Chunked<'_, N> {
    fn chunks(&self) -> usize {
        self.numbers.len().div_ceil(self.chunk_len)
    }

    fn divided_after(self, chunks: usize) -> (Self, Self) {
        let Self { numbers, chunk_len } = self;
        let (first, others) = numbers.split_at_mut((chunks * chunk_len).min(numbers.len()));
        (Self { numbers: first, chunk_len }, Self { numbers: others, chunk_len })
    }
}

/// Divides whole chunks of `chunk_len` of several fields (the last chunk of one may be shorter) into `pieces`, as
/// [`divide_runs`] does.
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
    let runs = fields.map(|numbers| Chunked { numbers, chunk_len });
    divide_runs(runs, scratch, pieces, &|field, first, run: Chunked<'_, N>, scratch: &mut [N]| {
        work(field, first, run.numbers, scratch);
    });
}

/// Divides the chunks of several fields into `pieces`, and calls `work(field, index of its first chunk, run, scratch)` for each run of
/// chunks of a field, pieces in parallel: all fields at once, since waking a thread takes as long as the rows of a small one.
///
/// What is computed for a chunk must not depend on the run it is in; then nothing depends on the number of pieces.
pub fn divide_runs<N, R, W>(fields: [R; MAX_FIELDS], scratch: Scratch<'_, N>, pieces: usize, work: &W)
where
    N: Number,
    R: Divisible + Send,
    W: Fn(usize, usize, R, &mut [N]) + Sync,
{
    divide_from(fields.map(|run| (0, run)), scratch, pieces, work);
}

/// Of each field a run, after the index of its first chunk.
fn divide_from<N, R, W>(fields: [(usize, R); MAX_FIELDS], scratch: Scratch<'_, N>, pieces: usize, work: &W)
where
    N: Number,
    R: Divisible + Send,
    W: Fn(usize, usize, R, &mut [N]) + Sync,
{
    let Scratch { numbers, piece_len } = scratch;
    if pieces <= 1 {
        for (field, (first, run)) in fields.into_iter().enumerate().filter(|(_, (_, run))| run.chunks() > 0) {
            work(field, first, run, &mut numbers[..piece_len]);
        }
        return;
    }
    let left_pieces = pieces / 2;
    let chunks: usize = fields.iter().map(|(_, run)| run.chunks()).sum();
    let mut left_chunks = chunks * left_pieces / pieces;
    let [a, b, c] = fields.map(|(first, run)| {
        let taken = left_chunks.min(run.chunks());
        left_chunks -= taken;
        let (before, behind) = run.divided_after(taken);
        [(first, before), (first + taken, behind)]
    });
    let ([a, a_right], [b, b_right], [c, c_right]) = (a, b, c);
    let (numbers, right_numbers) = numbers.split_at_mut(left_pieces * piece_len);
    let right_scratch = Scratch { numbers: right_numbers, piece_len };
    let left_scratch = Scratch { numbers, piece_len };
    crate::join(
        || divide_from([a, b, c], left_scratch, left_pieces, work),
        || divide_from([a_right, b_right, c_right], right_scratch, pieces - left_pieces, work),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_grids_are_divided_among_the_threads_of_the_pool() -> Result<(), rayon::ThreadPoolBuildError> {
        let large = [200, 200];
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            assert_eq!(pool.install(|| pieces(large, 8)), threads);
            assert_eq!(pool.install(|| pieces(large, 2)), threads.min(2));
            assert_eq!(pool.install(|| pieces([60, 60], 8)), 1);
            assert_eq!(pool.install(|| pieces([20, 2000], 8)), threads);
        }
        assert_eq!(pieces(large, 8), 1, "outside of a pool");
        Ok(())
    }

    /// Chunks are of 5 numbers, the last ones of some fields shorter; each piece notes in its scratch what it did.
    #[test]
    fn every_chunk_is_worked_on_once_and_the_pieces_are_alike() {
        const CHUNK: usize = 5;
        const PIECE: usize = 3;
        for lens in [[35, 0, 0], [33, 33, 33], [5, 50, 1], [4, 0, 0], [100, 52, 17]] {
            for pieces in 1..=9 {
                let mut fields = lens.map(|len| vec![0.0_f64; len]);
                let mut numbers = vec![0.0; 9 * PIECE];
                let [a, b, c] = &mut fields;
                let scratch = Scratch { numbers: &mut numbers, piece_len: PIECE };
                divide(
                    [a.as_mut_slice(), b, c],
                    CHUNK,
                    scratch,
                    pieces,
                    &|field, first, run: &mut [f64], scratch: &mut [f64]| {
                        assert_eq!(scratch.len(), PIECE);
                        for (index, chunk) in (first..).zip(run.chunks_mut(CHUNK)) {
                            for number in chunk {
                                *number += (100 * field + index) as f64 + 0.5;
                            }
                            scratch[0] += 1.0;
                        }
                    },
                );
                for (field, found) in fields.iter().enumerate() {
                    for (place, number) in found.iter().enumerate() {
                        assert_eq!(*number, (100 * field + place / CHUNK) as f64 + 0.5);
                    }
                }
                let chunks: usize = lens.iter().map(|len| len.div_ceil(CHUNK)).sum();
                let done: Vec<f64> = numbers.chunks(PIECE).map(|scratch| scratch[0]).collect();
                assert_eq!(done.iter().sum::<f64>(), chunks as f64);
                let most = done.iter().copied().fold(0.0, f64::max);
                assert!(most <= chunks.div_ceil(pieces) as f64, "{lens:?} {pieces}: {done:?}");
                assert!(done[pieces..].iter().all(|count| *count == 0.0), "more pieces than told");
            }
        }
    }
}
