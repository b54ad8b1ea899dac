//! Why derivatives are refused, or not found.

use crate::run::RunError;

/// Why there are no derivatives.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensitivityError {
    /// A parameter that the case does not have, or by which no derivative is taken.
    #[error("by {path:?}: {reason}")]
    Parameter {
        /// What was asked for.
        path: String,
        /// What is wrong with it, and what is allowed.
        reason: String,
    },
    /// A result that the history does not have, or whose derivative is not taken.
    #[error("of {name:?}: {reason}")]
    Objective {
        /// What was asked for.
        name: String,
        /// What is wrong with it, and what is allowed.
        reason: String,
    },
    /// A case of a kind whose histories are not differentiated.
    #[error("derivatives of a history with {key}: not covered; {advice}")]
    NotCovered {
        /// The key of the case that makes it one.
        key: String,
        /// What helps.
        advice: &'static str,
    },
    /// A linear problem that was not solved.
    #[error(
        "increment {increment}, derivative {of}: residual {reached:.1e} of the linear equations, required {target:.0e}: the solution may change \
         abruptly here, as where a contact begins to slide; another load, or more increments, may avoid that"
    )]
    NotSolved {
        /// Number of the increment, from 0.
        increment: usize,
        /// By which number, or of which result.
        of: String,
        /// What was reached.
        reached: f64,
        /// What is required.
        target: f64,
    },
    /// The history itself has no answer.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The operators could not be made.
    #[error("operators of the derivatives: {0}")]
    Operators(String),
}
