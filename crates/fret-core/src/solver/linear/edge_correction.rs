//! What a circulant inverse of the response to pressure misses at the edge of contact. On all cells of a region it is the inverse of a circulant
//! response; cut off at the contact it is not, and under a stiff coating, which spreads what a cell is pressed by over many others, what it leaves
//! over is large along the edge. There the circulant response, summed over groups of cells of the edge, is inverted as a dense matrix, and the
//! remainder taken off: a coarse correction on the edge after the circulant inverse (a multiplicative Schwarz method, Smith, Bjorstad & Gropp 1996).

use std::collections::BTreeMap;

use super::super::contact_set::ContactSet;
use super::inverse::{FieldsOfRegion, Inverse};
use crate::compliance::SharedWorkspace;
use crate::fields::Number;

/// Groups at the most: squares of cells of the edge, larger ones where there are more cells.
const MOST_GROUPS: usize = 128;
/// Added to the diagonal, relative to its mean: a uniform pressure in a period displaces nothing.
const SHIFT: f64 = 1e-12;

/// A correction on the edge of a contact.
pub struct EdgeCorrection {
    /// The circulant response, on the cells of the region.
    forward: Inverse,
    /// The displacement at every offset by a unit of pressure, cells of the region with what lies behind its mirrors [length/pressure].
    kernel: Vec<f64>,
    /// Cells of that, and of the part in front of the mirrors.
    whole: [usize; 2],
    part: [usize; 2],
    mirrored: [bool; 2],
    /// Whether the region is a period: beyond a side that is no mirror lies the other one, and a mirror has another one on the other side.
    repeats: bool,
    /// The contact that it is ready for.
    contact: ContactSet,
    /// Places of the cells of its edge, and their groups.
    edge: Vec<(usize, usize)>,
    /// Lower triangle of the Cholesky factor of the response of the groups, row by row.
    factor: Vec<Vec<f64>>,
}

impl EdgeCorrection {
    /// Of the circulant response and its kernel, on a region whose `part` in front of its mirrors is worked on, and which `repeats` or does not.
    pub fn new(
        forward: Inverse,
        kernel: Vec<f64>,
        [whole, part]: [[usize; 2]; 2],
        (mirrored, repeats): ([bool; 2], bool),
    ) -> Self {
        let (contact, edge, factor) = (ContactSet::default(), Vec::new(), Vec::new());
        Self { forward, kernel, whole, part, mirrored, repeats, contact, edge, factor }
    }

    /// Makes ready for a contact.
    pub fn prepare(&mut self, contact: &ContactSet) {
        if self.contact == *contact {
            return;
        }
        self.contact.clone_from(contact);
        let cells = self.edge_of(contact);
        let columns = self.part[1];
        let mut side = 1;
        let groups = loop {
            let mut groups = BTreeMap::new();
            for (_, cell) in &cells {
                let next = groups.len();
                groups.entry((cell / columns / side, cell % columns / side)).or_insert(next);
            }
            if groups.len() <= MOST_GROUPS {
                break groups;
            }
            side *= 2;
        };
        let group = |cell: usize| groups[&(cell / columns / side, cell % columns / side)];
        self.edge = cells.iter().map(|(place, cell)| (*place, group(*cell))).collect();
        let mut matrix = vec![vec![0.0; groups.len()]; groups.len()];
        for ((_, to), (_, row)) in cells.iter().zip(&self.edge) {
            for ((_, from), (_, column)) in cells.iter().zip(&self.edge) {
                if column <= row {
                    matrix[*row][*column] += self.influence(*to, *from);
                }
            }
        }
        self.factor = factorised(matrix);
    }

    /// Places and cells of the edge: those with a neighbour out of contact.
    fn edge_of(&self, contact: &ContactSet) -> Vec<(usize, usize)> {
        let [rows, columns] = self.part;
        let mut inside = vec![false; rows * columns];
        contact.cells().for_each(|cell| inside[cell] = true);
        // Behind a mirror lies the cell itself; beyond a side that is none the other one of a period, or nothing.
        let is_open = |cell: usize, axis: usize, up: bool| {
            let (index, stride) = if axis == 0 { (cell / columns, columns) } else { (cell % columns, 1) };
            let round = (self.part[axis] - 1) * stride;
            match (up, index) {
                (false, 0) if self.mirrored[axis] => false,
                (false, 0) => !(self.repeats && inside[cell + round]),
                (true, last) if last + 1 == self.part[axis] && self.mirrored[axis] => !self.repeats,
                (true, last) if last + 1 == self.part[axis] => !(self.repeats && inside[cell - round]),
                (false, _) => !inside[cell - stride],
                (true, _) => !inside[cell + stride],
            }
        };
        let at_edge = |cell: usize| {
            (0..2)
                .any(|axis| self.part[axis] > 1 && (is_open(cell, axis, false) || is_open(cell, axis, true)))
        };
        contact.cells().enumerate().filter(|(_, cell)| at_edge(*cell)).collect()
    }

