//! Uncertainty of first order: what uncertain numbers make of a result, by its derivatives at their means, without samples.

/// Standard deviation of a result to first order, and what it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstOrder {
    /// Standard deviation, of the unit of the result.
    pub deviation: f64,
    /// The fraction of the variance that each number brings, in the order of the numbers; none of them where nothing varies.
    pub fractions: Vec<f64>,
}

/// The spread of a result from its derivatives at the means of independent numbers, and the standard deviations of these.
///
/// The variance is the sum of the squares of derivative times standard deviation (JCGM 100:2008, 5.1.2): exact where the result is linear in the
/// numbers; what bends, and what happens beyond a kink, is not in it.
pub fn first_order(derivatives: &[f64], deviations: &[f64]) -> FirstOrder {
    let parts: Vec<f64> =
        derivatives.iter().zip(deviations).map(|(derivative, deviation)| derivative * deviation).collect();
    // By the largest part, so that no square is beyond all numbers, in whatever units.
    let largest = parts.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    if largest == 0.0 {
        return FirstOrder { deviation: 0.0, fractions: vec![0.0; parts.len()] };
    }
    let squares: Vec<f64> = parts.iter().map(|part| (part / largest).powi(2)).collect();
    let sum: f64 = squares.iter().sum();
    FirstOrder {
        deviation: largest * sum.sqrt(),
        fractions: squares.into_iter().map(|square| square / sum).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `3 x - 4 y + 0 z` of numbers with standard deviations of 2, 0.5 and 1: `sqrt(6^2 + 2^2)`, of which `x` brings 36/40; in any unit.
    #[test]
    fn a_sum_has_the_variance_of_its_parts() {
        let deviations = [2.0, 0.5, 1.0];
        for unit in [1.0, 1e-200, 1e200] {
            let found = first_order(&[3.0 * unit, -4.0 * unit, 0.0], &deviations);
            assert!((found.deviation / (40.0_f64.sqrt() * unit) - 1.0).abs() < 1e-14, "{found:?}");
            for (fraction, right) in found.fractions.iter().zip([0.9, 0.1, 0.0]) {
                assert!((fraction - right).abs() < 1e-14, "{found:?}");
            }
        }
        assert_eq!(
            first_order(&[0.0], &deviations[..1]),
            FirstOrder { deviation: 0.0, fractions: vec![0.0] }
        );
    }
}
