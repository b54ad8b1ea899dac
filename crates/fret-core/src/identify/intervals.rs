//! How sure fitted constants are: their covariance, from the points' residuals.
//!
//! ```text
//! (J^T J)^-1 J^T V J (J^T J)^-1 + b b^T s_b^2,      V_ij = s_i s_j r^|i - j|
//! ```
//!
//! where `J` has the derivatives of the weighted residuals. The points' variances `s_i^2` are those of noise in the force and of noise in
//! the displacement, each as large as the residuals say: where the loop is steep that of the displacement counts, on plateaus that of the
//! force. Few points tell the two apart badly: the interval is the wider one of this and of equal noise in both. `r` is the correlation of
//! neighbours, where it is more than chance, with what the fit has taken from it (residuals of `p` constants and `n` points are correlated
//! by about `p (1 + r)/n` less than the noise) and its own standard deviation. `b` is what a bend of the drift adds to the constants.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// A correlation of neighbours is more than chance from so many of its standard deviations, `1/sqrt(n)`, on.
const CHANCE: f64 = 2.33;
/// Largest correlation that is told.
const MOST: f64 = 0.98;
/// The variance of one noise over that of the other, at the least: a loop tells the smaller one badly.
const LEAST_SHARE: f64 = 0.25;
/// Singular values below this, relative to the largest, are nothing: the points do not tell their directions.
const NOTHING: f64 = 1e-9;
/// A constant has a part in a direction from so much of it on.
const PART: f64 = 1e-6;

/// What a fit leaves.
pub struct Left<'a> {
    /// Derivatives of the weighted residuals by the constants.
    pub jacobian: &'a DMatrix<f64>,
    /// Weighted residuals, in the order of time.
    pub residuals: &'a DVector<f64>,
    /// Part of every residual's variance that is of the force, with equal noise in both: the rest is of the displacement.
    pub of_force: &'a [f64],
    /// Derivatives by a bend of the drift that is not fitted, and its standard deviation.
    pub bend: (DVector<f64>, f64),
}

/// How sure the constants are.
pub struct Sureness {
    /// Half-widths of 95 % intervals; infinite for constants that the points do not tell.
    pub halves: Vec<f64>,
    /// The same without the bend of the drift.
    pub halves_of_straight: Vec<f64>,
    /// Correlation of neighbouring points; nothing where it may be chance.
    pub correlation: f64,
}

/// How sure the constants are. `None` where there are no more points than constants.
pub fn sureness(left: &Left<'_>) -> Option<Sureness> {
    let (count, constants) = left.jacobian.shape();
    let freedom = count as f64 - constants as f64;
    if !(freedom >= 1.0) {
        return None;
    }
    let residuals = left.residuals;
    let mean_square = residuals.norm_squared() / freedom;
    let (inverse, untold) = inverse_of_square(left.jacobian)?;
    let own = variances(left, &inverse, mean_square);
    let correlation = correlation(residuals, constants);
    // The fit takes more from correlated noise than from independent one: what residuals are left of it, by tr(V) - tr(H V).
    let kept = (count as f64 - (&inverse * correlated_square(left.jacobian, correlation)).trace()) / freedom;
    let covariance = |variance: &dyn Fn(usize) -> f64| {
        let scaled =
            DMatrix::from_fn(count, constants, |row, k| left.jacobian[(row, k)] * variance(row).sqrt());
        &inverse * (correlated_square(&scaled, correlation) / kept.max(0.1)) * &inverse
    };
    let [straight, of_equal] = [covariance(&|row| own[row]), covariance(&|_| mean_square)];
    let (column, unsure) = &left.bend;
    let by_bend = &inverse * left.jacobian.transpose() * column;
    let points = count as f64 * (1.0 - correlation) / (1.0 + correlation);
    let quantile = quantile(points - constants as f64);
    let half = |k: usize, unsure: f64| {
        let variance = straight[(k, k)].max(of_equal[(k, k)]).max(0.0);
        let half = quantile * (variance + (unsure * by_bend[k]).powi(2)).sqrt();
        if untold[k] || half.is_nan() { f64::INFINITY } else { half }
    };
    Some(Sureness {
        halves: (0..constants).map(|k| half(k, *unsure)).collect(),
        halves_of_straight: (0..constants).map(|k| half(k, 0.0)).collect(),
        correlation,
    })
}

/// So many standard deviations are half of a 95 % interval, with so many independent points more than constants.
pub fn quantile(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom.max(3.0)).map_or(1.96, |law| law.inverse_cdf(0.975))
}

/// `(J^T J)^-1` in the directions that the points tell, by singular values; and which constants have a part in one that they do not.
fn inverse_of_square(jacobian: &DMatrix<f64>) -> Option<(DMatrix<f64>, Vec<bool>)> {
    let decomposition = jacobian.clone().svd(false, true);
    let directions = decomposition.v_t?;
    let largest = decomposition.singular_values.max();
    let constants = jacobian.ncols();
    let values = &decomposition.singular_values;
    let is_told = |row: usize| values[row] > NOTHING * largest;
    let inverse = DMatrix::from_fn(constants, constants, |k, l| {
        let told = (0..values.len()).filter(|row| is_told(*row));
        told.map(|row| directions[(row, k)] * directions[(row, l)] / values[row].powi(2)).sum()
    });
    let has_part = |k: usize| (0..values.len()).any(|row| !is_told(row) && directions[(row, k)].abs() > PART);
    Some((inverse, (0..constants).map(has_part).collect()))
}