    /// Displacement of a cell by a unit of pressure on another one and its mirror images [length/pressure].
    fn influence(&self, to: usize, from: usize) -> f64 {
        let columns = self.part[1];
        let offsets = |axis: usize, to: usize, from: usize| {
            let whole = self.whole[axis];
            let straight = to.abs_diff(from);
            [Some(straight), self.mirrored[axis].then(|| (to + from + 1) % whole)]
        };
        let along_x = offsets(0, to / columns, from / columns);
        let along_y = offsets(1, to % columns, from % columns);
        let pairs =
            along_x.into_iter().flatten().flat_map(|x| along_y.into_iter().flatten().map(move |y| [x, y]));
        pairs.map(|[x, y]| self.kernel[x * self.whole[1] + y]).sum()
    }

    /// Adds to the `pressure` that the circulant inverse makes of displacements `right`, packed over the contact prepared last, what it misses
    /// at the edge. `compliance`: unit of displacements over that of pressure [length/pressure].
    pub fn add<N: Number>(
        &self,
        right: &[N],
        pressure: &mut [N],
        compliance: f64,
        (fields, workspace): (&mut FieldsOfRegion, &SharedWorkspace),
    ) {
        if self.factor.is_empty() {
            return;
        }
        let mut image = vec![N::default(); right.len()];
        self.forward.apply(&[&*pressure], &mut [&mut image], 1.0 / compliance, (fields, workspace));
        let mut left = vec![0.0; self.factor.len()];
        for (place, group) in &self.edge {
            left[*group] += right[*place].to_double(compliance) - image[*place].to_double(compliance);
        }
        solve(&self.factor, &mut left);
        for (place, group) in &self.edge {
            pressure[*place] = N::of(pressure[*place].to_double(1.0) + left[*group], 1.0);
        }
    }
}

/// Cholesky factor of a symmetric matrix, of which the lower triangle is read; empty where it is not positive.
fn factorised(mut matrix: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let count = matrix.len();
    let trace: f64 = (0..count).map(|k| matrix[k][k]).sum();
    for column in 0..count {
        matrix[column][column] += SHIFT * trace / count as f64;
        for row in column..count {
            let known: f64 = (0..column).map(|k| matrix[row][k] * matrix[column][k]).sum();
            let left = matrix[row][column] - known;
            if row > column {
                matrix[row][column] = left / matrix[column][column];
            } else if left > 0.0 {
                matrix[row][row] = left.sqrt();
            } else {
                return Vec::new();
            }
        }
    }
    matrix
}

