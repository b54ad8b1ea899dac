//! From the tractions on the surface to stress and displacement at one depth: kernels of that depth, and products with them.

use ndarray::{Array2, ArrayView2};

use super::depths::DepthPoint;
use super::tensor::StressField;
use crate::compliance::product::Product;
use crate::kernel::depth_cells::{displacement_coefficients, stress_coefficients};
use crate::kernel::depth_periodic::{displacement_symbols, stress_symbols};
use crate::kernel::depth_response::DepthResponse;
use crate::model::{HalfSpace, SurfaceGrid};
use crate::spectral::{Block, Convolution, ConvolutionError, Kernel, Parity, PeriodicProduct, Symbol};

/// Tractions on the body's surface [pressure], shape `(nx, ny)`, uniform over each cell.
#[derive(Debug, Clone, Copy)]
pub struct Tractions<'a> {
    /// Pressure, compression positive.
    pub pressure: ArrayView2<'a, f64>,
    /// Shear acting on the body, along x and y.
    pub shear: Option<[ArrayView2<'a, f64>; 2]>,
}

/// Stress and displacement at one depth of one body, under the centres of the cells.
///
/// In free space: kernels of the whole stack at that depth, tabulated in the distance and integrated over cells, as for the
/// surface; at depth 0 they give the stress in the surface itself. In scenes that repeat: the response at the grid's own
/// wavenumbers. Exact for tractions that are uniform over each cell (free space), to rounding: about 1e-13 of the largest
/// traction for contrasts up to 1e4.
pub struct DepthOperator {
    point: DepthPoint,
    shape: [usize; 2],
    with_shear: bool,
    /// xx, yy, zz and xy, xz, yz.
    stress: [Product; 2],
    displacement: Option<Product>,
}

const fn block(output: usize, input: usize, kernel: usize) -> Block {
    Block { output, input, kernel, sign: 1.0 }
}

/// Parity of a component from pressure; shear turns the one along its own axis.
fn parity(component: usize, load: usize) -> Parity {
    let [mut x, mut y] =
        [[false, false], [false, false], [false, false], [true, true], [true, false], [false, true]]
            [component];
    if load == 1 {
        x = !x;
    }
    if load == 2 {
        y = !y;
    }
    match (x, y) {
        (false, false) => Parity::EvenEven,
        (true, false) => Parity::OddEven,
        (false, true) => Parity::EvenOdd,
        (true, true) => Parity::OddOdd,
    }
}

impl DepthOperator {
    /// Operator of one depth of a half-space; `with_shear` when shear will be given, `with_displacement` when displacement
    /// will be asked for.
    ///
    /// # Errors
    /// When a kernel is not finite: with moduli or lengths of extreme magnitude.
    pub fn new(
        half_space: &HalfSpace,
        point: DepthPoint,
        grid: &SurfaceGrid,
        periodic: bool,
        with_shear: bool,
        with_displacement: bool,
    ) -> Result<Self, ConvolutionError> {
        let (shape, spacing) = (grid.cells(), grid.spacing());
        let response = DepthResponse::new(half_space, point.layer, point.depth);
        let coefficients = if periodic {
            stress_symbols(&response, shape, spacing)
        } else {
            stress_coefficients(&response, shape, spacing, with_shear)
        };
        let loads = if with_shear { coefficients.loads() } else { 1 };
        let half = |first: usize| {
            let (mut kernels, mut blocks) = (Vec::new(), Vec::new());
            for input in 0..loads {
                for component in 0..3 {
                    blocks.push(block(component, input, kernels.len()));
                    let values = coefficients.kernel(input, first + component);
                    kernels.push((values, parity(first + component, input)));
                }
            }
            product(periodic, shape, &kernels, &blocks)
        };
        let stress = [half(0)?, half(3)?];
        let displacement = if with_displacement {
            let coefficients = if periodic {
                displacement_symbols(&response, shape, spacing)
            } else {
                displacement_coefficients(&response, shape, spacing)
            };
            let (mut kernels, mut blocks) = (Vec::new(), Vec::new());
            for input in 0..loads {
                for component in 0..3 {
                    // u_x, u_y, u_z have the parities of sigma_xz, sigma_yz, sigma_zz
                    blocks.push(block(component, input, kernels.len()));
                    let values = coefficients.kernel(input, component);
                    kernels.push((values, parity([4, 5, 2][component], input)));
                }
            }
            Some(product(periodic, shape, &kernels, &blocks)?)
        } else {
            None
        };
        Ok(Self { point, shape, with_shear, stress, displacement })
    }

    /// The depth.
    pub fn point(&self) -> DepthPoint {
        self.point
    }

    /// Stress from tractions [pressure]. Shear must be given exactly when the operator was made for it.
    ///
    /// # Panics
    /// When the tractions are not those the operator was made for.
    pub fn stress(&mut self, tractions: &Tractions<'_>) -> StressField {
        let input = self.flat(tractions);
        let mut field = StressField::zeros(self.shape);
        let (normal, shear) = field.components.split_at_mut(3);
        apply(&mut self.stress[0], &input, normal);
        apply(&mut self.stress[1], &input, shear);
        field
    }

    /// Displacement `u_x, u_y, u_z` of the body [length]; `None` when the operator was not made for it. In scenes that repeat
    /// without the mean, which a half-space does not determine.
    ///
    /// # Panics
    /// As [`stress`](Self::stress).
    pub fn displacement(&mut self, tractions: &Tractions<'_>) -> Option<[Array2<f64>; 3]> {
        let input = self.flat(tractions);
        let shape = (self.shape[0], self.shape[1]);
        let product = self.displacement.as_mut()?;
        let mut fields: [Array2<f64>; 3] = std::array::from_fn(|_| Array2::zeros(shape));
        apply(product, &input, &mut fields);
        Some(fields)
    }

    fn flat(&self, tractions: &Tractions<'_>) -> Vec<Vec<f64>> {
        let mut input = vec![tractions.pressure.iter().copied().collect::<Vec<f64>>()];
        if let (true, Some(shear)) = (self.with_shear, &tractions.shear) {
            input.extend(shear.iter().map(|component| component.iter().copied().collect()));
        }
        assert_eq!(self.with_shear, tractions.shear.is_some(), "shear given or asked for, not both");
        input
    }
}

fn product(
    periodic: bool,
    shape: [usize; 2],
    kernels: &[(ArrayView2<'_, f64>, Parity)],
    blocks: &[Block],
) -> Result<Product, ConvolutionError> {
    if periodic {
        let symbols: Vec<Symbol<'_>> =
            kernels.iter().map(|&(values, parity)| Symbol { values, parity }).collect();
        Ok(Product::periodic(PeriodicProduct::new(shape, &symbols, blocks)?))
    } else {
        let kernels: Vec<Kernel<'_>> =
            kernels.iter().map(|&(values, parity)| Kernel { values, parity }).collect();
        Ok(Product::free_space(Convolution::new(shape, &kernels, blocks)?))
    }
}

fn apply(product: &mut Product, input: &[Vec<f64>], output: &mut [Array2<f64>]) {
    let input: Vec<&[f64]> = input.iter().map(Vec::as_slice).collect();
    // fields made by `zeros` are contiguous
    let mut output: Vec<&mut [f64]> =
        output.iter_mut().map(|field| field.as_slice_mut().unwrap_or_default()).collect();
    product.apply(&input, &mut output);
}
