//! The elastic answer by a plain double sum over cells.

use super::operator::{SelfInfluence, SurfaceCompliance};
use super::surface_response::{FULL_BLOCKS, own_of, signed_kernels};
use crate::kernel::InfluenceCoefficients;
use fret_fft::{Block, ConvolutionError};

/// The elastic answer of a box of cells, summed term by term: the judge of faster ways. Coefficients that are absent count as
/// zero. Cost of a product for every pair of cells; for boxes of at most a few thousand cells.
pub struct DirectCompliance {
    shape: [usize; 2],
    coefficients: InfluenceCoefficients,
}

impl DirectCompliance {
    /// Operator of a box of `shape` cells from coefficients that cover at least its offsets.
    ///
    /// # Errors
    /// When a coefficient that is there does not cover the box.
    pub fn new(coefficients: InfluenceCoefficients, shape: [usize; 2]) -> Result<Self, ConvolutionError> {
        for (kernel, (values, _)) in signed_kernels(&coefficients).into_iter().enumerate() {
            let Some(values) = values else { continue };
            let (found_x, found_y) = values.dim();
            if found_x < shape[0] || found_y < shape[1] {
                let [needed_x, needed_y] = shape;
                return Err(ConvolutionError::TooSmall { kernel, found_x, found_y, needed_x, needed_y });
            }
        }
        Ok(Self { shape, coefficients })
    }

    /// Displacement `output` (z, x, y) of one cell by the tractions `input` (z, x, y; `None`: not loaded).
    fn displacement(&self, output: usize, cell: [usize; 2], input: [Option<&[f64]>; 3]) -> f64 {
        let mut sum = 0.0;
        for Block { input: from, kernel, sign, .. } in
            FULL_BLOCKS.iter().filter(|block| block.output == output)
        {
            let (Some(values), parity) = signed_kernels(&self.coefficients)[*kernel] else { continue };
            let Some(traction) = input[*from] else { continue };
            let odd = parity.odd();
            for m in 0..self.shape[0] {
                for n in 0..self.shape[1] {
                    let loaded = [m, n];
                    let mut term = sign * traction[m * self.shape[1] + n];
                    for axis in 0..2 {
                        if odd[axis] && cell[axis] == loaded[axis] {
                            term = 0.0;
                        } else if odd[axis] && cell[axis] < loaded[axis] {
                            term = -term;
                        }
                    }
                    sum += term * values[[cell[0].abs_diff(m), cell[1].abs_diff(n)]];
                }
            }
        }
        sum
    }

    fn fill(&self, output: usize, input: [Option<&[f64]>; 3], displacements: &mut [f64]) {
        for (index, displacement) in displacements.iter_mut().enumerate() {
            let cell = [index / self.shape[1], index % self.shape[1]];
            *displacement = self.displacement(output, cell, input);
        }
    }
}

impl SurfaceCompliance for DirectCompliance {
    fn shape(&self) -> [usize; 2] {
        self.shape
    }

    fn self_influence(&self) -> SelfInfluence {
        own_of(&self.coefficients)
    }

    fn normal(&mut self, pressure: &[f64], normal: &mut [f64]) {
        self.fill(0, [Some(pressure), None, None], normal);
    }

    fn tangential(&mut self, [x, y]: [&[f64]; 2], [to_x, to_y]: [&mut [f64]; 2]) {
        self.fill(1, [None, Some(x), Some(y)], to_x);
        self.fill(2, [None, Some(x), Some(y)], to_y);
    }

    fn full(&mut self, tractions: [&[f64]; 3], displacements: [&mut [f64]; 3]) {
        for (output, displacement) in displacements.into_iter().enumerate() {
            self.fill(output, tractions.map(Some), displacement);
        }
    }
}
