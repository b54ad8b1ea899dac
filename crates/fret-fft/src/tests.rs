//! The products against plain sums.

mod refusals;

use ndarray::Array2;

use super::{Block, Convolution, Engine, Kernel, Mirrors, Parity, PeriodicProduct, Symbol};
use crate::random::Random;

pub(super) const PARITIES: [Parity; 4] = [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd, Parity::OddOdd];

impl Random {
    /// Between -1 and 1.
    fn next(&mut self) -> f64 {
        self.between(-1.0, 1.0)
    }

    fn field(&mut self, len: usize) -> Vec<f64> {
        (0..len).map(|_| self.next()).collect()
    }

    fn array(&mut self, shape: [usize; 2]) -> Array2<f64> {
        Array2::from_shape_fn(shape, |_| self.next())
    }
}

/// Fields, kernels and blocks of one problem.
struct Problem {
    shape: [usize; 2],
    kernels: Vec<(Array2<f64>, Parity)>,
    blocks: Vec<Block>,
    input: Vec<Vec<f64>>,
}

pub(super) fn block(output: usize, input: usize, kernel: usize, sign: f64) -> Block {
    Block { output, input, kernel, sign }
}

/// Pressure and shear with all couplings: six kernels, nine blocks.
pub(super) fn full_blocks() -> (Vec<Parity>, Vec<Block>) {
    let parities = vec![
        Parity::EvenEven,
        Parity::EvenEven,
        Parity::EvenEven,
        Parity::OddOdd,
        Parity::OddEven,
        Parity::EvenOdd,
    ];
    let blocks = vec![
        block(0, 0, 0, 1.0),
        block(1, 1, 1, 1.0),
        block(2, 2, 2, 1.0),
        block(1, 2, 3, 1.0),
        block(2, 1, 3, 1.0),
        block(0, 1, 4, 1.0),
        block(1, 0, 4, -1.0),
        block(0, 2, 5, 1.0),
        block(2, 0, 5, -1.0),
    ];
    (parities, blocks)
}

impl Problem {
    fn new(
        shape: [usize; 2],
        quadrant: [usize; 2],
        parities: &[Parity],
        blocks: &[Block],
        seed: u64,
    ) -> Self {
        let mut numbers = Random::seeded(seed);
        let kernels = parities.iter().map(|&parity| (numbers.array(quadrant), parity)).collect();
        let inputs = 1 + blocks.iter().map(|block| block.input).max().unwrap();
        let input = (0..inputs).map(|_| numbers.field(shape[0] * shape[1])).collect();
        Self { shape, kernels, blocks: blocks.to_vec(), input }
    }

    fn outputs(&self) -> usize {
        1 + self.blocks.iter().map(|block| block.output).max().unwrap()
    }

