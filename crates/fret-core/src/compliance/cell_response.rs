//! The displacements of one cell by the tractions of another: single entries of the compliance matrix, for those who need it dense.

use ndarray::Array2;

use super::surface_response::{SurfaceResponse, signed_kernels, signed_symbols};
use crate::model::Symmetry;
use fret_fft::{Block, ConvolutionError, Parity, PeriodicProduct, Symbol};

/// Entries of the compliance matrix of a grid, with symmetry reduction where it has mirrors.
#[derive(Debug)]
pub struct CellResponse {
    /// Kernels zz, xx, yy, xy, zx, zy over offsets that are not negative; of a periodic problem over one period.
    kernels: [Option<Array2<f64>>; 6],
    /// Cells of the whole period.
    period: Option<[usize; 2]>,
    symmetry: Symmetry,
    /// Cells of the part of the grid that stands for the whole.
    cells: [usize; 2],
}

/// Parities of the kernels.
const PARITIES: [Parity; 6] =
    [Parity::EvenEven, Parity::EvenEven, Parity::EvenEven, Parity::OddOdd, Parity::OddEven, Parity::EvenOdd];

impl CellResponse {
    /// Of a response on the part of a grid before its mirrors, of `cells`.
    ///
    /// # Errors
    /// When the symbols of a periodic response are not of this grid.
    pub fn new(
        response: &SurfaceResponse,
        cells: [usize; 2],
        symmetry: Symmetry,
    ) -> Result<Self, ConvolutionError> {
        let (kernels, period) = match response {
            SurfaceResponse::FreeSpace(coefficients) => {
                (signed_kernels(coefficients).map(|(kernel, _)| kernel.clone()), None)
            }
            SurfaceResponse::Periodic(symbols) => {
                let whole = symmetry.whole_of(cells);
                let mut kernels = [const { None }; 6];
                for (kernel, (symbol, parity)) in kernels.iter_mut().zip(signed_symbols(symbols)) {
                    if let Some(values) = symbol {
                        *kernel =
                            Some(response_to_one_cell(&Symbol { values: values.view(), parity }, whole)?);
                    }
                }
                (kernels, Some(whole))
            }
        };
        Ok(Self { kernels, period, symmetry, cells })
    }

    /// Displacements `[normal, along x, along y]` of cell `to` by unit tractions on cell `from` [length/pressure]: rows are displacements.
    pub fn between(&self, to: [usize; 2], from: [usize; 2]) -> [[f64; 3]; 3] {
        let axes = self.symmetry.axes();
        let shift = [0, 1].map(|axis| if axes[axis] { self.cells[axis] } else { 0 });
        let place = |cell: [usize; 2]| [0, 1].map(|axis| (cell[axis] + shift[axis]) as isize);
        let (to, from) = (place(to), place(from));
        let mut sum = [[0.0; 3]; 3];
        for behind in [[false, false], [true, false], [false, true], [true, true]] {
            if (0..2).any(|axis| behind[axis] && !axes[axis]) {
                continue;
            }
            let image = [0, 1].map(|axis| {
                if behind[axis] { 2 * self.cells[axis] as isize - 1 - from[axis] } else { from[axis] }
            });
            let signs = [1.0, self.sign(0, behind), self.sign(1, behind)];
            let here = self.at([to[0] - image[0], to[1] - image[1]]);
            for (sum, here) in sum.iter_mut().zip(here) {
                for component in 0..3 {
                    sum[component] += signs[component] * here[component];
                }
            }
        }
        sum
    }

    /// Sign of a component of shear behind these mirrors.
    fn sign(&self, component: usize, behind: [bool; 2]) -> f64 {
        let odd = self.symmetry.shear_is_odd(component);
        if (behind[0] && odd[0]) == (behind[1] && odd[1]) { 1.0 } else { -1.0 }
    }

    /// Displacements at an offset from unit tractions.
    fn at(&self, offset: [isize; 2]) -> [[f64; 3]; 3] {
        let value = |index: usize| {
            let Some(kernel) = &self.kernels[index] else { return 0.0 };
            if let Some(period) = self.period {
                let [i, j] = [0, 1].map(|axis| offset[axis].rem_euclid(period[axis] as isize) as usize);
                return kernel[[i, j]];
            }
            let odd = PARITIES[index].odd();
            let turns = (0..2)
                .fold(1.0, |sign, axis| if odd[axis] { sign * offset[axis].signum() as f64 } else { sign });
            turns * kernel[[offset[0].unsigned_abs(), offset[1].unsigned_abs()]]
        };
        let [zz, xx, yy, xy, zx, zy] = [0, 1, 2, 3, 4, 5].map(value);
        [[zz, zx, zy], [-zx, xx, xy], [-zy, xy, yy]]
    }
}

/// The displacements of all cells of a period by a unit traction on the first.
fn response_to_one_cell(symbol: &Symbol<'_>, cells: [usize; 2]) -> Result<Array2<f64>, ConvolutionError> {
    let block = [Block { output: 0, input: 0, kernel: 0, sign: 1.0 }];
    let product =
        PeriodicProduct::mirrored(cells, std::slice::from_ref(symbol), &block, fret_fft::Mirrors::NONE)?;
    let mut traction = vec![0.0; cells[0] * cells[1]];
    traction[0] = 1.0;
    let mut displacement = vec![0.0; traction.len()];
    product.apply(&mut product.workspace(), &[&traction], &mut [&mut displacement]);
    Array2::from_shape_vec(cells, displacement).map_err(|_| ConvolutionError::EmptyShape(cells[0], cells[1]))
}