/// Solves for a right side in its place.
fn solve(factor: &[Vec<f64>], right: &mut [f64]) {
    for row in 0..right.len() {
        let known: f64 = (0..row).map(|k| factor[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / factor[row][row];
    }
    for row in (0..right.len()).rev() {
        let known: f64 = (row + 1..right.len()).map(|k| factor[k][row] * right[k]).sum();
        right[row] = (right[row] - known) / factor[row][row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::{NORMAL_BLOCKS, mirrors};
    use crate::model::Symmetry;
    use fret_fft::{Parity, PeriodicProduct, Symbol};
    use ndarray::Array2;

    /// A response that falls with the wavenumber as that of a bent film does, on a whole region.
    fn symbol(whole: [usize; 2]) -> Array2<f64> {
        Array2::from_shape_fn(whole.map(|count| count / 2 + 1), |(a, b)| {
            1.0 / (0.05 + (a as f64 / whole[0] as f64).powi(2) + (b as f64 / whole[1] as f64).powi(2))
        })
    }

    /// The correction in a part of a region, and the response of the part as a plain matrix, by the product of the whole.
    fn tested(symmetry: Symmetry, part: [usize; 2], single: bool) -> (EdgeCorrection, Vec<Vec<f64>>) {
        let whole = symmetry.whole_of(part);
        let values = symbol(whole);
        let symbol = Symbol { values: values.view(), parity: Parity::EvenEven };
        let product =
            PeriodicProduct::mirrored(part, &[symbol], &NORMAL_BLOCKS, mirrors(symmetry, &[0])).unwrap();
        let columns: Vec<Vec<f64>> = (0..part[0] * part[1])
            .map(|cell| {
                let (mut unit, mut column) = (vec![0.0; part[0] * part[1]], vec![0.0; part[0] * part[1]]);
                unit[cell] = 1.0;
                product.apply(&mut product.workspace(), &[&unit], &mut [&mut column]);
                column
            })
            .collect();
        let plain = PeriodicProduct::new(whole, &[symbol], &NORMAL_BLOCKS).unwrap();
        let (mut unit, mut kernel) = (vec![0.0; whole[0] * whole[1]], vec![0.0; whole[0] * whole[1]]);
        unit[0] = 1.0;
        plain.apply(&mut plain.workspace(), &[&unit], &mut [&mut kernel]);
        (
            EdgeCorrection::new(
                Inverse::new(product, single),
                kernel,
                [whole, part],
                (symmetry.axes(), false),
            ),
            columns,
        )
    }

    /// Where every cell of the edge is a group of its own nothing is left over there, with and without mirrors, in either precision and any
    /// unit; elsewhere pressure stays as it is.
    #[test]
    fn nothing_is_left_over_along_the_edge() {
        let part = [12, 10];
        for (symmetry, single, rounding) in [
            (Symmetry::NONE, false, 1e-9),
            (Symmetry::NONE, true, 1e-3),
            (Symmetry { odd_shear: [Some(0), None] }, false, 1e-9),
            (Symmetry { odd_shear: [Some(0), Some(1)] }, false, 1e-9),
        ] {
            let (mut correction, columns) = tested(symmetry, part, single);
            let axes = symmetry.axes();
            let from = |axis: usize| if axes[axis] { 0.0 } else { 0.5 * part[axis] as f64 };
            let contact = ContactSet::of(120, |cell| {
                ((cell / 10) as f64 + 0.5 - from(0)).powi(2) + ((cell % 10) as f64 + 0.5 - from(1)).powi(2)
                    < 18.0
            });
            correction.prepare(&contact);
            let right: Vec<f64> = (0..contact.len()).map(|cell| 1.0 + (0.7 * cell as f64).sin()).collect();
            let given: Vec<f64> = (0..contact.len()).map(|cell| 0.02 * (0.3 * cell as f64).cos()).collect();
            let (mut fields, workspace) = (FieldsOfRegion::default(), SharedWorkspace::default());
            fields.begin(&contact, 120);
            let unit = 4.0;
            let mut pressure: Vec<f64> = given.iter().map(|p| unit * p).collect();
            correction.add(&right, &mut pressure, unit, (&mut fields, &workspace));
            let cells: Vec<usize> = contact.cells().collect();
            let edge: Vec<usize> = correction.edge.iter().map(|(place, _)| *place).collect();
            assert!(edge.len() > 3 && edge.len() < contact.len(), "{} of {}", edge.len(), contact.len());
            for (place, cell) in cells.iter().enumerate() {
                let moved: f64 =
                    cells.iter().zip(&pressure).map(|(from, p)| columns[*from][*cell] * p / unit).sum();
                if edge.contains(&place) {
                    // The condition of a few dozen cells, and single precision's digits.
                    assert!(
                        (moved - right[place]).abs() < rounding,
                        "{axes:?} {cell}: {moved} {}",
                        right[place]
                    );
                } else {
                    assert_eq!(pressure[place], unit * given[place]);
                }
            }
        }
    }

    /// A contact all across a period has its edges along it alone, wherever the period is cut, and in front of its mirrors.
    #[test]
    fn the_seam_of_a_period_is_no_edge() {
        let edges = |symmetry: Symmetry, rows: std::ops::Range<usize>| {
            let (correction, _) = tested(symmetry, [12, 4], false);
            let mut correction = EdgeCorrection { repeats: true, ..correction };
            correction.prepare(&ContactSet::of(48, |cell| rows.contains(&((cell / 4 + 5) % 12))));
            correction.edge.len()
        };
        for begin in 0..5 {
            assert_eq!(edges(Symmetry::NONE, begin..begin + 7), 8);
        }
        let mirrored = Symmetry { odd_shear: [Some(0), Some(1)] };
        assert_eq!([edges(mirrored, 5..9), edges(mirrored, 0..12)], [4, 0]);
        assert_eq!(edges(Symmetry::NONE, 0..12), 0);
    }

    /// Long edges are put together in squares; a matrix that is not positive corrects nothing.
    #[test]
    fn there_are_no_more_groups_than_are_factorised() {
        let (mut correction, _) = tested(Symmetry::NONE, [40, 40], false);
        correction.prepare(&ContactSet::of(1600, |cell| (cell / 40 + cell % 40) % 3 > 0));
        assert!(correction.edge.len() > 1000 && correction.factor.len() <= MOST_GROUPS);
        assert!(correction.factor.len() > MOST_GROUPS / 4);
        assert!(factorised(vec![vec![1.0, 0.0], vec![2.0, 1.0]]).is_empty());
        // [[4, 2], [2, 5]] x = (8, 12): x = (1, 2).
        let mut right = vec![8.0, 12.0];
        solve(&factorised(vec![vec![4.0, 0.0], vec![2.0, 5.0]]), &mut right);
        assert!((right[0] - 1.0).abs() < 1e-11 && (right[1] - 2.0).abs() < 1e-11, "{right:?}");
    }
}
