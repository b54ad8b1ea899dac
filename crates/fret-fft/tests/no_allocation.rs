//! A product asks for no memory: a solver applies it hundreds of thousands of times.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use fretting_fft::{Block, Convolution, Engine, Kernel, Mirrors, Parity, PeriodicProduct, Symbol};
use ndarray::Array2;

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

/// Bytes from which on an allocation is counted.
static COUNTED_FROM: AtomicUsize = AtomicUsize::new(0);

#[expect(unsafe_code, reason = "an allocator cannot be written without; this one forwards to the system's")]
// SAFETY: every call is forwarded unchanged to the system allocator, which keeps the contract.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.size() >= COUNTED_FROM.load(Ordering::Relaxed) {
            ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        }
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Fewest allocations of ten equal calls: a thread may set itself up in any of them, but a product that needs memory asks
/// for it in all.
fn allocations(mut call: impl FnMut()) -> usize {
    (0..10)
        .map(|_| {
            let before = ALLOCATIONS.load(Ordering::Relaxed);
            call();
            ALLOCATIONS.load(Ordering::Relaxed) - before
        })
        .min()
        .unwrap_or(usize::MAX)
}

// One test only: another one at the same time would be counted too.
#[test]
fn applying_a_product_allocates_nothing() -> Result<(), Box<dyn std::error::Error>> {
    let shape = [128, 120];
    let values = Array2::from_shape_fn(shape, |(i, j)| 1.0 / (1.0 + (i * i + j * j) as f64));
    let block = Block { output: 0, input: 0, kernel: 0, sign: 1.0 };
    let input = vec![1.0; 128 * 120];
    let mut output = vec![0.0; 128 * 120];
    // A thread that has helped is kept awake by a job of three words. Where a product takes so long that it falls asleep all the same,
    // as under emulation, each call may ask for one; what the product itself needs is counted on one thread in any size.
    let beyond_a_job = 3 * size_of::<usize>() + 1;
    for (threads, counted_from) in [(1, 0), (2, beyond_a_job)] {
        COUNTED_FROM.store(counted_from, Ordering::Relaxed);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        for engine in Engine::available() {
            let parity = Parity::EvenEven;
            let kernel = Kernel { values: values.view(), parity };
            let symbol = Symbol { values: values.view(), parity };
            let free_space = Convolution::on(engine, shape, &[kernel], &[block], Mirrors::NONE)?;
            let periodic = PeriodicProduct::on(engine, shape, &[symbol], &[block], Mirrors::NONE)?;
            let counts = pool.install(|| {
                let (mut in_free_space, mut in_periodic) = (free_space.workspace(), periodic.workspace());
                [
                    allocations(|| free_space.apply(&mut in_free_space, &[&input], &mut [&mut output])),
                    allocations(|| periodic.apply(&mut in_periodic, &[&input], &mut [&mut output])),
                ]
            });
            assert_eq!(counts, [0, 0], "{engine:?}, {threads} threads");
        }
    }
    Ok(())
}
