//! Cross spectra: all that the scalar products of fields with what a convolution makes depend on, whatever its kernels are.

use super::lanes::AlignedNumbers;
use super::{Convolution, Workspace};

/// Sums of the products of spectra of fields that a [`Convolution`] takes with those of fields beside what it makes.
#[derive(Debug, Clone)]
pub struct CrossSpectra {
    sums: AlignedNumbers<f64>,
}

impl Convolution {
    /// Cross spectra of no fields, for convolutions of this shape with these blocks; `None` where a convolution goes line by line.
    ///
    /// After some pairs of fields `a` and `b` have been added, any such convolution says of all of them at once what
    /// `sum over pairs and outputs of b . (convolution of a)` is:
    ///
    /// ```
    /// # use fretting_fft::{Block, Convolution, Kernel, Parity};
    /// let values = ndarray::Array2::from_shape_fn([16, 16], |(i, j)| 1.0 / (1.0 + (i + 2 * j) as f64));
    /// let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
    /// let block = Block { output: 0, input: 0, kernel: 0, sign: 1.0 };
    /// let convolution = Convolution::new([16, 16], &[kernel], &[block])?;
    /// let mut workspace = convolution.workspace();
    /// if let Some(mut spectra) = convolution.cross_spectra() {
    ///     let (a, b) = (vec![1.0; 256], vec![0.5; 256]);
    ///     convolution.add_cross_spectra(&mut workspace, (&[&a], &[&b]), &mut spectra);
    ///     let mut product = vec![0.0; 256];
    ///     convolution.apply(&mut workspace, &[&a], &mut [&mut product]);
    ///     let expected: f64 = product.iter().zip(&b).map(|(product, b)| product * b).sum();
    ///     assert!((convolution.contracted(&spectra) - expected).abs() < 1e-12 * expected);
    /// }
    /// # Ok::<(), fretting_fft::ConvolutionError>(())
    /// ```
    pub fn cross_spectra(&self) -> Option<CrossSpectra> {
        self.product.cross_spectra().map(|sums| CrossSpectra { sums })
    }

    /// Adds the cross spectra of fields that the convolution takes with fields beside those that it makes, at about the price of one
    /// application; bitwise the same for any number of threads.
    ///
    /// # Panics
    /// When the number of fields or their length is not what the convolution was made for.
    pub fn add_cross_spectra(
        &self,
        workspace: &mut Workspace,
        (input, output): (&[&[f64]], &[&[f64]]),
        to: &mut CrossSpectra,
    ) {
        self.terms.check_fields(input, output);
        self.product.add_cross_spectra(workspace, (input, output), &mut to.sums);
    }

