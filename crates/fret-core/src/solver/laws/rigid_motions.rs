//! Rigid tangential motions: shift along x and y, twist about z; which are prescribed and which follow from a resultant.

use super::super::contact_set::ContactSet;
use crate::model::TangentialField;

/// The three rigid tangential motions of the cells in contact: fields (1, 0), (0, 1) and (-y, x) / length.
#[derive(Debug, Clone)]
pub struct RigidMotions {
    /// Rotation field, packed; empty when the bodies do not rotate, which counts as zero.
    pub rotation: TangentialField,
    /// Whether the bodies may rotate.
    pub rotates: bool,
    /// Which motions follow from a prescribed resultant, or from one that falls with the motion.
    pub by_force: [bool; 3],
    /// By how much the resultant falls with the motion [pressure/length]: `sum q . mode + spring x motion = resultant`; 0 of a
    /// resultant that is prescribed.
    pub spring: [f64; 3],
}

/// Where the cells of a region are, and how the bodies may move.
#[derive(Debug, Clone)]
pub struct CellPositions {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Length that makes the rotation field of order one [length].
    pub length: f64,
    rotates: bool,
    /// As in [`RigidMotions`].
    pub by_force: [bool; 3],
    /// As in [`RigidMotions`].
    pub spring: [f64; 3],
}

impl CellPositions {
    /// Positions in a region with cell centres at `x` and `y`; `rotates` when twist may differ from zero.
    pub fn new(x: Vec<f64>, y: Vec<f64>, rotates: bool, by_force: [bool; 3]) -> Self {
        let largest = x.iter().chain(&y).fold(0.0_f64, |most, value| most.max(value.abs()));
        let length = if largest > 0.0 { largest } else { 1.0 };
        Self { x, y, length, rotates, by_force, spring: [0.0; 3] }
    }

    /// The same with springs between the bodies and what is driven.
    #[must_use]
    pub fn with_springs(self, by_force: [bool; 3], spring: [f64; 3]) -> Self {
        Self { by_force, spring, ..self }
    }

    /// Which motions follow from a resultant that is prescribed as it is.
    pub fn held(&self) -> [bool; 3] {
        [0, 1, 2].map(|mode| self.by_force[mode] && self.spring[mode] == 0.0)
    }

    /// The motions of the cells in contact.
    pub fn motions_of(&self, contact: &ContactSet) -> RigidMotions {
        let mut rotation = TangentialField::default();
        if self.rotates {
            rotation = TangentialField::zeros(contact.len());
            for (place, cell) in contact.cells().enumerate() {
                let (x, y) = (self.x[cell / self.y.len()], self.y[cell % self.y.len()]);
                rotation.set(place, [-y / self.length, x / self.length]);
            }
        }
        RigidMotions { rotation, rotates: self.rotates, by_force: self.by_force, spring: self.spring }
    }
}

impl RigidMotions {
    /// Whether any motion follows from a resultant.
    pub fn any_by_force(&self) -> bool {
        self.by_force.iter().any(|&by_force| by_force)
    }

    /// Which motions follow from a resultant that is prescribed as it is.
    pub fn held(&self) -> [bool; 3] {
        [0, 1, 2].map(|mode| self.by_force[mode] && self.spring[mode] == 0.0)
    }

    /// Whether the far end of a spring is prescribed.
    pub fn any_spring(&self) -> bool {
        self.spring != [0.0; 3]
    }

    /// A motion of these amounts at a cell.
    pub fn at(&self, [x, y, turned]: [f64; 3], cell: usize) -> [f64; 2] {
        if !self.rotates {
            return [x, y];
        }
        let around = self.rotation.at(cell);
        [x + turned * around[0], y + turned * around[1]]
    }

