//! The approximate inverse of the response, cut off after a few cells: what pressures would about remove the displacements in their
//! neighbourhood. A window of positive spectrum keeps it positive definite (Wendland 1995).

use std::ops::Range;

use pulp::Arch;

use super::super::contact_set::ContactSet;
use super::super::linear::inverse::unit_of;
use super::super::operators::RegionOperators;
use crate::fields::norm;

/// Cells that it reaches.
const REACH: usize = 7;
/// Coefficients of a row of neighbours, the last of them zero: one register, or a few.
const WIDTH: usize = 16;

/// An approximate inverse that reaches a few cells, in single precision.
pub struct NearInverse {
    /// Coefficients of the neighbours, row by row from the lowest, in units of `unit`.
    coefficients: [[f32; WIDTH]; 2 * REACH + 1],
    /// Of the coefficients [pressure/length].
    unit: f64,
    /// Displacements of the cells made ready for on the region, with a border that is never in contact; 0 elsewhere.
    field: Vec<f32>,
    /// Columns of that field.
    columns: usize,
    /// Runs of cells along its rows.
    runs: Vec<Range<usize>>,
}

impl NearInverse {
    /// Of that of a region.
    pub fn new(operators: &mut RegionOperators) -> Self {
        let [rows, columns] = operators.region.shape;
        let (mut pulse, mut found) = (vec![0.0; rows * columns], vec![0.0; rows * columns]);
        let middle = rows / 2 * columns + columns / 2;
        pulse[middle] = 1.0;
        operators.preconditioner.normal(&pulse, &mut found);
        let unit = unit_of(found[middle]);
        let mut coefficients = [[0.0; WIDTH]; 2 * REACH + 1];
        for (row, line) in coefficients.iter_mut().enumerate() {
            for (column, coefficient) in line[..2 * REACH + 1].iter_mut().enumerate() {
                let far = [row, column].map(|index| index as f64 - REACH as f64);
                let at = middle + row * columns + column - REACH * (columns + 1);
                *coefficient = (window(far[0].hypot(far[1]) / (REACH + 1) as f64) * found[at] / unit) as f32;
            }
        }
        let columns = columns + WIDTH;
        let field = vec![0.0; (rows + 2 * REACH) * columns + WIDTH];
        Self { coefficients, unit, field, columns, runs: Vec::new() }
    }

    /// Makes ready for cells of the region.
    pub fn begin(&mut self, cells: &ContactSet) {
        let columns = self.columns - WIDTH;
        for run in self.runs.drain(..) {
            self.field[run].fill(0.0);
        }
        for run in cells.runs() {
            let mut first = run.start;
            while first < run.end {
                let row = first / columns;
                let end = run.end.min((row + 1) * columns);
                let start = (row + REACH) * self.columns + REACH + first - row * columns;
                self.runs.push(start..start + end - first);
                first = end;
            }
        }
    }

    /// Pressures that would about remove packed displacements [length] of these cells.
    pub fn apply(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        let Self { coefficients, unit, field, columns, runs } = self;
        let size = unit_of(norm(displacement));
        let (inverse, unit) = (1.0 / size, *unit * size);
        let mut from = displacement.iter();
        for run in &*runs {
            for (to, from) in field[run.clone()].iter_mut().zip(&mut from) {
                *to = (from * inverse) as f32;
            }
        }
        let mut pressure = pressure.iter_mut();
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for at in runs.iter().cloned().flatten() {
                    let mut sums = [0.0_f32; WIDTH];
                    let first = at - REACH * (*columns + 1);
                    for (row, coefficients) in coefficients.iter().enumerate() {
                        let near = &field[first + row * *columns..][..WIDTH];
                        for (sum, (a, b)) in sums.iter_mut().zip(coefficients.iter().zip(near)) {
                            *sum += a * b;
                        }
                    }
                    if let Some(pressure) = pressure.next() {
                        *pressure = unit * f64::from(sums.iter().sum::<f32>());
                    }
                }
            },
        );
    }
}

/// Wendland's function of a distance, 1 at 0, and 0 from 1 on: its spectrum is positive in the plane.
fn window(distance: f64) -> f64 {
    (1.0 - distance).max(0.0).powi(4) * (4.0 * distance + 1.0)
}
