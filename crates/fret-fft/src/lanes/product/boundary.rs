//! The two products of the engine: in free space and periodic.

use super::super::paired_rows::Places;

/// What differs between the two products.
pub(super) enum Boundary {
    FreeSpace,
    /// With the places of the frequencies in the transform along `y`.
    Periodic {
        places: Vec<Places>,
    },
}

impl Boundary {
    /// Shift of the frequencies, in units of their distance.
    pub fn fraction(&self) -> f64 {
        match self {
            Self::FreeSpace => 0.25,
            Self::Periodic { .. } => 0.0,
        }
    }

    /// Parts of each column.
    pub fn parts(&self) -> usize {
        match self {
            Self::FreeSpace => 2,
            Self::Periodic { .. } => 1,
        }
    }

    /// Row groups that are transformed together.
    pub fn paired(&self) -> usize {
        3 - self.parts()
    }

    /// Frequencies of a row of `length` points that are worked on.
    pub fn frequencies(&self, length: usize) -> usize {
        match self {
            Self::FreeSpace => length,
            Self::Periodic { .. } => length / 2 + 1,
        }
    }
}