    fn kernels(&self) -> Vec<Kernel<'_>> {
        self.kernels
            .iter()
            .map(|(values, parity)| Kernel { values: values.view(), parity: *parity })
            .collect()
    }

    fn symbols(&self) -> Vec<Symbol<'_>> {
        self.kernels
            .iter()
            .map(|(values, parity)| Symbol { values: values.view(), parity: *parity })
            .collect()
    }

    /// Kernel at an offset of either sign.
    fn kernel_at(&self, kernel: usize, offset: [isize; 2]) -> f64 {
        let (values, parity) = &self.kernels[kernel];
        let signs = [0, 1].map(|axis| if parity.odd()[axis] { offset[axis].signum() as f64 } else { 1.0 });
        signs[0] * signs[1] * values[offset.map(isize::unsigned_abs)]
    }

    /// One value of the free-space product, summed term by term.
    fn free_space_at(&self, output: usize, cell: [usize; 2]) -> f64 {
        let [nx, ny] = self.shape;
        let mut sum = 0.0;
        for block in self.blocks.iter().filter(|block| block.output == output) {
            for m in 0..nx {
                for n in 0..ny {
                    let offset = [cell[0] as isize - m as isize, cell[1] as isize - n as isize];
                    sum += block.sign
                        * self.kernel_at(block.kernel, offset)
                        * self.input[block.input][m * ny + n];
                }
            }
        }
        sum
    }

    /// One value of the periodic product with the kernels repeated, summed term by term.
    fn periodic_at(&self, output: usize, cell: [usize; 2]) -> f64 {
        let [nx, ny] = self.shape;
        let nearest = |offset: isize, n: usize, odd: bool| {
            let offset = offset.rem_euclid(n as isize);
            let mirrored = n as isize - offset;
            if odd && mirrored == offset {
                0
            } else if offset <= mirrored {
                offset
            } else {
                -mirrored
            }
        };
        let mut sum = 0.0;
        for block in self.blocks.iter().filter(|block| block.output == output) {
            let odd = self.kernels[block.kernel].1.odd();
            for m in 0..nx {
                for n in 0..ny {
                    let offset = [
                        nearest(cell[0] as isize - m as isize, nx, odd[0]),
                        nearest(cell[1] as isize - n as isize, ny, odd[1]),
                    ];
                    sum += block.sign
                        * self.kernel_at(block.kernel, offset)
                        * self.input[block.input][m * ny + n];
                }
            }
        }
        sum
    }

    fn apply(&self, run: impl FnOnce(&[&[f64]], &mut [&mut [f64]])) -> Vec<Vec<f64>> {
        let mut output = vec![vec![f64::NAN; self.shape[0] * self.shape[1]]; self.outputs()];
        let input: Vec<_> = self.input.iter().map(Vec::as_slice).collect();
        let mut views: Vec<_> = output.iter_mut().map(Vec::as_mut_slice).collect();
        run(&input, &mut views);
        output
    }

    fn convolve(&self, engine: Engine) -> Vec<Vec<f64>> {
        let product =
            Convolution::on(engine, self.shape, &self.kernels(), &self.blocks, Mirrors::NONE).unwrap();
        self.apply(|input, output| product.apply(&mut product.workspace(), input, output))
    }

    /// Plain sums at all cells, or at `samples` of them (both corners among them): output, cell, value.
    fn judged(
        &self,
        samples: Option<usize>,
        judge: fn(&Self, usize, [usize; 2]) -> f64,
    ) -> Vec<(usize, usize, f64)> {
        let ny = self.shape[1];
        let cells = self.shape[0] * ny;
        let mut numbers = Random::seeded(7);
        let picked: Vec<usize> = match samples {
            None => (0..cells).collect(),
            Some(samples) => {
                let inside =
                    (2..samples).map(|_| ((numbers.next().abs() * cells as f64) as usize).min(cells - 1));
                [0, cells - 1].into_iter().chain(inside).collect()
            }
        };
        let values = |output| {
            let at = move |&cell: &usize| (output, cell, judge(self, output, [cell / ny, cell % ny]));
            picked.iter().map(at)
        };
        (0..self.outputs()).flat_map(values).collect()
    }

    /// Fails unless every judged value is found within `tolerance`.
    fn compare(found: &[Vec<f64>], judged: &[(usize, usize, f64)], tolerance: f64, what: &str) {
        for &(output, cell, expected) in judged {
            let difference = (found[output][cell] - expected).abs();
            assert!(difference <= tolerance, "{what}: output {output} cell {cell} is off by {difference:e}");
        }
    }
}

/// The plain sum is the less exact of the two ways: over `N` terms of size 1/3 its partial sums walk to `sqrt(N)/3`, each is
/// rounded by `eps/2`, and that adds up to `eps N / 15` (root mean square). Ten times as much is not reached by chance, and a
/// mistake is larger than a term. The transforms round off by a few `eps log2(N) sqrt(N)`, which matters below 16 cells only.
fn tolerance(problem: &Problem) -> f64 {
    2.0 * f64::EPSILON * (problem.shape[0] * problem.shape[1]).max(16) as f64 / 3.0
        * problem.blocks.len() as f64
}

