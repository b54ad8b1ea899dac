//! Coulomb's law of dry friction: the bound on shear from pressure.

use ndarray::Array2;
use serde::{Serialize, Serializer};

use super::heights::fingerprint;

/// Why a friction law was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FrictionError {
    /// A coefficient that is negative or not finite.
    #[error("friction coefficient {0}: must be zero or positive and finite")]
    Coefficient(f64),
    /// An entry of a map that is negative or not finite.
    #[error("entry [{}, {}] = {value}: must be zero or positive and finite", at[0], at[1])]
    Entry {
        /// Its cell.
        at: [usize; 2],
        /// What was given.
        value: f64,
    },
}

/// Dry friction: `|q| <= mu p`, with equality and direction of the slip where the surfaces slip.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CoulombFriction {
    /// One coefficient everywhere [-].
    Uniform(f64),
    /// A coefficient for every cell [-], shape `(nx, ny)`.
    #[serde(serialize_with = "summary")]
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
        match coefficients.indexed_iter().find(|(_, coefficient)| check(**coefficient).is_err()) {
            Some(((i, j), &value)) => Err(FrictionError::Entry { at: [i, j], value }),
            None => Ok(Self::Map(coefficients)),
        }
    }

    /// Whether there is no friction anywhere.
    pub fn is_frictionless(&self) -> bool {
        match self {
            Self::Uniform(coefficient) => *coefficient == 0.0,
            Self::Map(map) => map.iter().all(|&coefficient| coefficient == 0.0),
        }
    }

    /// Whether it has a coefficient for every cell.
    pub fn is_map(&self) -> bool {
        matches!(self, Self::Map(_))
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

/// A record of a run holds what tells a map apart, not the map.
fn summary<S: Serializer>(map: &Array2<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Summary {
        cells: [usize; 2],
        smallest: f64,
        largest: f64,
        fnv1a64: String,
    }
    let (nx, ny) = map.dim();
    let smallest = map.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = map.iter().copied().fold(0.0, f64::max);
    Summary { cells: [nx, ny], smallest, largest, fnv1a64: fingerprint(map) }.serialize(serializer)
}

fn check(coefficient: f64) -> Result<(), FrictionError> {
    if coefficient.is_finite() && coefficient >= 0.0 {
        Ok(())
    } else {
        Err(FrictionError::Coefficient(coefficient))
    }
}
