//! What products refuse, and with which words.

use ndarray::Array2;

use super::super::{Block, Convolution, ConvolutionError, Kernel, Parity, PeriodicProduct, Symbol};
use super::{Problem, block};

#[test]
#[should_panic(expected = "field of 15 values passed to a product on a 4 x 4 grid")]
fn a_field_of_another_size_is_named() {
    let problem = Problem::new([4, 4], [4, 4], &[Parity::EvenEven], &[block(0, 0, 0, 1.0)], 17);
    let product = Convolution::new([4, 4], &problem.kernels(), &problem.blocks).unwrap();
    product.apply(&mut product.workspace(), &[&[0.0; 15]], &mut [&mut [0.0; 16]]);
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
    let mut twice = values.clone();
    (twice[[1, 0]], twice[[1, 2]]) = (f64::NAN, f64::INFINITY);
    let twice = Kernel { values: twice.view(), parity: Parity::EvenEven };
    assert!(matches!(error([4, 4], &[twice], &one), ConvolutionError::NotFinite { x: 1, y: 0, .. }));
}

#[test]
fn a_value_that_is_not_finite_is_found_however_the_array_lies() {
    let one = [block(0, 0, 0, 1.0)];
    for at in [[0, 0], [0, 4], [3, 0], [3, 4], [2, 1]] {
        let mut values = Array2::<f64>::ones([5, 7]);
        values[at] = f64::NAN;
        let by_columns = values.t().as_standard_layout().into_owned();
        for values in [values.view(), by_columns.t()] {
            let kernel = Kernel { values, parity: Parity::EvenEven };
            let refused = Convolution::new([4, 5], &[kernel], &one).err().unwrap();
            assert!(
                matches!(refused, ConvolutionError::NotFinite { kernel: 0, x, y, .. } if [x, y] == at),
                "{at:?} {refused:?}"
            );
            assert!(Convolution::new([2, 1], &[kernel], &one).is_ok() || at == [0, 0], "not used: {at:?}");
        }
    }
}

#[test]
fn a_kernel_that_is_too_short_along_either_axis_is_refused() {
    let one = [block(0, 0, 0, 1.0)];
    let values = Array2::<f64>::ones([4, 6]);
    let kernel = Kernel { values: values.view(), parity: Parity::OddEven };
    for (shape, is_covered) in [([4, 6], true), ([5, 6], false), ([4, 7], false), ([3, 2], true)] {
        let found = Convolution::new(shape, &[kernel], &one).err();
        let [needed_x, needed_y] = shape;
        let refused = ConvolutionError::TooSmall { kernel: 0, found_x: 4, found_y: 6, needed_x, needed_y };
        assert_eq!(found, (!is_covered).then_some(refused));
    }
    // Of a product that repeats only half of the wavenumbers are told.
    let symbol = Symbol { values: values.view(), parity: Parity::OddEven };
    for (shape, is_covered) in [([6, 10], true), ([7, 11], true), ([8, 10], false), ([6, 12], false)] {
        let found = PeriodicProduct::new(shape, &[symbol], &one);
        assert_eq!(found.is_ok(), is_covered, "{shape:?}");
    }
}

#[test]
fn fields_that_are_missing_or_too_many_are_named() {
    let problem = Problem::new([4, 4], [4, 4], &[Parity::EvenEven], &[block(1, 0, 0, 1.0)], 17);
    let product = Convolution::new([4, 4], &problem.kernels(), &problem.blocks).unwrap();
    let refused = |inputs: usize, outputs: usize| {
        let field = [0.0; 16];
        let mut fields = vec![vec![0.0; 16]; outputs];
        let mut views: Vec<_> = fields.iter_mut().map(Vec::as_mut_slice).collect();
        let call = std::panic::AssertUnwindSafe(|| {
            product.apply(&mut product.workspace(), &vec![field.as_slice(); inputs], &mut views);
        });
        let panic = std::panic::catch_unwind(call).err()?;
        panic.downcast_ref::<String>().cloned()
    };
    assert_eq!(refused(1, 2), None);
    for (inputs, outputs) in [(1, 1), (1, 3), (0, 2), (2, 2)] {
        let words = format!("product of 1 inputs and 2 outputs called with {inputs} and {outputs}");
        assert_eq!(refused(inputs, outputs), Some(words));
    }
}

#[test]
#[should_panic(expected = "kernel of (4, 2) values periodised on a [6, 4] grid, which needs [4, 3]")]
fn a_kernel_shorter_than_half_a_period_has_no_symbol_along_y() {
    let values = Array2::ones([4, 2]);
    PeriodicProduct::symbol_of([6, 4], &Kernel { values: values.view(), parity: Parity::EvenEven });
}

#[test]
#[should_panic(expected = "kernel of (3, 3) values periodised on a [6, 4] grid, which needs [4, 3]")]
fn a_kernel_shorter_than_half_a_period_has_no_symbol_along_x() {
    let values = Array2::ones([3, 3]);
    PeriodicProduct::symbol_of([6, 4], &Kernel { values: values.view(), parity: Parity::EvenEven });
}

#[test]
fn a_symbol_has_half_the_wavenumbers_of_a_period_and_zero() {
    let values = Array2::ones([4, 3]);
    let symbol =
        PeriodicProduct::symbol_of([6, 4], &Kernel { values: values.view(), parity: Parity::EvenEven });
    assert_eq!(symbol.dim(), (4, 3));
}

/// Large enough to be looked through by several threads at once.
#[test]
fn of_several_broken_kernels_the_first_is_named_on_any_number_of_threads()
-> Result<(), rayon::ThreadPoolBuildError> {
    let shape = [120, 130];
    let whole = Array2::<f64>::ones(shape);
    let broken = |value: f64| {
        let mut values = whole.clone();
        values[[100, 7]] = value;
        values
    };
    let (infinite, negative) = (broken(f64::INFINITY), broken(f64::NEG_INFINITY));
    for threads in [1, 2, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        for count in 1..=5 {
            for first in 0..=count {
                for second in first + 1..=count {
                    let kernels: Vec<Kernel<'_>> = (0..count)
                        .map(|index| {
                            let values = match index {
                                _ if index == first => &infinite,
                                _ if index == second => &negative,
                                _ => &whole,
                            };
                            Kernel { values: values.view(), parity: Parity::EvenEven }
                        })
                        .collect();
                    let one = [block(0, 0, 0, 1.0)];
                    let found = pool.install(|| Convolution::new(shape, &kernels, &one)).err();
                    let refused =
                        ConvolutionError::NotFinite { kernel: first, value: f64::INFINITY, x: 100, y: 7 };
                    assert_eq!(
                        found,
                        (first < count).then_some(refused),
                        "{threads} threads, {count} kernels"
                    );
                }
            }
        }
    }
    Ok(())
}