const SHAPES: [[usize; 2]; 18] = [
    [1, 1],
    [1, 7],
    [6, 1],
    [97, 1],
    [120, 1],
    [2, 3],
    [4, 4],
    [5, 8],
    [8, 12],
    [16, 16],
    [20, 12],
    [13, 17],
    [24, 40],
    [9, 31],
    [32, 20],
    [48, 36],
    [60, 28],
    [27, 25],
];

#[test]
fn each_parity_is_the_plain_sum_on_any_shape() {
    for (seed, shape) in SHAPES.into_iter().enumerate() {
        for parity in PARITIES {
            let problem = Problem::new(shape, shape, &[parity], &[block(0, 0, 0, 1.0)], seed as u64);
            let judged = problem.judged(None, Problem::free_space_at);
            for engine in Engine::available() {
                let what = format!("{shape:?} {parity:?} {engine:?}");
                Problem::compare(&problem.convolve(engine), &judged, tolerance(&problem), &what);
            }
        }
    }
}

#[test]
fn all_couplings_together_are_the_plain_sum() {
    let (parities, blocks) = full_blocks();
    for (seed, shape) in SHAPES.into_iter().enumerate() {
        let problem =
            Problem::new(shape, [shape[0] + 3, shape[1] + 1], &parities, &blocks, 100 + seed as u64);
        let judged = problem.judged(None, Problem::free_space_at);
        for engine in Engine::available() {
            let what = format!("{shape:?} {engine:?}");
            Problem::compare(&problem.convolve(engine), &judged, tolerance(&problem), &what);
        }
    }
}

#[test]
fn periodic_products_are_the_plain_sum_over_one_period() {
    let (parities, blocks) = full_blocks();
    for (seed, shape) in SHAPES.into_iter().enumerate() {
        let problem = Problem::new(shape, shape, &parities, &blocks, 200 + seed as u64);
        let symbols: Vec<_> =
            problem.kernels().iter().map(|kernel| PeriodicProduct::symbol_of(shape, kernel)).collect();
        let in_frequency = Problem {
            kernels: symbols.into_iter().zip(&parities).map(|(values, &parity)| (values, parity)).collect(),
            ..Problem::new(shape, shape, &parities, &blocks, 200 + seed as u64)
        };
        let judged = problem.judged(None, Problem::periodic_at);
        for engine in Engine::available() {
            let product =
                PeriodicProduct::on(engine, shape, &in_frequency.symbols(), &blocks, Mirrors::NONE).unwrap();
            let found = problem.apply(|input, output| product.apply(&mut product.workspace(), input, output));
            Problem::compare(&found, &judged, tolerance(&problem), &format!("{shape:?} {engine:?}"));
        }
    }
}

/// Large enough for depth-first passes, several blocks of them and several strips; cells chosen at random and both corners.
#[test]
fn large_grids_are_the_plain_sum_at_sampled_cells() {
    let (parities, blocks) = full_blocks();
    for (shape, samples) in [([512, 512], 12), ([640, 72], 12), ([96, 768], 12), ([500, 333], 8)] {
        let problem = Problem::new(shape, shape, &parities, &blocks, 300 + shape[1] as u64);
        let judged = problem.judged(Some(samples), Problem::free_space_at);
        for engine in Engine::available() {
            let what = format!("{shape:?} {engine:?}");
            Problem::compare(&problem.convolve(engine), &judged, tolerance(&problem), &what);
        }
    }
}

