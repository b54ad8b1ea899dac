//! Gauss-Legendre rules.

/// The `N`-point Gauss-Legendre rule on `[-1, 1]`: exact for polynomials of degree `2 N - 1`.
#[derive(Clone, Debug)]
pub(crate) struct GaussRule {
    /// Points and weights, from left to right.
    pub points: Vec<(f64, f64)>,
}

impl GaussRule {
    /// Rule with `count` points, by Newton's iteration on the Legendre polynomial.
    pub(crate) fn new(count: usize) -> Self {
        let n = count as f64;
        let mut points = vec![(0.0, 0.0); count];
        for i in 0..count.div_ceil(2) {
            let mut x = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5));
            // Newton from this start converges quadratically; the sixth step no longer moves any point
            for _ in 0..6 {
                let (value, slope) = legendre(count, x);
                x -= value / slope;
            }
            if 2 * i + 1 == count {
                x = 0.0;
            }
            let (_, slope) = legendre(count, x);
            let weight = 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
            points[i] = (-x, weight);
            points[count - 1 - i] = (x, weight);
        }
        Self { points }
    }
}

/// Legendre polynomial of degree `degree >= 1` and its derivative, `|x| < 1`.
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=degree {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, degree as f64 * (x * value - before) / ((x - 1.0) * (x + 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_integrate_every_power_they_promise() {
        for count in 1..=30 {
            let rule = GaussRule::new(count);
            for power in 0..2 * count as i32 {
                let sum: f64 = rule.points.iter().map(|(x, w)| w * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 2e-14, "{count} points, power {power}: {sum} {exact}"); // rounding of 30 terms
            }
        }
    }
}
