//! Coulomb's law of dry friction: the bound on shear from pressure.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

/// Why a friction law was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FrictionError {
    /// A coefficient that is negative or not finite.
    #[error("friction coefficient {0}: must be zero or positive and finite")]
    Coefficient(f64),
    /// A map whose shape is not the grid's.
    #[error("friction map of shape {found:?}: the grid has {expected:?} cells")]
    MapShape {
        /// Shape of the map.
        found: [usize; 2],
        /// Cells of the grid.
        expected: [usize; 2],
    },
}

/// Dry friction: `|q| <= mu p`, with equality and direction of the slip where the surfaces slip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoulombFriction {
    /// One coefficient everywhere [-].
    Uniform(f64),
    /// A coefficient for every cell [-], shape `(nx, ny)`.
    Map(Array2<f64>),
}

impl CoulombFriction {
    /// One coefficient everywhere.
    ///
    /// # Errors
    /// When it is negative or not finite.
    pub fn uniform(coefficient: f64) -> Result<Self, FrictionError> {
        check(coefficient)?;
        Ok(Self::Uniform(coefficient))
    }

    /// A coefficient for every cell.
    ///
    /// # Errors
    /// When an entry is negative or not finite.
    pub fn map(coefficients: Array2<f64>) -> Result<Self, FrictionError> {
        coefficients.iter().try_for_each(|&coefficient| check(coefficient))?;
        Ok(Self::Map(coefficients))
    }

    /// Whether there is no friction anywhere.
    pub fn is_frictionless(&self) -> bool {
        match self {
            Self::Uniform(coefficient) => *coefficient == 0.0,
            Self::Map(map) => map.iter().all(|&coefficient| coefficient == 0.0),
        }
    }

    /// Coefficient in cell `[i, j]` [-].
    pub fn at(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Uniform(coefficient) => *coefficient,
            Self::Map(map) => map[[i, j]],
        }
    }

    /// Largest coefficient [-].
    pub fn largest(&self) -> f64 {
        match self {
            Self::Uniform(coefficient) => *coefficient,
            Self::Map(map) => map.iter().copied().fold(0.0, f64::max),
        }
    }
}

fn check(coefficient: f64) -> Result<(), FrictionError> {
    if coefficient.is_finite() && coefficient >= 0.0 {
        Ok(())
    } else {
        Err(FrictionError::Coefficient(coefficient))
    }
}
