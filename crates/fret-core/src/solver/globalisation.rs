//! How far a Newton step is solved for.

/// The forcing term of the inexact Newton method (Eisenstat & Walker 1996): relative residual of the linear problems. They are solved
/// further while the residual falls fast, and while it does not fall.
#[derive(Debug)]
pub struct ForcingTerm {
    last: f64,
    /// Smallest residual so far.
    pub best: f64,
    /// Iterations since a tenth of it was gained.
    pub without_gain: usize,
    /// Iterations in a row that did not pay.
    stalled: i32,
}

impl Default for ForcingTerm {
    fn default() -> Self {
        Self { last: f64::INFINITY, best: f64::INFINITY, without_gain: 0, stalled: 0 }
    }
}

/// Numbers by trial: applications in twelve frictional cases, cold, cyclic, coupled and coated, on 64 to 256 cells per side; 10825 with
/// these, 10858 to 11203 with most = 0.05 to 0.4, 11130 with least = 0.01, 10903 and 11349 with gamma = 0.2 and 1.
impl ForcingTerm {
    /// Forcing terms of a residual that falls, at the most (the first) and at the least.
    const MOST: f64 = 0.5;
    const LEAST: f64 = 0.003;
    /// Times the ratio of the last two residuals.
    const GAMMA: f64 = 0.3;
    /// Fraction of the tolerance that the next residual is to reach: what is solved further is lost.
    const ENOUGH: f64 = 0.8;
    /// An iteration does not pay when it leaves more than this of the residual.
    const NO_GAIN: f64 = 0.9;

    /// The forcing term after a residual.
    pub fn next(&mut self, residual: f64, tolerance: f64) -> f64 {
        let ratio = residual / self.last;
        self.stalled = if ratio > Self::NO_GAIN { self.stalled + 1 } else { 0 };
        self.last = residual;
        self.without_gain = if residual < Self::NO_GAIN * self.best { 0 } else { self.without_gain + 1 };
        self.best = self.best.min(residual);
        let falling =
            if ratio > 0.0 { (Self::GAMMA * ratio).clamp(Self::LEAST, Self::MOST) } else { Self::MOST };
        let wanted = falling * 0.1_f64.powi(self.stalled.min(6));
        wanted.max((Self::ENOUGH * tolerance / residual).min(Self::MOST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_problems_are_solved_further_while_residuals_fall_fast_or_not_at_all() {
        let mut forcing = ForcingTerm::default();
        assert_eq!(forcing.next(1.0, 1e-8), 0.5);
        assert!((forcing.next(0.1, 1e-8) - 0.03).abs() < 1e-15); // 0.3 times 0.1
        assert_eq!(forcing.next(1e-5, 1e-8), 0.003);
        assert!((forcing.next(1e-5, 1e-8) - 0.03).abs() < 1e-15); // stalled: a tenth of 0.3
        assert!((forcing.next(1e-5, 1e-8) - 0.003).abs() < 1e-15);
        // Near the tolerance no further than the next residual needs.
        assert!((forcing.next(4e-8, 1e-8) - 0.2).abs() < 1e-15);
        assert_eq!((forcing.best, forcing.without_gain), (4e-8, 0));
        forcing.next(5e-8, 1e-8);
        forcing.next(4e-8, 1e-8);
        assert_eq!((forcing.best, forcing.without_gain), (4e-8, 2));
    }
}
