//! Small systems of linear equations.

/// Solves a system by elimination with exchange of rows; an unknown that no pivot larger than `least` tells is zero.
pub(crate) fn solved<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N], least: f64) -> [f64; N] {
    for m in 0..N {
        let pivot = (m..N).fold(m, |best, row| if a[row][m].abs() > a[best][m].abs() { row } else { best });
        a.swap(m, pivot);
        b.swap(m, pivot);
        if a[m][m].abs() <= least {
            a[m][m] = 0.0;
            continue;
        }
        for row in m + 1..N {
            let factor = a[row][m] / a[m][m];
            for column in m..N {
                a[row][column] -= factor * a[m][column];
            }
            b[row] -= factor * b[m];
        }
    }
    let mut x = [0.0; N];
    for m in (0..N).rev() {
        let rest: f64 = (m + 1..N).map(|column| a[m][column] * x[column]).sum();
        x[m] = if a[m][m] == 0.0 { 0.0 } else { (b[m] - rest) / a[m][m] };
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three unknowns whose first row has no pivot of its own; and one that nothing tells.
    #[test]
    fn rows_are_exchanged_and_what_nothing_tells_is_zero() {
        let a = [[0.0, 2.0, 1.0], [4.0, 1.0, 0.0], [2.0, 0.0, 1.0]];
        let found = solved(a, [5.0, 6.0, 3.0], 0.0);
        for (row, right) in a.iter().zip([5.0, 6.0, 3.0]) {
            let left: f64 = row.iter().zip(found).map(|(a, x)| a * x).sum();
            assert!((left - right).abs() < 1e-14, "{found:?}");
        }
        assert_eq!(solved([[2.0, 0.0], [0.0, 1e-13]], [6.0, 1.0], 1e-12), [3.0, 0.0]);
    }
}
