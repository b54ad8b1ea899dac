//! Displacements by pressures far away, from a grid twice as coarse: pressures are carried to it by cubic interpolation turned round, displaced
//! there, and displacements interpolated back (two grids of the multilevel summation of Brandt & Lubrecht 1990).

use fret_fft::{Block, Convolution, Kernel, Parity, PeriodicProduct, SingleProduct, Symbol, good_length};
use ndarray::{Array2, ArrayView2};

use crate::compliance::{NORMAL_BLOCKS, SharedWorkspace};
use crate::fields::{norm, unit_of};
use crate::solver::contact_set::ContactSet;

const BLOCKS: [Block; 1] = NORMAL_BLOCKS;
/// Points of the coarse grid before the first one that lies on a cell, for interpolation, and behind the last.
const BEFORE: usize = 1;
const BEHIND: usize = 2;

/// Coarse points that a cell of even or odd index is interpolated from: the first, from the one of half the index, and weights.
const EVEN: (isize, &[f64]) = (0, &[1.0]);
const ODD: (isize, &[f64]) = (-1, &[-0.0625, 0.5625, 0.5625, -0.0625]);

/// Coarse points of a cell with an index of this parity.
fn points(parity: usize) -> (isize, &'static [f64]) {
    if parity == 0 { EVEN } else { ODD }
}

/// The coarse grid of a region.
pub struct FarField {
    product: SingleProduct,
    /// Cells of the region and points of the product along each axis.
    shape: [usize; 2],
    points: [usize; 2],
    periodic: bool,
    /// Fields of the points with those beyond the ends, before and after the product.
    wide: [usize; 2],
    before: Vec<f32>,
    after: Vec<f32>,
    cells: Vec<[u32; 2]>,
}

impl FarField {
    /// Of the response of a region of even sides, by the displacement `kernel` of every cell under a unit of pressure in the first one [length/pressure].
    pub fn new(kernel: &ArrayView2<'_, f64>, periodic: bool) -> Option<Self> {
        let shape: [usize; 2] = kernel.dim().into();
        let wide = shape.map(|cells| cells / 2 + BEFORE + BEHIND);
        let points = if periodic { shape.map(|cells| cells / 2) } else { wide.map(good_length) };
        // Beyond the last offset that the region has there is hardly a cell.
        let at = |index: usize, axis: usize| (2 * index).min(shape[axis] - 2);
        let coarse = Array2::from_shape_fn(points, |(i, j)| kernel[[at(i, 0), at(j, 1)]]);
        let kernel = Kernel { values: coarse.view(), parity: Parity::EvenEven };
        let product = if periodic {
            let symbol = PeriodicProduct::symbol_of(points, &kernel);
            let symbol = Symbol { values: symbol.view(), parity: Parity::EvenEven };
            PeriodicProduct::new(points, &[symbol], &BLOCKS).ok()?.in_single_precision()?
        } else {
            Convolution::new(points, &[kernel], &BLOCKS).ok()?.in_single_precision()?
        };
        let field = vec![0.0; if periodic { wide[0] * wide[1] } else { points[0] * points[1] }];
        let wide = if periodic { wide } else { points };
        Some(Self {
            product,
            shape,
            points,
            periodic,
            wide,
            before: field.clone(),
            after: field,
            cells: Vec::new(),
        })
    }

    /// What this grid makes of a unit of pressure in a cell of this parity, in one at an `offset` from it whose own parity follows.
    pub fn between(kernel: &ArrayView2<'_, f64>, parity: [usize; 2], offset: [isize; 2]) -> f64 {
        let other = [0, 1].map(|axis| parity[axis] as isize + offset[axis]);
        let along = |axis: usize| -> Vec<(usize, f64)> {
            let (first, weights) = points(parity[axis]);
            let (other_first, other_weights) = points(other[axis].rem_euclid(2) as usize);
            let apart = other[axis].div_euclid(2) + other_first - first;
            let pairs = weights.iter().enumerate().flat_map(|(a, weight)| {
                other_weights.iter().enumerate().map(move |(b, other)| {
                    ((apart + b as isize - a as isize).unsigned_abs() * 2, weight * other)
                })
            });
            pairs.collect()
        };
        let (rows, columns) = (along(0), along(1));
        rows.iter().map(|(i, a)| columns.iter().map(|(j, b)| a * b * kernel[[*i, *j]]).sum::<f64>()).sum()
    }

