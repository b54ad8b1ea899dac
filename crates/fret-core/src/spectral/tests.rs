//! The products against plain sums.

use ndarray::Array2;

use super::{Block, Convolution, ConvolutionError, Kernel, Parity, PeriodicProduct, Symbol};

const PARITIES: [Parity; 4] = [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd, Parity::OddOdd];

/// Seeded numbers in (-1, 1): the generator of Knuth's MMIX.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
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

fn block(output: usize, input: usize, kernel: usize, sign: f64) -> Block {
    Block { output, input, kernel, sign }
}

/// Pressure and shear with all couplings: six kernels, nine blocks.
fn full_blocks() -> (Vec<Parity>, Vec<Block>) {
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
        let mut numbers = Numbers(seed);
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

    fn convolve(&self) -> Vec<Vec<f64>> {
        let product = Convolution::new(self.shape, &self.kernels(), &self.blocks).unwrap();
        self.apply(|input, output| product.apply(&mut product.workspace(), input, output))
    }

    /// Largest difference from plain sums at all cells, or at `samples` of them.
    fn worst(
        &self,
        found: &[Vec<f64>],
        samples: Option<usize>,
        judge: fn(&Self, usize, [usize; 2]) -> f64,
    ) -> f64 {
        let [nx, ny] = self.shape;
        let cells = nx * ny;
        let mut numbers = Numbers(7);
        let mut worst = 0.0_f64;
        for (output, values) in found.iter().enumerate() {
            for sample in 0..samples.unwrap_or(cells) {
                let cell = match samples {
                    None => sample,
                    Some(_) if sample == 0 => 0,
                    Some(_) if sample == 1 => cells - 1,
                    Some(_) => ((numbers.next().abs() * cells as f64) as usize).min(cells - 1),
                };
                let difference = (values[cell] - judge(self, output, [cell / ny, cell % ny])).abs();
                assert!(difference.is_finite());
                worst = worst.max(difference);
            }
        }
        worst
    }
}

/// Both ways round off like random walks: an FFT as `eps log2(N) |K| |x|`, the plain sum as `eps sqrt(N)` of its largest
/// partial sum, and `|K| |x| = N/3` for numbers uniform in (-1, 1) with `N` cells. Twice `eps (N/3)` per block is
/// a bound never reached and 10 digits below any mistake.
fn tolerance(problem: &Problem) -> f64 {
    2.0 * f64::EPSILON * (problem.shape[0] * problem.shape[1]).max(16) as f64 / 3.0
        * problem.blocks.len() as f64
}

const SHAPES: [[usize; 2]; 16] = [
    [1, 1],
    [1, 7],
    [6, 1],
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
            let worst = problem.worst(&problem.convolve(), None, Problem::free_space_at);
            assert!(worst <= tolerance(&problem), "{shape:?} {parity:?}: {worst:e}");
        }
    }
}

#[test]
fn all_couplings_together_are_the_plain_sum() {
    let (parities, blocks) = full_blocks();
    for (seed, shape) in SHAPES.into_iter().enumerate() {
        let problem =
            Problem::new(shape, [shape[0] + 3, shape[1] + 1], &parities, &blocks, 100 + seed as u64);
        let worst = problem.worst(&problem.convolve(), None, Problem::free_space_at);
        assert!(worst <= tolerance(&problem), "{shape:?}: {worst:e}");
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
        let product = PeriodicProduct::new(shape, &in_frequency.symbols(), &blocks).unwrap();
        let found = problem.apply(|input, output| product.apply(&mut product.workspace(), input, output));
        let worst = problem.worst(&found, None, Problem::periodic_at);
        assert!(worst <= tolerance(&problem), "{shape:?}: {worst:e}");
    }
}

#[test]
fn what_cannot_be_planned_is_refused_with_the_reason() {
    let values = Array2::<f64>::ones([4, 4]);
    let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
    let one = [block(0, 0, 0, 1.0)];
    let error = |shape, kernels: &[Kernel<'_>], blocks: &[Block]| {
        Convolution::new(shape, kernels, blocks).err().unwrap()
    };
    assert_eq!(error([0, 4], &[kernel], &one), ConvolutionError::EmptyShape(0, 4));
    assert_eq!(error([4, 4], &[kernel], &[]), ConvolutionError::NoBlocks);
    assert!(matches!(error([4, 5], &[kernel], &one), ConvolutionError::TooSmall { needed_y: 5, .. }));
    assert!(matches!(
        error([4, 4], &[kernel], &[block(0, 0, 1, 1.0)]),
        ConvolutionError::NoSuchKernel { kernel: 1, kernels: 1, .. }
    ));
    assert!(matches!(error([4, 4], &[kernel], &[block(0, 0, 0, f64::NAN)]), ConvolutionError::Factor { .. }));
    let mut broken = values.clone();
    broken[[1, 2]] = f64::INFINITY;
    let broken = Kernel { values: broken.view(), parity: Parity::EvenEven };
    assert!(matches!(error([4, 4], &[broken], &one), ConvolutionError::NotFinite { x: 1, y: 2, .. }));
    assert!(Convolution::new([1, 2], &[broken], &one).is_ok(), "values that are not used do not matter");
}
