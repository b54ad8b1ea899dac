//! Interpolation between points that are evenly spaced in the logarithm.

/// Points on either side: enough for kernels that fall like `exp(-20 r/r_0)`, as they do on a rigid base.
pub(super) const REACH: usize = 12;

/// `(-1)^j binomial(23, j)`: barycentric weights of evenly spaced points.
const BARYCENTRIC: [f64; 2 * REACH] = {
    let mut weights = [1.0; 2 * REACH];
    let mut j = 1;
    while j < 2 * REACH {
        weights[j] = -weights[j - 1] * (2 * REACH - j) as f64 / j as f64;
        j += 1;
    }
    weights
};

/// Lagrange's polynomial through the points around a position, counted in points: the first of them, and their weights, whose sum is 1.
#[inline(always)]
pub(super) fn lagrange(position: f64) -> (usize, [f64; 2 * REACH]) {
    let below = position.floor();
    let start = below as usize + 1 - REACH;
    let within = position - below + (REACH - 1) as f64;
    let mut weights = [0.0; 2 * REACH];
    if position == below {
        weights[REACH - 1] = 1.0;
        return (start, weights);
    }
    for j in 0..2 * REACH {
        weights[j] = BARYCENTRIC[j] / (within - j as f64);
    }
    let total: f64 = weights.iter().sum();
    (start, weights.map(|weight| weight / total))
}

/// Functions, known at the points, at a position.
pub(super) fn interpolated<const LANES: usize>(points: &[[f64; LANES]], position: f64) -> [f64; LANES] {
    let (start, weights) = lagrange(position);
    let mut sums = [0.0; LANES];
    for (weight, values) in weights.iter().zip(&points[start..]) {
        for lane in 0..LANES {
            sums[lane] += weight * values[lane];
        }
    }
    sums
}