    /// The sum, over all pairs of fields that were added, of their scalar products through this convolution: one sum over its frequencies.
    pub fn contracted(&self, with: &CrossSpectra) -> f64 {
        self.product.contracted(&with.sums)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{block, full_blocks};
    use super::*;
    use crate::random::Random;
    use crate::{Block, Engine, Kernel, Mirrors, Parity};

    /// The sum over pairs of random fields by cross spectra and by a convolution of each, on every engine that has them.
    fn check(shape: [usize; 2], axes: [bool; 2], parities: &[Parity], blocks: &[Block], inputs: &[Parity]) {
        let mut random = Random::seeded(31);
        let mirrors = Mirrors { axes, inputs: inputs.to_vec() };
        let whole = mirrors.whole(shape);
        let outputs = 1 + blocks.iter().map(|block| block.output).max().unwrap();
        let mut fields = |count: usize| -> Vec<Vec<f64>> {
            (0..count)
                .map(|_| (0..shape[0] * shape[1]).map(|_| random.between(-1.0, 1.0)).collect())
                .collect()
        };
        let pairs: Vec<[Vec<Vec<f64>>; 2]> =
            (0..3).map(|_| [fields(inputs.len()), fields(outputs)]).collect();
        let sets: Vec<Vec<ndarray::Array2<f64>>> = (0..2)
            .map(|_| {
                parities
                    .iter()
                    .map(|_| ndarray::Array2::from_shape_fn(whole, |_| random.between(-1.0, 1.0)))
                    .collect()
            })
            .collect();
        for engine in Engine::available() {
            let convolutions: Vec<Convolution> = sets
                .iter()
                .map(|values| {
                    let kernels: Vec<Kernel<'_>> = values
                        .iter()
                        .zip(parities)
                        .map(|(values, parity)| Kernel { values: values.view(), parity: *parity })
                        .collect();
                    Convolution::on(engine, shape, &kernels, blocks, mirrors.clone()).unwrap()
                })
                .collect();
            let mut workspace = convolutions[0].workspace();
            let Some(mut spectra) = convolutions[0].cross_spectra() else {
                assert_eq!(format!("{engine:?}"), "lines by rustfft");
                continue;
            };
            let mut expected = [0.0; 2];
            for [from, beside] in &pairs {
                let from: Vec<&[f64]> = from.iter().map(Vec::as_slice).collect();
                let beside: Vec<&[f64]> = beside.iter().map(Vec::as_slice).collect();
                convolutions[0].add_cross_spectra(&mut workspace, (&from, &beside), &mut spectra);
                for (expected, convolution) in expected.iter_mut().zip(&convolutions) {
                    let mut made = vec![vec![0.0; shape[0] * shape[1]]; outputs];
                    let mut to: Vec<&mut [f64]> = made.iter_mut().map(Vec::as_mut_slice).collect();
                    convolution.apply(&mut workspace, &from, &mut to);
                    let parts = made.iter().zip(&beside);
                    *expected += parts.flat_map(|(a, b)| a.iter().zip(*b)).map(|(a, b)| a * b).sum::<f64>();
                }
            }
            // Sums of some ten thousand parts of either sign and of size one, rounded.
            for (expected, convolution) in expected.iter().zip(&convolutions) {
                let found = convolution.contracted(&spectra);
                assert!(
                    (found - expected).abs() < 1e-10,
                    "{engine:?} {shape:?} {axes:?}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn cross_spectra_tell_the_scalar_products_of_all_pairs_through_any_kernels() {
        let (parities, blocks) = full_blocks();
        let inputs = [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd];
        for shape in [[1, 9], [8, 8], [13, 30], [20, 36], [48, 15]] {
            for axes in [[false, false], [true, false], [false, true], [true, true]] {
                check(shape, axes, &parities, &blocks, &inputs);
                check(shape, axes, &[Parity::EvenEven], &[block(0, 0, 0, -1.5)], &inputs[1..2]);
                let along =
                    [block(0, 0, 0, 1.0), block(1, 1, 1, 1.0), block(0, 1, 2, 1.0), block(1, 0, 2, -1.0)];
                check(
                    shape,
                    axes,
                    &[Parity::EvenEven, Parity::EvenEven, Parity::OddEven],
                    &along,
                    &inputs[..2],
                );
            }
        }
    }

    /// As often as they are added, in one memory: what is left there by one pair of fields does not grow in those after it, in places that no kernel
    /// reads. 2000 times: a factor of two each time is more than there are numbers for.
    #[test]
    fn cross_spectra_stay_finite_however_often_they_are_added() {
        let (parities, blocks) = full_blocks();
        let inputs = [Parity::EvenEven, Parity::OddEven, Parity::EvenOdd];
        for (size, axes) in (5..24).flat_map(|size| [[false, false], [true, true]].map(|axes| (size, axes))) {
            let mirrors = Mirrors { axes, inputs: inputs.to_vec() };
            let whole = mirrors.whole([size, size]);
            let values = ndarray::Array2::from_shape_fn(whole, |(i, j)| 1.0 / (1.0 + (i * i + j) as f64));
            let kernels: Vec<Kernel<'_>> =
                parities.iter().map(|parity| Kernel { values: values.view(), parity: *parity }).collect();
            for engine in Engine::available() {
                let convolution =
                    Convolution::on(engine, [size, size], &kernels, &blocks, mirrors.clone()).unwrap();
                let Some(mut spectra) = convolution.cross_spectra() else { continue };
                let mut workspace = convolution.workspace();
                let field = vec![1.0; size * size];
                let mut once = 0.0;
                for number in 0..2000 {
                    let fields = [&field[..], &field, &field];
                    convolution.add_cross_spectra(&mut workspace, (&fields, &fields), &mut spectra);
                    if number == 0 {
                        once = convolution.contracted(&spectra);
                    }
                }
                let off = convolution.contracted(&spectra) - 2000.0 * once;
                assert!(
                    off.abs() < 1e-11 * (1.0 + once.abs()) * 2000.0,
                    "{engine:?} {size} {axes:?}: {off:e}"
                );
            }
        }
    }

    /// The same bits for any number of threads, on a grid that is divided among them.
    #[test]
    fn cross_spectra_do_not_depend_on_the_threads() {
        let values = ndarray::Array2::from_shape_fn([128, 120], |(i, j)| 1.0 / (1.0 + (i * i + j) as f64));
        let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
        let convolution = Convolution::new([128, 120], &[kernel], &[block(0, 0, 0, 1.0)]).unwrap();
        let mut random = Random::seeded(32);
        let [a, b] =
            [(); 2].map(|()| -> Vec<f64> { (0..128 * 120).map(|_| random.between(-1.0, 1.0)).collect() });
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut spectra = convolution.cross_spectra()?;
                convolution.add_cross_spectra(&mut convolution.workspace(), (&[&a], &[&b]), &mut spectra);
                Some(convolution.contracted(&spectra).to_bits())
            })
        };
        assert_eq!(on(1), on(3));
    }
}