/// Everything on a product can be seen from what impulses give; at the corners the copies that must not appear are nearest.
#[test]
fn an_impulse_in_a_corner_reaches_the_others_once_and_nothing_wraps() {
    for shape in [[16, 24], [33, 50], [64, 64]] {
        let [nx, ny] = shape;
        for parity in PARITIES {
            let mut problem = Problem::new(shape, shape, &[parity], &[block(0, 0, 0, 1.0)], 9);
            for corner in [[0, 0], [0, ny - 1], [nx - 1, 0], [nx - 1, ny - 1]] {
                problem.input[0].fill(0.0);
                problem.input[0][corner[0] * ny + corner[1]] = 1.0;
                for engine in Engine::available() {
                    let found = &problem.convolve(engine)[0];
                    for (cell, value) in found.iter().enumerate() {
                        let offset = [
                            (cell / ny) as isize - corner[0] as isize,
                            (cell % ny) as isize - corner[1] as isize,
                        ];
                        let expected = problem.kernel_at(0, offset);
                        // One nonzero input: rounding is that of the transform of the kernel, of size sqrt(N/3) per
                        // frequency, averaged back: eps log2(N) at most. 1e-14 is 45 eps.
                        assert!(
                            (value - expected).abs() < 1e-14,
                            "{shape:?} {parity:?} {engine:?} {corner:?} {cell}"
                        );
                    }
                }
            }
        }
    }
}

/// Engines add in different orders and with or without fused operations: equal up to the rounding of a transform.
#[test]
fn all_engines_give_the_same_product() {
    let (parities, blocks) = full_blocks();
    for shape in [[128, 96], [100, 240], [8, 8]] {
        let problem = Problem::new(shape, shape, &parities, &blocks, 11);
        let all: Vec<_> = Engine::available().into_iter().map(|engine| problem.convolve(engine)).collect();
        let judge = &all[all.len() - 1];
        for found in &all {
            for (found, expected) in found.iter().flatten().zip(judge.iter().flatten()) {
                assert!((found - expected).abs() <= tolerance(&problem), "{shape:?}: {found} {expected}");
            }
        }
    }
}

#[test]
fn one_thread_or_more_give_the_same_bits() {
    let (parities, blocks) = full_blocks();
    for shape in [[96, 96], [128, 200], [256, 130], [97, 500]] {
        let problem = Problem::new(shape, shape, &parities, &blocks, 12);
        let symbols = Problem::new(shape, shape, &parities, &blocks, 13);
        for engine in Engine::available() {
            let run = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let periodic =
                    PeriodicProduct::on(engine, shape, &symbols.symbols(), &blocks, Mirrors::NONE).unwrap();
                pool.install(|| {
                    let mut found = problem.convolve(engine);
                    let mut workspace = periodic.workspace();
                    found
                        .extend(problem.apply(|input, output| periodic.apply(&mut workspace, input, output)));
                    found.into_iter().flatten().map(f64::to_bits).collect::<Vec<_>>()
                })
            };
            let serial = run(1);
            for threads in [2, 3, 5] {
                assert!(serial == run(threads), "{shape:?} {engine:?} {threads} threads");
            }
        }
    }
}

