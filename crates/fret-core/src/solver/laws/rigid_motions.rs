//! Rigid tangential motions: shift along x and y, twist about z.

use super::super::contact_set::ContactSet;
use super::super::prescribed::TangentialLoads;
use super::super::region::Region;
use crate::fields::solved;
use crate::model::TangentialField;

/// The three rigid tangential motions of the cells in contact: fields (1, 0), (0, 1) and (-y, x) / length.
#[derive(Debug, Clone)]
pub struct RigidMotions {
    /// Rotation field, packed; empty when the bodies do not rotate, which counts as zero.
    pub rotation: TangentialField,
    /// Whether the bodies may rotate.
    pub rotates: bool,
    /// What is prescribed of them.
    pub loads: TangentialLoads,
}

/// Where the cells of a region are, and how the bodies may move.
#[derive(Debug, Clone)]
pub struct CellPositions {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Where the bodies rotate about [length].
    pole: [f64; 2],
    /// Length that makes the rotation field of order one [length].
    pub length: f64,
    rotates: bool,
}

impl CellPositions {
    /// Positions in a region with cell centres at `x` and `y`; `rotates` when twist may differ from zero.
    pub fn new(x: Vec<f64>, y: Vec<f64>, rotates: bool) -> Self {
        let largest = x.iter().chain(&y).fold(0.0_f64, |most, value| most.max(value.abs()));
        let length = if largest > 0.0 { largest } else { 1.0 };
        Self { x, y, pole: [0.0; 2], length, rotates }
    }

    /// The same of bodies that rotate about a place [length].
    pub fn about(self, pole: [f64; 2]) -> Self {
        Self { pole, ..self }
    }

    /// Where they rotate about [length].
    pub fn pole(&self) -> [f64; 2] {
        self.pole
    }

    /// Those of cells twice as wide; the motions keep their units.
    pub fn coarser(&self) -> Self {
        let pairs = |centres: &[f64]| -> Vec<f64> {
            centres.chunks(2).map(|pair| 0.5 * (pair[0] + pair[pair.len() - 1])).collect()
        };
        Self { x: pairs(&self.x), y: pairs(&self.y), ..*self }
    }

    /// Place of a cell along x and y, over the length.
    pub fn place(&self, cell: usize) -> [f64; 2] {
        [self.x[cell / self.y.len()] / self.length, self.y[cell % self.y.len()] / self.length]
    }

    /// Those of a region of the cells.
    pub fn of_region(&self, region: Region) -> Self {
        let part = |axis: usize, all: &[f64]| {
            all[region.origin[axis]..region.origin[axis] + region.shape[axis]].to_vec()
        };
        Self { x: part(0, &self.x), y: part(1, &self.y), ..*self }
    }

    /// How many cells there are along x and y.
    pub fn shape(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// The motions of the cells in contact, with what is prescribed of them.
    pub fn motions_of(&self, contact: &ContactSet, loads: TangentialLoads) -> RigidMotions {
        let mut rotation = TangentialField::default();
        let [pole_x, pole_y] = self.pole;
        if self.rotates {
            rotation = TangentialField::zeros(contact.len());
            for (place, cell) in contact.cells().enumerate() {
                let (x, y) = (self.x[cell / self.y.len()] - pole_x, self.y[cell % self.y.len()] - pole_y);
                rotation.set(place, [-y / self.length, x / self.length]);
            }
        }
        RigidMotions { rotation, rotates: self.rotates, loads }
    }
}

impl RigidMotions {
    /// A motion of these amounts at a cell.
    pub fn at(&self, [x, y, turned]: [f64; 3], cell: usize) -> [f64; 2] {
        if !self.rotates {
            return [x, y];
        }
        let around = self.rotation.at(cell);
        [x + turned * around[0], y + turned * around[1]]
    }

    /// All three motions, a unit of each, at a cell.
    pub fn modes(&self, cell: usize) -> [[f64; 2]; 3] {
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| self.at(unit, cell))
    }

    /// Solves the symmetric system `[xx, yy, rr, xy, xr, yr]` of the force-controlled modes, others zero; a singular
    /// matrix gets a relative 1e-13 on its diagonal.
    pub fn solve(&self, matrix: [f64; 6], right: [f64; 3]) -> [f64; 3] {
        Self::solve_of(self.loads.by_force, matrix, right)
    }

    /// The same of some modes.
    pub fn solve_of(modes: [bool; 3], [xx, yy, rr, xy, xr, yr]: [f64; 6], right: [f64; 3]) -> [f64; 3] {
        let mut a = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
        let mut b = right;
        let trace: f64 = (0..3).filter(|&m| modes[m]).map(|m| a[m][m]).sum();
        let shift = trace * 1e-13;
        for m in 0..3 {
            if modes[m] && trace > 0.0 {
                a[m][m] += shift;
            } else {
                for n in 0..3 {
                    a[m][n] = 0.0;
                    a[n][m] = 0.0;
                }
                a[m][m] = 1.0;
                b[m] = 0.0;
            }
        }
        solved(a, b, 0.0)
    }
}

