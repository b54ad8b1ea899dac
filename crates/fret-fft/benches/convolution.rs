//! Time per application of the spectral products on every engine of this machine.
//!
//! Problems: `n` pressure to normal displacement (1 kernel), `t` both shear components (3 kernels, 4 blocks), `f` pressure and
//! shear with all couplings (6 kernels, 9 blocks), `p` and `q` the periodic products of problems `n` and `t`; each on the whole
//! grid, and on the half and the quarter in front of mirrors. The engines take turns, round after round, the fastest one also in
//! single precision; printed are the best time of each on one thread, its ratio to the plain line-by-line engine on rustfft
//! (best against best), the cost of planning, and the best time of the fastest engine on two threads.
//!
//! Arguments: the sizes to run, by default 64 128 256 512 1024.

#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use fretting_fft::{
    Block, Convolution, Engine, Kernel, Mirrors, Parity, PeriodicProduct, SingleProduct, Symbol, Workspace,
};
use ndarray::Array2;

/// Name, parities of the kernels, blocks as (output, input, kernel, sign).
type Problem = (&'static str, &'static [Parity], &'static [(usize, usize, usize, f64)]);

use Parity::{EvenEven, EvenOdd, OddEven, OddOdd};

const TANGENTIAL: [(usize, usize, usize, f64); 4] =
    [(0, 0, 0, 1.0), (1, 1, 1, 1.0), (0, 1, 2, 1.0), (1, 0, 2, 1.0)];

const PROBLEMS: [Problem; 5] = [
    ("n", &[EvenEven], &[(0, 0, 0, 1.0)]),
    ("t", &[EvenEven, EvenEven, OddOdd], &TANGENTIAL),
    (
        "f",
        &[EvenEven, EvenEven, EvenEven, OddOdd, OddEven, EvenOdd],
        &[
            (0, 0, 0, 1.0),
            (1, 1, 1, 1.0),
            (2, 2, 2, 1.0),
            (1, 2, 3, 1.0),
            (2, 1, 3, 1.0),
            (0, 1, 4, 1.0),
            (1, 0, 4, -1.0),
            (0, 2, 5, 1.0),
            (2, 0, 5, -1.0),
        ],
    ),
    ("p", &[EvenEven], &[(0, 0, 0, 1.0)]),
    ("q", &[EvenEven, EvenEven, OddOdd], &TANGENTIAL),
];

/// Share of the grid that is solved, and its mirrors for a problem of one, two or three fields.
fn mirrors(fields: usize) -> [(&'static str, Mirrors); 3] {
    let half: &[Parity] = [&[EvenEven][..], &[EvenEven, EvenOdd], &[EvenEven, EvenEven, EvenOdd]][fields - 1];
    let quarter: &[Parity] =
        [&[EvenEven][..], &[EvenEven, OddOdd], &[EvenEven, OddEven, EvenOdd]][fields - 1];
    [
        ("1", Mirrors::NONE),
        ("1/2", Mirrors { axes: [false, true], inputs: half.to_vec() }),
        ("1/4", Mirrors { axes: [true, true], inputs: quarter.to_vec() }),
    ]
}

enum Product {
    FreeSpace(Convolution),
    Periodic(PeriodicProduct),
}

impl Product {
    fn workspace(&self) -> Workspace {
        match self {
            Self::FreeSpace(product) => product.workspace(),
            Self::Periodic(product) => product.workspace(),
        }
    }

    fn in_single_precision(&self) -> Option<SingleProduct> {
        match self {
            Self::FreeSpace(product) => product.in_single_precision(),
            Self::Periodic(product) => product.in_single_precision(),
        }
    }

    fn apply(&self, workspace: &mut Workspace, input: &[&[f64]], output: &mut [&mut [f64]]) {
        match self {
            Self::FreeSpace(product) => product.apply(workspace, input, output),
            Self::Periodic(product) => product.apply(workspace, input, output),
        }
    }
}

/// Falls off like an influence coefficient.
fn kernel(n: usize, index: usize) -> Array2<f64> {
    Array2::from_shape_fn([n, n], |(i, j)| 1.0 / (1.0 + index as f64 + (i * i + 2 * j * j) as f64).sqrt())
}

fn best(best: Duration, run: impl FnOnce()) -> Duration {
    let start = Instant::now();
    run();
    best.min(start.elapsed())
}

fn measure(
    n: usize,
    (name, parities, blocks): Problem,
    (share, mirrors): (&str, Mirrors),
) -> Result<(), Box<dyn std::error::Error>> {
    let shape = [0, 1].map(|axis| if mirrors.axes[axis] { n / 2 } else { n });
    let cells = shape[0] * shape[1];
    let kernels: Vec<_> = (0..parities.len()).map(|index| kernel(n, index)).collect();
    let blocks: Vec<_> =
        blocks.iter().map(|&(output, input, kernel, sign)| Block { output, input, kernel, sign }).collect();
    let engines = Engine::available();
    let mut planning = Duration::MAX;
    let mut products = Vec::new();
    for &engine in &engines {
        let plan = || -> Result<_, Box<dyn std::error::Error>> {
            let quadrants = kernels.iter().zip(parities);
            Ok(if name == "p" || name == "q" {
                let symbols: Vec<_> =
                    quadrants.map(|(values, &parity)| Symbol { values: values.view(), parity }).collect();
                Product::Periodic(PeriodicProduct::on(engine, shape, &symbols, &blocks, mirrors.clone())?)
            } else {
                let kernels: Vec<_> =
                    quadrants.map(|(values, &parity)| Kernel { values: values.view(), parity }).collect();
                Product::FreeSpace(Convolution::on(engine, shape, &kernels, &blocks, mirrors.clone())?)
            })
        };
        let product = plan()?;
        if products.is_empty() {
            for _ in 0..3 {
                planning = best(planning, || drop(black_box(plan())));
            }
        }
        products.push((product.workspace(), product));
    }
    let fields = blocks.iter().map(|block| block.input + 1).max().unwrap_or(0);
    let input: Vec<Vec<f64>> = (0..fields)
        .map(|field| (0..cells).map(|cell| ((cell * 37 + field) % 101) as f64).collect())
        .collect();
    let input: Vec<_> = input.iter().map(Vec::as_slice).collect();
    let mut output = vec![vec![0.0; cells]; fields];
    let mut output: Vec<_> = output.iter_mut().map(Vec::as_mut_slice).collect();

    let coarse = vec![vec![1.0_f32; cells]; fields];
    let coarse: Vec<_> = coarse.iter().map(Vec::as_slice).collect();
    let mut rounded = vec![vec![0.0_f32; cells]; fields];
    let mut rounded: Vec<_> = rounded.iter_mut().map(Vec::as_mut_slice).collect();
    let single = products[0].1.in_single_precision().ok_or("no engine for single precision")?;
    let mut single_workspace = Workspace::default();
    let mut single_time = Duration::MAX;

    let rounds = (4_000_000 / (n * n)).clamp(5, 200);
    let mut times = vec![Duration::MAX; products.len()];
    for _ in 0..rounds {
        for ((workspace, product), time) in products.iter_mut().zip(&mut times) {
            product.apply(workspace, &input, &mut output);
            *time = best(*time, || product.apply(workspace, &input, &mut output));
        }
        single.apply(&mut single_workspace, &coarse, &mut rounded);
        single_time = best(single_time, || single.apply(&mut single_workspace, &coarse, &mut rounded));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    let two_threads = pool.install(|| {
        let (_, product) = &products[0];
        let mut workspace = product.workspace();
        let mut time = Duration::MAX;
        for _ in 0..rounds {
            time = best(time, || product.apply(&mut workspace, &input, &mut output));
        }
        time
    });

    let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
    let lines = times.last().copied().unwrap_or(Duration::MAX);
    print!("{name} {n:5} {share:>4}");
    for time in &times {
        print!("  {:8.3} ({:.3})", milliseconds(*time), milliseconds(*time) / milliseconds(lines));
    }
    print!(
        "   single {:8.3} ({:.3})",
        milliseconds(single_time),
        milliseconds(single_time) / milliseconds(lines)
    );
    println!("   plan {:8.3}   two threads {:8.3}", milliseconds(planning), milliseconds(two_threads));
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|argument| argument.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![64, 128, 256, 512, 1024] } else { sizes };
    println!("[ms], in brackets the ratio to the last engine: {:?}", Engine::available());
    for problem in PROBLEMS {
        for &n in &sizes {
            let fields = problem.2.iter().map(|block| block.1 + 1).max().unwrap_or(1);
            for mirrors in mirrors(fields) {
                measure(n, problem, mirrors)?;
            }
        }
    }
    Ok(())
}
