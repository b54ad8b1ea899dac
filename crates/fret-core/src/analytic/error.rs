//! Why a closed-form solution was refused, and the checks at its door.

use crate::model::MaterialError;

/// Why a closed-form solution was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AnalyticError {
    /// A number outside its range.
    #[error("{name} = {value}: must be {allowed}")]
    OutOfRange {
        /// Which number.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What is accepted.
        allowed: &'static str,
    },
    /// A load too large for the solution.
    #[error("{name} = {value}: {reason} {limit}")]
    TooLarge {
        /// Which load.
        name: &'static str,
        /// What was given.
        value: f64,
        /// Who sets the limit.
        reason: &'static str,
        /// Largest magnitude that is accepted.
        limit: f64,
    },
    /// A point that the table of finite-friction solutions does not hold.
    #[error(
        "no tabulated solution at poisson = {poisson}, stick ratio = {stick_ratio}: see SPENCE_TABLE (no interpolation)"
    )]
    NotTabulated {
        /// Poisson's ratio asked for.
        poisson: f64,
        /// Stick ratio asked for.
        stick_ratio: f64,
    },
    /// A material that there is not.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// Another count of numbers than a closed form of the catalogue asks for.
    #[error("{0} numbers: not as many as the closed form asks for")]
    NumbersGiven(usize),
}

/// The value itself when it is positive and finite.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, AnalyticError> {
    within(name, value, value > 0.0 && value.is_finite(), "positive and finite")
}

/// The value itself when `accepted`, otherwise a refusal that says what is `allowed`.
pub(super) fn within(
    name: &'static str,
    value: f64,
    accepted: bool,
    allowed: &'static str,
) -> Result<f64, AnalyticError> {
    if accepted { Ok(value) } else { Err(AnalyticError::OutOfRange { name, value, allowed }) }
}

#[cfg(test)]
mod tests {
    use super::positive;

    #[test]
    fn a_refusal_names_the_value_and_the_range() {
        let refusal = positive("force", -3.0).unwrap_err();
        assert_eq!(refusal.to_string(), "force = -3: must be positive and finite");
        assert!(positive("force", f64::NAN).is_err() && positive("force", f64::INFINITY).is_err());
    }
}