/// Length of a vector of motions or resultants.
pub fn size(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four cells at the corners of a rectangle of 6 by 2.
    fn rectangle(rotates: bool, by_force: [bool; 3]) -> RigidMotions {
        let positions = CellPositions::new(vec![-3.0, 3.0], vec![-1.0, 1.0], rotates);
        assert_eq!(positions.length, 3.0);
        let loads = TangentialLoads { by_force, ..TangentialLoads::default() };
        positions.motions_of(&ContactSet::of(4, |_| true), loads)
    }

    /// The rotation field is `(-y, x)` over the length, of the cells in contact alone.
    #[test]
    fn a_motion_is_shift_and_rotation_about_the_origin() {
        let motions = rectangle(true, [true; 3]);
        // Cells in the order of rows along y: (-3, -1), (-3, 1), (3, -1), (3, 1).
        assert_eq!(motions.at([0.0, 0.0, 3.0], 1), [-1.0, -3.0]);
        assert_eq!(motions.at([10.0, 20.0, 3.0], 2), [11.0, 23.0]);
        let positions = CellPositions::new(vec![-3.0, 3.0], vec![-1.0, 1.0], true);
        let one = positions.motions_of(&ContactSet::of(4, |cell| cell == 2), TangentialLoads::default());
        assert_eq!((one.rotation.x.as_slice(), one.rotation.y.as_slice()), (&[1.0 / 3.0][..], &[1.0][..]));
        // Without rotation its amount does not matter, and there is no field.
        let straight = rectangle(false, [true; 3]);
        assert_eq!(straight.at([1.0, 2.0, 5.0], 3), [1.0, 2.0]);
        assert!(straight.rotation.x.is_empty());
        // A single cell at the origin has no length: one is as good as any.
        assert_eq!(CellPositions::new(vec![0.0], vec![0.0], true).length, 1.0);
    }

    /// A Gram matrix times known amounts: the amounts come back, those of prescribed motions as zero.
    #[test]
    fn amounts_that_make_known_resultants_are_found() {
        // A^T A of A = [[2, 1, 0], [0, 3, 1], [1, 0, 4]].
        let gram = [[5.0, 2.0, 4.0], [2.0, 10.0, 3.0], [4.0, 3.0, 17.0]];
        let packed = [5.0, 10.0, 17.0, 2.0, 4.0, 3.0];
        let amounts = [0.5, -2.0, 3.0];
        let right = gram.map(|row| (0..3).map(|n| row[n] * amounts[n]).sum::<f64>());
        let found = rectangle(true, [true; 3]).solve(packed, right);
        for (found, known) in found.iter().zip(amounts) {
            // The diagonal has a relative 1e-13 more; the inverse's norm is below one.
            assert!((found - known).abs() < 1e-11, "{found} {known}");
        }
        // With x prescribed: [[10, 3], [3, 17]] (y, r) = (1, 2) has y = 11 / 161, r = 17 / 161.
        let found = rectangle(true, [false, true, true]).solve(packed, [7.0, 1.0, 2.0]);
        assert_eq!(found[0], 0.0);
        assert!((found[1] - 11.0 / 161.0).abs() < 1e-12 && (found[2] - 17.0 / 161.0).abs() < 1e-12);
        // Nothing to hold the contact: nothing moves.
        assert_eq!(rectangle(true, [true; 3]).solve([0.0; 6], [1.0, 2.0, 3.0]), [0.0; 3]);
    }

    /// A singular matrix (two cells beside each other on the axis of rotation's radius) still has finite amounts that make the force.
    #[test]
    fn a_singular_matrix_has_finite_amounts() {
        let found =
            rectangle(true, [true, true, false]).solve([1.0, 1.0, 0.0, 1.0, 0.0, 0.0], [2.0, 2.0, 0.0]);
        // x + y = 2 to the part in 1e-13 that makes it solvable.
        assert!((found[0] + found[1] - 2.0).abs() < 1e-9 && found[0].abs() < 10.0, "{found:?}");
    }

    /// What makes a singular matrix solvable is added to its diagonal, not taken off: the amounts of a force that it makes stay on its
    /// side, and of two equal motions each takes half.
    #[test]
    fn two_motions_that_are_one_share_the_amount() {
        let found =
            RigidMotions::solve_of([true, true, false], [1.0, 1.0, 0.0, 1.0, 0.0, 0.0], [2.0, 2.0, 0.0]);
        // 1 / (1 + 1e-13 trace / 4), rounded on a diagonal of 1 that lost its digits down to 1e-13.
        assert!((found[0] - 1.0).abs() < 1e-2 && (found[1] - 1.0).abs() < 1e-2, "{found:?}");
        let against =
            RigidMotions::solve_of([true, true, false], [1.0, 1.0, 0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        assert!(against[0] > 1e11 && against[1] < -1e11, "{against:?}");
    }
}