/// `sum_ij x_i r^|i - j| x_j^T` over the rows.
fn correlated_square(rows: &DMatrix<f64>, correlation: f64) -> DMatrix<f64> {
    let (count, constants) = rows.shape();
    let mut sum = DMatrix::zeros(constants, constants);
    let mut before = DVector::zeros(constants);
    for row in 0..count {
        let here = rows.row(row).transpose();
        before *= correlation;
        sum += &here * before.transpose() + &before * here.transpose() + &here * here.transpose();
        before += here;
    }
    sum
}

/// Correlation of neighbours, with what the fit has taken from it and its standard deviation; nothing where it may be chance.
fn correlation(residuals: &DVector<f64>, constants: usize) -> f64 {
    let count = residuals.len();
    let square = residuals.norm_squared();
    let products: f64 = (1..count).map(|row| residuals[row] * residuals[row - 1]).sum();
    let found = products / square;
    let chance = CHANCE / (count as f64).sqrt();
    if found.is_nan() || found <= chance {
        return 0.0;
    }
    let whole = (found + constants as f64 * (1.0 + found) / count as f64).min(MOST);
    (whole + ((1.0 - whole * whole) / count as f64).sqrt()).min(MOST)
}

/// Variances of the points: those of force and of displacement by least squares of the squared residuals, weighted once.
fn variances(left: &Left<'_>, inverse: &DMatrix<f64>, mean_square: f64) -> Vec<f64> {
    let squares: Vec<f64> = (0..left.residuals.len())
        .map(|row| {
            let of_constants = left.jacobian.row(row);
            let taken = (of_constants * inverse * of_constants.transpose())[(0, 0)];
            left.residuals[row].powi(2) / (1.0 - taken).max(0.1)
        })
        .collect();
    let mut two = [mean_square; 2];
    for _ in 0..2 {
        let at = |part: f64| (two[0] * part + two[1] * (1.0 - part)).max(1e-3 * mean_square);
        let (mut matrix, mut right) = ([[0.0; 2]; 2], [0.0; 2]);
        for (&part, square) in left.of_force.iter().zip(&squares) {
            let weight = at(part).powi(-2);
            let terms = [part, 1.0 - part];
            for k in 0..2 {
                right[k] += weight * terms[k] * square;
                for l in 0..2 {
                    matrix[k][l] += weight * terms[k] * terms[l];
                }
            }
        }
        let alone = [0, 1].map(|k| if matrix[k][k] > 0.0 { right[k] / matrix[k][k] } else { 0.0 });
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        let both = [
            (right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant,
            (right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant,
        ];
        // Neither is negative.
        two = if !(determinant > 1e-12 * matrix[0][0] * matrix[1][1]) {
            [mean_square; 2]
        } else if both[0] < 0.0 {
            [0.0, alone[1]]
        } else if both[1] < 0.0 {
            [alone[0], 0.0]
        } else {
            both
        };
    }
    let least = LEAST_SHARE * two[0].max(two[1]);
    let [force, length] = two.map(|variance| variance.max(least));
    left.of_force.iter().map(|part| force * part + length * (1.0 - part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a line through zero tell its slope; not a constant without any part in them, nor two that act as one.
    #[test]
    fn what_does_not_matter_is_not_told() {
        let residuals = DVector::from_fn(20, |row, _| 0.01 * ((7 * row * row) as f64).sin());
        let halves = |columns: &[fn(f64) -> f64]| {
            let jacobian = DMatrix::from_fn(20, columns.len(), |row, k| columns[k](row as f64));
            let left = Left {
                jacobian: &jacobian,
                residuals: &residuals,
                of_force: &[1.0; 20],
                bend: (DVector::zeros(20), 0.0),
            };
            sureness(&left).unwrap().halves
        };
        let alone = halves(&[|x| x])[0];
        let beside = halves(&[|x| x, |_| 0.0]);
        assert!((beside[0] / alone - 1.0).abs() < 0.2 && beside[1].is_infinite(), "{alone} {beside:?}");
        let twins = halves(&[|x| x, |_| 1.0, |x| 2.0 * x]);
        assert!(twins[0].is_infinite() && twins[1].is_finite() && twins[2].is_infinite(), "{twins:?}");
        assert!(halves(&[|_| 0.0])[0].is_infinite());
    }

    /// The quick sum over rows is the double sum.
    #[test]
    fn correlated_rows_are_summed_in_pairs() {
        let rows = DMatrix::from_fn(17, 3, |row, k| ((row * (k + 2)) as f64).sin());
        let mut right = DMatrix::zeros(3, 3);
        for i in 0..17 {
            for j in 0..17_usize {
                right += rows.row(i).transpose() * rows.row(j) * 0.7_f64.powi(i.abs_diff(j) as i32);
            }
        }
        assert!((correlated_square(&rows, 0.7) - right).norm() < 1e-12);
    }
}
