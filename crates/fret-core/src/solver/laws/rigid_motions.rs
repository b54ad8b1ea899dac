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
    /// Which motions follow from a prescribed resultant.
    pub by_force: [bool; 3],
}

/// Where the cells of a region are, and how the bodies may move.
#[derive(Debug, Clone)]
pub struct CellPositions {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Length that makes the rotation field of order one [length].
    pub length: f64,
    rotates: bool,
    /// Which motions follow from a prescribed resultant.
    pub by_force: [bool; 3],
}

impl CellPositions {
    /// Positions in a region with cell centres at `x` and `y`; `rotates` when twist may differ from zero.
    pub fn new(x: Vec<f64>, y: Vec<f64>, rotates: bool, by_force: [bool; 3]) -> Self {
        let largest = x.iter().chain(&y).fold(0.0_f64, |most, value| most.max(value.abs()));
        let length = if largest > 0.0 { largest } else { 1.0 };
        Self { x, y, length, rotates, by_force }
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
        RigidMotions { rotation, rotates: self.rotates, by_force: self.by_force }
    }
}

impl RigidMotions {
    /// Whether any motion follows from a resultant.
    pub fn any_by_force(&self) -> bool {
        self.by_force.iter().any(|&by_force| by_force)
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
    pub fn solve(&self, [xx, yy, rr, xy, xr, yr]: [f64; 6], right: [f64; 3]) -> [f64; 3] {
        let mut a = [[xx, xy, xr], [xy, yy, yr], [xr, yr, rr]];
        let mut b = right;
        let trace: f64 = (0..3).filter(|&m| self.by_force[m]).map(|m| a[m][m]).sum();
        let shift = trace * 1e-13;
        for m in 0..3 {
            if self.by_force[m] && trace > 0.0 {
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
        // Cholesky: the matrix is a Gram matrix.
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
