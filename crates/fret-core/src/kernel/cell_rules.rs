//! Gauss rules for integrals over rectangular cells.

use super::quadrature::GaussRule;

/// Largest number of points in one direction.
pub(super) const MOST_POINTS: usize = 11;

/// Gauss rules for cells at any distance.
///
/// The number of points in a direction depends on distance over side only: enough for `exp(-c r/h)/r` at the largest `c r/h`
/// that matters at a contrast of 1e6. A fixed order needs no error estimate, which the rounding of the table would defeat.
#[derive(Clone, Debug)]
pub(crate) struct CellQuadrature {
    rules: [(f64, GaussRule); 7],
    pub(super) polar_angle: GaussRule,
    pub(super) polar_radius: GaussRule,
}

impl CellQuadrature {
    pub(crate) fn new() -> Self {
        let up_to = |ratio: f64, count: usize| (ratio, GaussRule::new(count));
        Self {
            rules: [
                up_to(3.0, MOST_POINTS),
                up_to(6.0, 10),
                up_to(12.0, 8),
                up_to(20.0, 6),
                up_to(40.0, 5),
                up_to(200.0, 4),
                up_to(f64::INFINITY, 3),
            ],
            polar_angle: GaussRule::new(28),
            polar_radius: GaussRule::new(14),
        }
    }

    /// The rule for a rectangle whose distance is so many times its side.
    pub(super) fn rule(&self, distance_over_side: f64) -> &[(f64, f64)] {
        let index = self.rules[..6].iter().position(|(limit, _)| distance_over_side < *limit).unwrap_or(6);
        &self.rules[index].1.points
    }
}