#[test]
fn the_content_and_the_origin_of_a_workspace_do_not_matter() {
    let (parities, blocks) = full_blocks();
    let small = Problem::new([24, 40], [24, 40], &parities, &blocks, 14);
    let large = Problem::new([96, 100], [96, 100], &parities, &blocks, 15);
    for engine in Engine::available() {
        let plan = |problem: &Problem| {
            Convolution::on(engine, problem.shape, &problem.kernels(), &problem.blocks, Mirrors::NONE)
                .unwrap()
        };
        let (small_product, large_product) = (plan(&small), plan(&large));
        let mut workspace = small_product.workspace();
        for _ in 0..2 {
            let found = large.apply(|input, output| large_product.apply(&mut workspace, input, output));
            assert_eq!(found, large.convolve(engine));
            let found = small.apply(|input, output| small_product.apply(&mut workspace, input, output));
            assert_eq!(found, small.convolve(engine));
        }
        // Whatever a field of infinities leaves behind must not reach the next product; also where lines are longer than the grid by
        // parts, or by groups of rows, that have no cells.
        for shape in [[24, 40], [81, 20], [20, 81], [2, 24], [24, 2], [5, 20], [9, 12]] {
            let problem = Problem::new(shape, shape, &parities, &blocks, 17);
            let product = plan(&problem);
            let infinite = vec![f64::INFINITY; 96 * 100];
            large.apply(|_, output| large_product.apply(&mut workspace, &[infinite.as_slice(); 3], output));
            let cells = shape[0] * shape[1];
            problem.apply(|_, output| product.apply(&mut workspace, &[&infinite[..cells]; 3], output));
            let found = problem.apply(|input, output| product.apply(&mut workspace, input, output));
            assert_eq!(found, problem.convolve(engine), "{engine:?} {shape:?}");
        }
        let infinite = vec![f64::INFINITY; 24 * 40];
        let periodic =
            PeriodicProduct::on(engine, small.shape, &small.symbols(), &small.blocks, Mirrors::NONE).unwrap();
        let clean = small.apply(|input, output| periodic.apply(&mut periodic.workspace(), input, output));
        small.apply(|_, output| periodic.apply(&mut workspace, &[infinite.as_slice(); 3], output));
        let found = small.apply(|input, output| periodic.apply(&mut workspace, input, output));
        assert_eq!(found, clean);
    }
}

#[test]
fn fields_may_be_many_or_differ_in_number() {
    let parities = [Parity::EvenEven, Parity::OddEven];
    let several: [&[Block]; 3] = [
        &[block(0, 0, 0, 1.0), block(1, 0, 1, -1.0), block(2, 0, 0, 0.5)],
        &[block(0, 0, 0, 1.0), block(0, 1, 1, -1.0), block(0, 1, 0, 2.0)],
        &[block(0, 0, 0, 1.0), block(4, 3, 1, 1.0), block(4, 0, 0, 1.0)],
    ];
    for blocks in several {
        let problem = Problem::new([20, 24], [20, 24], &parities, blocks, 16);
        let judged = problem.judged(None, Problem::free_space_at);
        for engine in Engine::available() {
            // A factor of 2 among the blocks doubles the rounding.
            let what = format!("{engine:?} {blocks:?}");
            Problem::compare(&problem.convolve(engine), &judged, 2.0 * tolerance(&problem), &what);
        }
    }
}

/// With and without mirrors: what everybody gets is the product on the fastest engine.
#[test]
fn the_usual_products_are_those_of_the_fastest_engine() {
    let (parities, blocks) = full_blocks();
    let problem = Problem::new([16, 24], [32, 48], &parities, &blocks, 18);
    let mirrors =
        Mirrors { axes: [true, true], inputs: vec![Parity::EvenEven, Parity::OddEven, Parity::EvenOdd] };
    let fastest = Engine::available()[0];
    let (kernels, symbols) = (problem.kernels(), problem.symbols());
    for mirrors in [Mirrors::NONE, mirrors] {
        let on = Convolution::on(fastest, problem.shape, &kernels, &blocks, mirrors.clone()).unwrap();
        let usual = if mirrors.any() {
            Convolution::mirrored(problem.shape, &kernels, &blocks, mirrors.clone())
        } else {
            Convolution::new(problem.shape, &kernels, &blocks)
        };
        let usual = usual.unwrap();
        let by = |product: &Convolution| {
            problem.apply(|input, output| product.apply(&mut product.workspace(), input, output))
        };
        assert_eq!(by(&usual), by(&on));
        let on = PeriodicProduct::on(fastest, problem.shape, &symbols, &blocks, mirrors.clone()).unwrap();
        let usual = if mirrors.any() {
            PeriodicProduct::mirrored(problem.shape, &symbols, &blocks, mirrors)
        } else {
            PeriodicProduct::new(problem.shape, &symbols, &blocks)
        };
        let usual = usual.unwrap();
        let by = |product: &PeriodicProduct| {
            problem.apply(|input, output| product.apply(&mut product.workspace(), input, output))
        };
        assert_eq!(by(&usual), by(&on));
    }
}
