//! Parameters of Coulomb's law of dry friction, with a shear strength of the interface. What they bound: `solver/laws/friction.rs`.

use ndarray::Array2;
use serde::{Deserialize, Serialize, Serializer};

use super::heights::fingerprint;

/// Why a friction law was refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FrictionError {
    /// A value that is negative or not finite.
    #[error("{0}: must be zero or positive and finite")]
    Value(f64),
    /// An entry of a map that is negative or not finite.
    #[error("entry [{}, {}] = {value}: must be zero or positive and finite", at[0], at[1])]
    Entry {
        /// Its cell.
        at: [usize; 2],
        /// What was given.
        value: f64,
    },
}

/// Numbers of cells, shape `(nx, ny)`. A record of a run holds its [`MapSummary`].
#[derive(Debug, Clone, PartialEq)]
pub struct CellMap(pub Array2<f64>);

/// What a record of a run holds of a map: what tells it apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapSummary {
    /// Its cells.
    pub cells: [usize; 2],
    /// Its smallest number.
    pub smallest: f64,
    /// Its largest number.
    pub largest: f64,
    /// Hash of its numbers.
    pub fnv1a64: String,
}

impl Serialize for CellMap {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(map) = self;
        let (nx, ny) = map.dim();
        let smallest = map.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = map.iter().copied().fold(0.0, f64::max);
        MapSummary { cells: [nx, ny], smallest, largest, fnv1a64: fingerprint(map) }.serialize(serializer)
    }
}

/// One number everywhere, or one for every cell: the map of a case, or the summary of one in a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellValues<M = CellMap> {
    /// The same everywhere.
    Uniform(f64),
    /// One for every cell.
    Map(M),
}

impl<M> CellValues<M> {
    /// The number that holds everywhere, where there is one.
    pub fn uniform(&self) -> Option<f64> {
        if let Self::Uniform(value) = self { Some(*value) } else { None }
    }
}

impl CellValues {
    /// The number of cell `[i, j]`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Uniform(value) => *value,
            Self::Map(CellMap(map)) => map[[i, j]],
        }
    }

    /// The map, where it is one.
    pub fn map(&self) -> Option<&Array2<f64>> {
        match self {
            Self::Uniform(_) => None,
            Self::Map(CellMap(map)) => Some(map),
        }
    }

    fn largest(&self) -> f64 {
        match self {
            Self::Uniform(value) => *value,
            Self::Map(CellMap(map)) => map.iter().copied().fold(0.0, f64::max),
        }
    }

    /// What is negative or not finite, with its cell.
    fn fault(&self) -> Option<FrictionError> {
        let bad = |value: f64| !(value.is_finite() && value >= 0.0);
        match self {
            Self::Uniform(value) => bad(*value).then_some(FrictionError::Value(*value)),
            Self::Map(CellMap(map)) => map
                .indexed_iter()
                .find(|(_, value)| bad(**value))
                .map(|((i, j), &value)| FrictionError::Entry { at: [i, j], value }),
        }
    }
}

/// Dry friction: `|q| <= b = min(mu p, tau)`, with equality and the direction of the slip where the surfaces slip; tau is the shear
/// strength of the interface, where it has one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoulombFriction<M = CellMap> {
    /// Friction coefficient mu [-].
    coefficient: CellValues<M>,
    /// Shear strength of the interface [pressure].
    #[serde(skip_serializing_if = "Option::is_none")]
    max_shear: Option<CellValues<M>>,
}

impl<M> CoulombFriction<M> {
    /// Its coefficients.
    pub fn coefficient(&self) -> &CellValues<M> {
        &self.coefficient
    }

    /// Its shear strength [pressure], where it has one.
    pub fn max_shear(&self) -> Option<&CellValues<M>> {
        self.max_shear.as_ref()
    }
}

impl CoulombFriction {
    /// No friction.
    pub const NONE: Self = Self { coefficient: CellValues::Uniform(0.0), max_shear: None };

    /// The law of a coefficient.
    ///
    /// # Errors
    /// When it is negative or not finite.
    pub fn new(coefficient: CellValues) -> Result<Self, FrictionError> {
        match coefficient.fault() {
            Some(fault) => Err(fault),
            None => Ok(Self { coefficient, max_shear: None }),
        }
    }

    /// One coefficient everywhere.
    ///
    /// # Errors
    /// When it is negative or not finite.
    pub fn uniform(coefficient: f64) -> Result<Self, FrictionError> {
        Self::new(CellValues::Uniform(coefficient))
    }

    /// A coefficient for every cell.
    ///
    /// # Errors
    /// When an entry is negative or not finite.
    pub fn map(coefficients: Array2<f64>) -> Result<Self, FrictionError> {
        Self::new(CellValues::Map(CellMap(coefficients)))
    }

    /// The same with a shear strength of the interface [pressure].
    ///
    /// # Errors
    /// When it is negative or not finite.
    pub fn with_max_shear(self, max_shear: CellValues) -> Result<Self, FrictionError> {
        match max_shear.fault() {
            Some(fault) => Err(fault),
            None => Ok(Self { max_shear: Some(max_shear), ..self }),
        }
    }

    /// The same shear strength as another law.
    #[must_use]
    pub fn with_max_shear_of(self, other: &Self) -> Self {
        Self { max_shear: other.max_shear.clone(), ..self }
    }

    /// The same with other coefficients, zero or positive and finite.
    #[must_use]
    pub(crate) fn with_coefficient(&self, coefficient: CellValues) -> Self {
        debug_assert_eq!(coefficient.fault(), None);
        Self { coefficient, max_shear: self.max_shear.clone() }
    }

    /// The law with every map replaced.
    #[must_use]
    pub fn with_maps(&self, replaced: impl Fn(&Array2<f64>) -> Array2<f64>) -> Self {
        let replace = |values: &CellValues| match values {
            CellValues::Uniform(value) => CellValues::Uniform(*value),
            CellValues::Map(CellMap(map)) => CellValues::Map(CellMap(replaced(map))),
        };
        Self { coefficient: replace(&self.coefficient), max_shear: self.max_shear.as_ref().map(replace) }
    }

    /// Its maps: values that differ from cell to cell.
    pub fn maps(&self) -> impl Iterator<Item = &Array2<f64>> {
        std::iter::once(&self.coefficient).chain(&self.max_shear).filter_map(CellValues::map)
    }

    /// Whether there is no friction anywhere.
    pub fn is_frictionless(&self) -> bool {
        self.coefficient.largest() == 0.0 || self.max_shear.as_ref().is_some_and(|tau| tau.largest() == 0.0)
    }

    /// Whether it has a value for every cell.
    pub fn is_map(&self) -> bool {
        self.maps().next().is_some()
    }

    /// Coefficient in cell `[i, j]` [-].
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.coefficient.at(i, j)
    }

    /// Largest coefficient [-].
    pub fn largest(&self) -> f64 {
        self.coefficient.largest()
    }
}
