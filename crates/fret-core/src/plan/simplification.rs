//! What a run may leave out because the result is the same without it, and the switch that computes it all the same.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Work that some problems do not need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Simplification {
    /// The layered response of bodies without a coating that differs from what lies below it.
    LayeredResponse,
    /// The coupling of pressure and shear where it vanishes, or where there is no friction.
    Coupling,
    /// The tangential equations where there is no friction, and before anything causes shear.
    Tangential,
    /// The normal problem while the pressure cannot change.
    Pressure,
    /// The component of shear across the load where it vanishes.
    Transverse,
    /// Cells that are mirror images of others.
    Mirror,
    /// Cells of the grid far from the contact, in every iteration.
    Region,
    /// Double precision, in linear problems and approximate inverses.
    Precision,
}

impl Simplification {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::LayeredResponse,
        Self::Coupling,
        Self::Tangential,
        Self::Pressure,
        Self::Transverse,
        Self::Mirror,
        Self::Region,
        Self::Precision,
    ];

    /// What is left out, in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::LayeredResponse => "layered response",
            Self::Coupling => "coupling of pressure and shear",
            Self::Tangential => "shear that nothing causes",
            Self::Pressure => "normal problem at one load",
            Self::Transverse => "shear across the load",
            Self::Mirror => "cells behind a mirror",
            Self::Region => "cells far from the contact",
            Self::Precision => "double precision in linear problems",
        }
    }
}

/// Which simplifications are made where the problem allows them: all, unless somebody wants to see that the result is the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeaveOut {
    taken: [bool; Simplification::ALL.len()],
}

impl LeaveOut {
    /// Every simplification that the problem allows.
    pub const ALL: Self = Self { taken: [true; Simplification::ALL.len()] };
    /// None: everything is computed.
    pub const NONE: Self = Self { taken: [false; Simplification::ALL.len()] };

    /// Every simplification but one.
    pub fn all_but(simplification: Simplification) -> Self {
        Self { taken: Simplification::ALL.map(|other| other != simplification) }
    }

    /// Whether a simplification is made where the problem allows it.
    pub fn takes(self, simplification: Simplification) -> bool {
        self.taken[simplification as usize]
    }
}

impl Default for LeaveOut {
    fn default() -> Self {
        Self::ALL
    }
}

/// The list of the simplifications that are made.
impl Serialize for LeaveOut {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(Simplification::ALL.into_iter().filter(|one| self.takes(*one)))
    }
}

impl<'de> Deserialize<'de> for LeaveOut {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let made = Vec::<Simplification>::deserialize(deserializer)?;
        Ok(Self { taken: Simplification::ALL.map(|one| made.contains(&one)) })
    }
}