    /// Points that a product works on, as a fraction of the cells of the region.
    pub fn share(&self) -> f64 {
        (self.points[0] * self.points[1]) as f64 / (self.shape[0] * self.shape[1]) as f64
    }

    /// Makes ready for a set of cells.
    pub fn begin(&mut self, cells: &ContactSet) {
        let columns = self.shape[1];
        self.cells.clear();
        self.cells.extend(cells.cells().map(|cell| [(cell / columns) as u32, (cell % columns) as u32]));
    }

    /// Adds the displacements [length] of packed pressures.
    pub fn add(&mut self, pressure: &[f64], displacement: &mut [f64], workspace: &SharedWorkspace) {
        let Self { product, before, after, cells, wide, .. } = self;
        let unit = unit_of(norm(pressure));
        before.fill(0.0);
        for (cell, pressure) in cells.iter().zip(pressure) {
            let scaled = pressure / unit;
            each_point(*cell, wide[1], |at, weight| before[at] += (weight * scaled) as f32);
        }
        if self.periodic {
            fold(before, *wide, self.points);
            let inside = self.points[0] * self.points[1];
            let (from, to) = (&before[..inside], &mut after[..inside]);
            workspace.lend(|workspace| product.apply(workspace, &[from], &mut [to]));
            unfold(after, *wide, self.points);
        } else {
            workspace.lend(|workspace| product.apply(workspace, &[before], &mut [after]));
        }
        let unit = unit * product.unit();
        for (cell, displacement) in cells.iter().zip(displacement) {
            let mut sum = 0.0;
            each_point(*cell, wide[1], |at, weight| sum += weight * f64::from(after[at]));
            *displacement += unit * sum;
        }
    }
}

/// Calls for every coarse point of a cell with its place in a field of so many columns, and its weight.
#[inline(always)]
fn each_point(cell: [u32; 2], columns: usize, mut work: impl FnMut(usize, f64)) {
    let [(row, rows), (column, along)] = cell.map(|index| {
        let (first, weights) = points(index as usize % 2);
        ((index as usize / 2 + BEFORE).wrapping_add_signed(first), weights)
    });
    for (i, a) in rows.iter().enumerate() {
        for (j, b) in along.iter().enumerate() {
            work((row + i) * columns + column + j, a * b);
        }
    }
}

/// Adds the points beyond the ends of a period to those inside, which then fill the front of the field.
fn fold(field: &mut [f32], [rows, columns]: [usize; 2], [nx, ny]: [usize; 2]) {
    let inside = |index: usize, count: usize| (index + count - BEFORE) % count;
    for row in 0..rows {
        for column in (0..BEFORE).chain(columns - BEHIND..columns) {
            let from = std::mem::take(&mut field[row * columns + column]);
            field[row * columns + BEFORE + inside(column, ny)] += from;
        }
    }
    for row in (0..BEFORE).chain(rows - BEHIND..rows) {
        let to = BEFORE + inside(row, nx);
        for column in 0..columns {
            let from = std::mem::take(&mut field[row * columns + column]);
            field[to * columns + column] += from;
        }
    }
    for row in 0..nx {
        let first = (row + BEFORE) * columns + BEFORE;
        field.copy_within(first..first + ny, row * ny);
    }
}

/// Spreads a period from the front of the field, and repeats it beyond its ends.
fn unfold(field: &mut [f32], [rows, columns]: [usize; 2], [nx, ny]: [usize; 2]) {
    for row in (0..nx).rev() {
        field.copy_within(row * ny..(row + 1) * ny, (row + BEFORE) * columns + BEFORE);
    }
    let inside = |index: usize, count: usize| BEFORE + (index + count - BEFORE) % count;
    for line in field.chunks_exact_mut(columns).skip(BEFORE).take(nx) {
        for column in (0..BEFORE).chain(columns - BEHIND..columns) {
            line[column] = line[inside(column, ny)];
        }
    }
    for row in (0..BEFORE).chain(rows - BEHIND..rows) {
        let from = inside(row, nx) * columns;
        field.copy_within(from..from + columns, row * columns);
    }
}