    /// Amounts of the motions that follow from a resultant; the others zero.
    pub fn only_by_force(&self, amounts: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|mode| if self.by_force[mode] { amounts[mode] } else { 0.0 })
    }

    /// Solves the symmetric system `[xx, yy, rr, xy, xr, yr]` of the force-controlled modes, others zero; a singular
    /// matrix gets a relative 1e-13 on its diagonal.
    pub fn solve(&self, matrix: [f64; 6], right: [f64; 3]) -> [f64; 3] {
        Self::solve_of(self.by_force, matrix, right)
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
        // Elimination without exchanges: the matrix is a Gram matrix.
        for m in 0..3 {
            for n in m + 1..3 {
                let factor = a[n][m] / a[m][m];
                for l in m..3 {
                    a[n][l] -= factor * a[m][l];
                }
                b[n] -= factor * b[m];
            }
        }
        let mut x = [0.0; 3];
        for m in (0..3).rev() {
            let rest: f64 = (m + 1..3).map(|n| a[m][n] * x[n]).sum();
            x[m] = if a[m][m].abs() > 0.0 { (b[m] - rest) / a[m][m] } else { 0.0 };
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four cells at the corners of a rectangle of 6 by 2.
    fn rectangle(rotates: bool, by_force: [bool; 3]) -> RigidMotions {
        let positions = CellPositions::new(vec![-3.0, 3.0], vec![-1.0, 1.0], rotates, by_force);
        assert_eq!(positions.length, 3.0);
        positions.motions_of(&ContactSet::of(4, |_| true))
    }

    /// The rotation field is `(-y, x)` over the length, of the cells in contact alone.
    #[test]
    fn a_motion_is_shift_and_rotation_about_the_origin() {
        let motions = rectangle(true, [true; 3]);
        // Cells in the order of rows along y: (-3, -1), (-3, 1), (3, -1), (3, 1).
        assert_eq!(motions.at([0.0, 0.0, 3.0], 1), [-1.0, -3.0]);
        assert_eq!(motions.at([10.0, 20.0, 3.0], 2), [11.0, 23.0]);
        let positions = CellPositions::new(vec![-3.0, 3.0], vec![-1.0, 1.0], true, [true; 3]);
        let one = positions.motions_of(&ContactSet::of(4, |cell| cell == 2));
        assert_eq!((one.rotation.x.as_slice(), one.rotation.y.as_slice()), (&[1.0 / 3.0][..], &[1.0][..]));
        // Without rotation its amount does not matter, and there is no field.
        let straight = rectangle(false, [true; 3]);
        assert_eq!(straight.at([1.0, 2.0, 5.0], 3), [1.0, 2.0]);
        assert!(straight.rotation.x.is_empty());
        // A single cell at the origin has no length: one is as good as any.
        assert_eq!(CellPositions::new(vec![0.0], vec![0.0], true, [true; 3]).length, 1.0);
    }

    #[test]
    fn motions_that_are_prescribed_follow_from_no_force() {
        let motions = rectangle(true, [false, true, false]);
        assert!(motions.any_by_force());
        assert!(!rectangle(true, [false; 3]).any_by_force());
        assert_eq!(motions.only_by_force([1.0, 2.0, 3.0]), [0.0, 2.0, 0.0]);
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

    /// A motion whose resultant falls with it follows from a force but is not held at one; without springs all that follow from a
    /// force are held.
    #[test]
    fn springs_take_motions_from_those_that_are_held() {
        let positions = CellPositions::new(vec![-3.0, 3.0], vec![-1.0, 1.0], true, [false; 3]);
        let free = positions.motions_of(&ContactSet::of(4, |_| true));
        assert!(positions.held() == [false; 3] && free.held() == [false; 3] && !free.any_spring());
        let positions = positions.with_springs([true, true, false], [0.0, 2.5, 0.0]);
        let motions = positions.motions_of(&ContactSet::of(4, |_| true));
        assert!(positions.held() == [true, false, false] && motions.held() == [true, false, false]);
        assert_eq!((motions.by_force, motions.spring), ([true, true, false], [0.0, 2.5, 0.0]));
        assert!(motions.any_spring() && positions.length == 3.0);
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
