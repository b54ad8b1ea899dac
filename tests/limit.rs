//! The limit of a sequence whose error is a series of powers.

/// The limit of partial sums up to `ends` terms on either side, whose errors are the `powers` of `1/(end + 1/2)`, one fewer than there are
/// sums: the linear equations for the limit and the factors of the powers, by elimination with pivoting.
///
/// # Panics
/// When there are not as many sums.
pub fn limit(ends: &[usize], powers: &[i32], partial: impl Fn(usize) -> f64) -> f64 {
    assert_eq!(ends.len(), powers.len() + 1, "as many equations as unknowns");
    let count = ends.len();
    // Factors in units of the first end, so that columns are of one size.
    let unit = ends[0] as f64 + 0.5;
    let mut rows: Vec<Vec<f64>> = ends
        .iter()
        .map(|&end| {
            let near = unit / (end as f64 + 0.5);
            let factors = powers.iter().rev().map(|power| near.powi(*power));
            factors.chain([1.0, partial(end)]).collect()
        })
        .collect();
    for column in 0..count {
        let largest =
            (column..count).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        rows.swap(column, largest.unwrap_or(column));
        let pivot = rows[column].clone();
        for row in &mut rows[column + 1..] {
            let factor = row[column] / pivot[column];
            for (value, other) in row.iter_mut().zip(&pivot) {
                *value -= factor * other;
            }
        }
    }
    rows[count - 1][count] / rows[count - 1][count - 1]
}
