//! Distributions of an uncertain number.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, LogNormal, Normal, Triangular, Uniform, Weibull};
use statrs::statistics::Distribution as Moments;

/// A distribution of one number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Distribution {
    /// Anything between two bounds, equally likely.
    Uniform {
        /// Lower bound.
        from: f64,
        /// Upper bound.
        to: f64,
    },
    /// Normal (Gauss).
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// Lognormal: its logarithm is normal.
    Lognormal {
        /// Mean of the number itself.
        mean: f64,
        /// Standard deviation of the number itself.
        deviation: f64,
    },
    /// Triangular.
    Triangular {
        /// Lower bound.
        from: f64,
        /// The likeliest value.
        mode: f64,
        /// Upper bound.
        to: f64,
    },
    /// Weibull, from zero up.
    Weibull {
        /// Shape (modulus) [-].
        shape: f64,
        /// Scale: the value below which 63.2 % lie.
        scale: f64,
    },
}

/// Why a distribution was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct DistributionError(String);

impl Distribution {
    /// The same distribution, checked.
    ///
    /// # Errors
    /// When a parameter is not finite, or out of its range.
    pub fn checked(self) -> Result<Self, DistributionError> {
        let refuse = |what: &str| Err(DistributionError(what.to_owned()));
        let finite = match self {
            Self::Uniform { from, to } => [from, to, 0.0],
            Self::Normal { mean, deviation } | Self::Lognormal { mean, deviation } => [mean, deviation, 0.0],
            Self::Triangular { from, mode, to } => [from, mode, to],
            Self::Weibull { shape, scale } => [shape, scale, 0.0],
        };
        if !finite.iter().all(|value| value.is_finite()) {
            return refuse("every number of a distribution must be finite");
        }
        match self {
            Self::Uniform { from, to } if from >= to => refuse("from must lie below to"),
            Self::Normal { deviation, .. } | Self::Lognormal { deviation, .. } if deviation <= 0.0 => {
                refuse("deviation must be positive")
            }
            Self::Lognormal { mean, .. } if mean <= 0.0 => {
                refuse("the mean of a lognormal number is positive")
            }
            Self::Triangular { from, mode, to } if !(from <= mode && mode <= to && from < to) => {
                refuse("from, mode and to must rise")
            }
            Self::Weibull { shape, scale } if shape <= 0.0 || scale <= 0.0 => {
                refuse("shape and scale must be positive")
            }
            good => Ok(good),
        }
    }

    /// The value below which lies a fraction of all, between 0 and 1 and neither of them.
    ///
    /// # Panics
    /// Never, of a distribution that has been [`checked`](Self::checked); else not a number.
    pub fn quantile(&self, fraction: f64) -> f64 {
        fn at<D: ContinuousCDF<f64, f64>, E>(distribution: Result<D, E>, fraction: f64) -> f64 {
            distribution.map_or(f64::NAN, |distribution| distribution.inverse_cdf(fraction))
        }
        match *self {
            Self::Uniform { from, to } => at(Uniform::new(from, to), fraction),
            Self::Normal { mean, deviation } => at(Normal::new(mean, deviation), fraction),
            Self::Lognormal { mean, deviation } => {
                let square = libm::log1p((deviation / mean).powi(2));
                at(LogNormal::new(libm::log(mean) - 0.5 * square, square.sqrt()), fraction)
            }
            Self::Triangular { from, mode, to } => at(Triangular::new(from, to, mode), fraction),
            Self::Weibull { shape, scale } => at(Weibull::new(shape, scale), fraction),
        }
    }

    /// Mean and standard deviation.
    ///
    /// # Panics
    /// Never, of a distribution that has been [`checked`](Self::checked); else not numbers.
    pub fn moments(&self) -> [f64; 2] {
        fn of<D: Moments<f64>, E>(distribution: Result<D, E>) -> [f64; 2] {
            let found = distribution.ok().and_then(|found| Some([found.mean()?, found.std_dev()?]));
            found.unwrap_or([f64::NAN; 2])
        }
        match *self {
            Self::Normal { mean, deviation } | Self::Lognormal { mean, deviation } => [mean, deviation],
            Self::Uniform { from, to } => of(Uniform::new(from, to)),
            Self::Triangular { from, mode, to } => of(Triangular::new(from, to, mode)),
            Self::Weibull { shape, scale } => of(Weibull::new(shape, scale)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and standard deviation by midpoints of the fractions.
    fn by_quantiles(distribution: Distribution) -> [f64; 2] {
        const COUNT: usize = 200_000;
        let values: Vec<f64> =
            (0..COUNT).map(|n| distribution.quantile((n as f64 + 0.5) / COUNT as f64)).collect();
        let mean = values.iter().sum::<f64>() / COUNT as f64;
        let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / COUNT as f64;
        [mean, square.sqrt()]
    }

    #[test]
    fn quantiles_have_the_mean_and_the_deviation_of_the_textbooks() {
        let gamma = libm::tgamma;
        let [one, two] = [gamma(1.0 + 1.0 / 2.5), gamma(1.0 + 2.0 / 2.5)];
        for (distribution, mean, deviation) in [
            (Distribution::Uniform { from: 1.0, to: 4.0 }, 2.5, 3.0 / 12.0_f64.sqrt()),
            (Distribution::Normal { mean: 0.6, deviation: 0.05 }, 0.6, 0.05),
            (Distribution::Lognormal { mean: 2.0, deviation: 0.7 }, 2.0, 0.7),
            (
                Distribution::Triangular { from: 1.0, mode: 2.0, to: 6.0 },
                3.0,
                ((1.0 + 4.0 + 36.0 - 2.0 - 6.0 - 12.0) / 18.0_f64).sqrt(),
            ),
            (Distribution::Weibull { shape: 2.5, scale: 3.0 }, 3.0 * one, 3.0 * (two - one * one).sqrt()),
        ] {
            let found = by_quantiles(distribution.checked().unwrap());
            // the tails beyond the outermost midpoints
            assert!((found[0] / mean - 1.0).abs() < 1e-4, "{distribution:?}: {found:?}");
            assert!((found[1] / deviation - 1.0).abs() < 1e-3, "{distribution:?}: {found:?}");
            let moments = distribution.moments();
            assert!((moments[0] / mean - 1.0).abs() < 1e-12, "{distribution:?}: {moments:?}");
            assert!((moments[1] / deviation - 1.0).abs() < 1e-12, "{distribution:?}: {moments:?}");
        }
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        for wrong in [
            Distribution::Uniform { from: 1.0, to: 1.0 },
            Distribution::Normal { mean: 0.0, deviation: 0.0 },
            Distribution::Normal { mean: f64::NAN, deviation: 1.0 },
            Distribution::Lognormal { mean: -1.0, deviation: 1.0 },
            Distribution::Triangular { from: 1.0, mode: 3.0, to: 2.0 },
            Distribution::Weibull { shape: 0.0, scale: 1.0 },
        ] {
            assert!(wrong.checked().is_err(), "{wrong:?}");
        }
    }
}
