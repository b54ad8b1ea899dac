//! Products in single precision, where a relative error of 1e-6 is enough.

use super::Workspace;
use super::lanes::LaneProduct;

/// A [`Convolution`](super::Convolution) or [`PeriodicProduct`](super::PeriodicProduct) in single precision.
///
/// Its rounding is about 1e-7 of the largest output. Outputs are in units of [`unit`](Self::unit); inputs are best brought to
/// a size near one, since single precision ends at 1e-38 and 1e38.
pub struct SingleProduct {
    product: LaneProduct<f32>,
    unit: f64,
}

impl SingleProduct {
    pub(super) fn new((product, unit): (LaneProduct<f32>, f64)) -> Self {
        Self { product, unit }
    }

    /// Computes all outputs (what they held before is lost), divided by [`unit`](Self::unit). Fields are those of the product
    /// this one was made of; bitwise the same for any number of threads.
    pub fn apply(&self, workspace: &mut Workspace, input: &[&[f32]], output: &mut [&mut [f32]]) {
        let count = self.product.work_len(rayon::current_num_threads());
        self.product.apply(workspace.single_lanes(count), input, output);
    }

    /// What the outputs must be multiplied with: a power of two.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Memory held by the transformed kernels, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.product.memory_bytes()
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array2;

    use super::super::tests::block;
    use super::super::{Convolution, Kernel, Parity};
    use super::*;

    /// Kernel values by their product in single precision, its unit, and the same product in double precision.
    fn products(values: &Array2<f64>) -> (Vec<f32>, f64, Vec<f64>) {
        let kernel = Kernel { values: values.view(), parity: Parity::EvenEven };
        let product = Convolution::new([12, 20], &[kernel], &[block(0, 0, 0, 1.0)]).unwrap();
        let single = product.in_single_precision().unwrap();
        let input: Vec<f32> = (0_u16..240).map(|cell| (f32::from(cell) * 0.7).sin()).collect();
        let wide: Vec<f64> = input.iter().copied().map(f64::from).collect();
        let (mut found, mut exact) = (vec![f32::NAN; 240], vec![f64::NAN; 240]);
        single.apply(&mut Workspace::default(), &[&input], &mut [&mut found]);
        product.apply(&mut product.workspace(), &[&wide], &mut [&mut exact]);
        (found, single.unit(), exact)
    }

    /// Metres per newton or gigapascals per nanometre: a factor of two is exact, so the digits are the same; beyond 1e-38 and
    /// 1e38 nothing would be left of kernels that were rounded as they are.
    #[test]
    fn kernels_of_any_size_give_the_same_digits() {
        let values =
            Array2::from_shape_fn([12, 20], |(i, j)| 1.0 / (1.0 + (i * i + 2 * j * j) as f64).sqrt());
        let (digits, unit, _) = products(&values);
        for exponent in [-300_i32, -150, -1, 1, 150, 300] {
            let size = f64::from(exponent).exp2();
            let (found, found_unit, exact) = products(&values.mapv(|value| value * size));
            assert_eq!(found, digits);
            assert_eq!(found_unit, unit * size);
            assert_eq!(found_unit.log2().fract(), 0.0, "a power of two");
            let largest = exact.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (found, exact) in found.iter().zip(&exact) {
                let found = found_unit * f64::from(*found);
                // Single precision rounds by 6e-8, a transform of some hundred points by a few times that.
                assert!((found - exact).abs() < 1e-6 * largest, "{exponent}: {found} {exact}");
            }
        }
    }

    #[test]
    fn a_kernel_of_zeros_gives_zeros() {
        let (found, unit, _) = products(&Array2::zeros([12, 20]));
        assert_eq!(found, [0.0; 240]);
        assert_eq!(unit, 1.0);
    }
}
