//! How far frozen problems are solved before the next look at the equations.

/// How much of the cut a frozen problem is solved below; raised while outer steps do not pay.
const THETA: f64 = 1.0;
/// Share of its start to which a frozen problem is solved at the most when something is cut; by trial, see
/// `docs/performance.md`.
pub const ETA: f64 = 0.003;

/// Share of its start to which the residual of a frozen problem falls when its operator has six digits.
pub const SIX_DIGITS: f64 = 1e-5;

/// Share to which the `residual` of a look at the equations must fall to be below the tolerance at the next one, if the zones stay: what
/// is solved further is lost. With 0.25, 0.5 and 0.9 of the tolerance 3598, 3524 and 3451 instead of 3475 applications in 170 increments
/// of the paper's figure 3.
pub fn enough(tolerance: f64, residual: f64) -> f64 {
    0.7 * tolerance / residual
}

/// How far frozen problems are solved: further while outer steps do not pay.
#[derive(Debug)]
pub struct Patience {
    theta: f64,
    last: f64,
    /// Smallest residual so far.
    pub best: f64,
}

impl Default for Patience {
    fn default() -> Self {
        Self { theta: THETA, last: f64::INFINITY, best: f64::INFINITY }
    }
}

impl Patience {
    /// Whether several steps in a row did not pay: then nothing is left to chance.
    pub fn is_at_an_end(&self) -> bool {
        self.theta > 16.0 * THETA
    }

    /// Takes note of a residual; returns the share of the cut below which the next frozen problem is solved.
    pub fn hears(&mut self, residual: f64) -> f64 {
        self.theta = if residual > 0.9 * self.last {
            (4.0 * self.theta).min(300.0)
        } else {
            (self.theta / 2.0).max(THETA)
        };
        self.last = residual;
        self.best = self.best.min(residual);
        self.theta
    }
}
