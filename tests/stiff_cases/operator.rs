//! The elastic operator of a scene as a matrix on a few cells: is it symmetric, is it positive?

use fret_core::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance, SurfaceResponse};
use fret_core::kernel::{Components, influence_coefficients, periodic_symbols};
use fret_core::model::ContactPair;
use fret_fft::ConvolutionError;

/// Cells a side.
const SIDE: usize = 8;

/// What the matrix shows; both relative to its diagonal.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// Largest difference of an entry to its mirror image.
    pub asymmetry: f64,
    /// Smallest pivot of its factors: positive where the matrix is.
    pub pivot: f64,
}

/// All displacements from all tractions of a pair on cells of this spacing. A scene that repeats does not move under a uniform
/// traction: such a motion is added, so that what is judged is the rest.
pub fn shown(pair: &ContactPair, spacing: [f64; 2], periodic: bool) -> Result<Shown, ConvolutionError> {
    let shape = [SIDE; 2];
    let response = if periodic {
        SurfaceResponse::Periodic(periodic_symbols(pair, shape, spacing, Components::ALL, 0))
    } else {
        SurfaceResponse::FreeSpace(influence_coefficients(pair, shape, spacing, Components::ALL))
    };
    let wanted = OperatorSet { full: true, ..OperatorSet::default() };
    let mut compliance = SpectralCompliance::new(&response, shape, wanted)?;
    let cells = SIDE * SIDE;
    let mut matrix: Vec<Vec<f64>> = Vec::with_capacity(3 * cells);
    for column in 0..3 * cells {
        let mut traction = vec![0.0; 3 * cells];
        traction[column] = 1.0;
        let mut displacement = vec![0.0; 3 * cells];
        let (pressure, [x, y]) = (&traction[..cells], [1, 2].map(|part| &traction[part * cells..][..cells]));
        let (normal, tangential) = displacement.split_at_mut(cells);
        let (to_x, to_y) = tangential.split_at_mut(cells);
        compliance.full([pressure, x, y], [normal, to_x, to_y]);
        matrix.push(displacement);
    }
    if periodic {
        for part in 0..3 {
            let own = matrix[part * cells][part * cells];
            for i in 0..cells {
                for j in 0..cells {
                    matrix[part * cells + i][part * cells + j] += own;
                }
            }
        }
    }
    let scale: Vec<f64> = (0..3 * cells).map(|i| matrix[i][i].sqrt()).collect();
    let mut asymmetry = 0.0_f64;
    for i in 0..3 * cells {
        for j in 0..3 * cells {
            matrix[i][j] /= scale[i] * scale[j];
        }
    }
    for i in 0..3 * cells {
        for j in 0..i {
            let off = (matrix[i][j] - matrix[j][i]).abs();
            asymmetry = if off.is_nan() { f64::INFINITY } else { asymmetry.max(off) };
        }
    }
    Ok(Shown { asymmetry, pivot: smallest_pivot(matrix) })
}

/// Smallest pivot of a symmetric matrix of unit diagonal by Cholesky's factors; the first that is not positive ends it.
fn smallest_pivot(mut matrix: Vec<Vec<f64>>) -> f64 {
    let size = matrix.len();
    let mut smallest = f64::INFINITY;
    for i in 0..size {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let left = matrix[i][j] - known;
            if i == j {
                smallest = smallest.min(left);
                if !(left > 0.0) {
                    return left;
                }
                matrix[i][i] = left.sqrt();
            } else {
                matrix[i][j] = left / matrix[j][j];
            }
        }
    }
    smallest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pivots_are_those_of_the_factors_and_not_positive_where_the_matrix_is_not() {
        // by hand: 1, 1 - 1/4, and for the correlation 2 above 1 a negative pivot 1 - 4
        assert!((smallest_pivot(vec![vec![1.0, 0.5], vec![0.5, 1.0]]) - 0.75).abs() < 1e-15);
        assert!((smallest_pivot(vec![vec![1.0, 2.0], vec![2.0, 1.0]]) + 3.0).abs() < 1e-15);
    }
}
