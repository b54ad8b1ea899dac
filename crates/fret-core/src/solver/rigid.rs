//! Rigid tangential motions: shift along x and y, twist about z; which are prescribed and which follow from a force.

use crate::model::field::TangentialField;

/// The three rigid tangential motions of a box: fields (1, 0), (0, 1) and (-y, x) / length.
#[derive(Debug, Clone)]
pub struct RigidModes {
    /// Rotation field, kept only when the bodies may rotate.
    rotation: Option<TangentialField>,
    /// Length that makes the rotation field of order one [length].
    pub length: f64,
    /// Which motions follow from a prescribed resultant.
    pub by_force: [bool; 3],
}

impl RigidModes {
    /// Modes of a box with cell centres at `x` and `y`; `rotates` when twist may differ from zero.
    pub fn new(x: &[f64], y: &[f64], rotates: bool, by_force: [bool; 3]) -> Self {
        let largest = x.iter().chain(y).fold(0.0_f64, |most, value| most.max(value.abs()));
        let length = if largest > 0.0 { largest } else { 1.0 };
        let rotation = rotates.then(|| {
            let mut field = TangentialField::zeros(x.len() * y.len());
            for (i, &xi) in x.iter().enumerate() {
                for (j, &yj) in y.iter().enumerate() {
                    field.set(i * y.len() + j, [-yj / length, xi / length]);
                }
            }
            field
        });
        Self { rotation, length, by_force }
    }

    /// Displacement of a cell under amounts of the three motions.
    #[inline]
    pub fn displacement(&self, amounts: &[f64; 3], cell: usize) -> [f64; 2] {
        match &self.rotation {
            None => [amounts[0], amounts[1]],
            Some(field) => [amounts[0] + amounts[2] * field.x[cell], amounts[1] + amounts[2] * field.y[cell]],
        }
    }

    /// Products of a vector at a cell with the three mode fields.
    #[inline]
    pub fn products(&self, vector: [f64; 2], cell: usize) -> [f64; 3] {
        match &self.rotation {
            None => [vector[0], vector[1], 0.0],
            Some(field) => [vector[0], vector[1], vector[0] * field.x[cell] + vector[1] * field.y[cell]],
        }
    }

    /// Value of mode `mode` at a cell.
    #[inline]
    pub fn mode(&self, mode: usize, cell: usize) -> [f64; 2] {
        match (mode, &self.rotation) {
            (0, _) => [1.0, 0.0],
            (1, _) => [0.0, 1.0],
            (_, Some(field)) => field.at(cell),
            (_, None) => [0.0, 0.0],
        }
    }

    /// Whether any motion follows from a resultant.
    pub fn any_by_force(&self) -> bool {
        self.by_force.iter().any(|&by_force| by_force)
    }

    /// Solves the symmetric system of the force-controlled modes, others zero; a singular matrix gets a relative 1e-13 on its diagonal.
    pub fn solve(&self, matrix: &[[f64; 3]; 3], right: &[f64; 3]) -> [f64; 3] {
        let mut a = *matrix;
        let mut b = *right;
        let trace: f64 = (0..3).filter(|&m| self.by_force[m]).map(|m| matrix[m][m]).sum();
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
