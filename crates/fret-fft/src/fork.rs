//! Two pieces of work at once, on threads that stay awake for a while.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::Yield;

/// How long a thread that has helped looks for more work before it falls asleep: longer than a solver mostly works alone between two pieces.
const AWAKE: Duration = Duration::from_micros(300);

thread_local! {
    /// How many calls of [`join`] this thread is inside of.
    static INSIDE: Cell<usize> = const { Cell::new(0) };
}

/// Does both, like [`rayon::join`]: the first here, the second on another thread of the current pool if one is free.
///
/// Rayon's threads fall asleep after some microseconds without work, and waking one takes longer than a pass over the cells of a small
/// grid. Here the thread that helped looks for more for a while before it sleeps, and the one that waits does not sleep at once either.
pub fn join<A, B, RA, RB>(first: A, second: B) -> (RA, RB)
where
    A: FnOnce() -> RA + Send,
    B: FnOnce() -> RB + Send,
    RA: Send,
    RB: Send,
{
    let is_done = AtomicBool::new(false);
    rayon::join_context(
        |_| {
            let _inside = Inside::enter();
            let result = first();
            look_for_work(|| is_done.load(Ordering::Acquire));
            result
        },
        |context| {
            let is_outermost = INSIDE.get() == 0;
            let inside = Inside::enter();
            let result = second();
            is_done.store(true, Ordering::Release);
            drop(inside);
            if context.migrated() && is_outermost {
                stay_awake();
            }
            result
        },
    )
}

/// Has this thread of the pool look for work for a while when what it does now has ended.
fn stay_awake() {
    let thread = rayon::current_thread_index();
    rayon::spawn(move || {
        // Whoever else takes this up has work of its own.
        if rayon::current_thread_index() == thread {
            let _inside = Inside::enter();
            look_for_work(|| false);
        }
    });
}

/// Does what work there is, until `is_enough` or until there has been none for a while.
fn look_for_work(is_enough: impl Fn() -> bool) {
    let mut idle_since = Instant::now();
    while !is_enough() && idle_since.elapsed() < AWAKE {
        match rayon::yield_now() {
            Some(Yield::Executed) => idle_since = Instant::now(),
            Some(Yield::Idle) => std::thread::yield_now(),
            None => return,
        }
    }
}

struct Inside;

impl Inside {
    fn enter() -> Self {
        INSIDE.set(INSIDE.get() + 1);
        Self
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        INSIDE.set(INSIDE.get() - 1);
    }
}

#[cfg(test)]
mod tests {
    use std::panic::AssertUnwindSafe;

    use super::*;

    /// Halves of halves, as passes over cells divide.
    fn sum(from: u64, to: u64) -> u64 {
        if to - from < 3 {
            return (from..to).sum();
        }
        let middle = from.midpoint(to);
        let (one, other) = join(|| sum(from, middle), || sum(middle, to));
        one + other
    }

    /// Whether all threads of a pool leave every call in the end: one that stays awake for a while may answer from inside its last one.
    fn all_are_outside(pool: &rayon::ThreadPool) -> bool {
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_secs(20) {
            if pool.broadcast(|_| INSIDE.get()).iter().all(|inside| *inside == 0) {
                return true;
            }
            std::thread::sleep(2 * AWAKE);
        }
        false
    }

    /// `n (n - 1) / 2`, again and again, on threads that are awake, that fall asleep between and that are more than the machine has.
    #[test]
    fn both_pieces_are_done_on_any_number_of_threads() -> Result<(), rayon::ThreadPoolBuildError> {
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            pool.install(|| {
                for round in 0..300 {
                    assert_eq!(sum(0, 200), 200 * 199 / 2);
                    if round % 100 == 0 {
                        std::thread::sleep(2 * AWAKE);
                    }
                }
            });
            assert!(all_are_outside(&pool));
        }
        Ok(())
    }

    /// Of many callers at once, each gets its own.
    #[test]
    fn callers_of_one_pool_do_not_disturb_each_other() -> Result<(), rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
        std::thread::scope(|scope| {
            for last in 50..54 {
                let pool = &pool;
                scope.spawn(move || {
                    for _ in 0..100 {
                        assert_eq!(pool.install(|| sum(0, last)), last * (last - 1) / 2);
                    }
                });
            }
        });
        Ok(())
    }

    /// A piece that panics does so for the caller, whichever it is; the pool goes on.
    #[test]
    fn a_panic_reaches_the_caller() -> Result<(), rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
        for first in [true, false] {
            let piece = |panics: bool| {
                assert!(!panics, "a piece that panics");
                1
            };
            let both = AssertUnwindSafe(|| pool.install(|| join(|| piece(first), || piece(!first))));
            let caught = std::panic::catch_unwind(both);
            assert!(caught.is_err());
            assert_eq!(pool.install(|| join(|| 1, || 2)), (1, 2));
            assert!(all_are_outside(&pool));
        }
        Ok(())
    }
}
