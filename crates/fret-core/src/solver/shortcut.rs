//! What a run may leave out because the answer is the same without it, and the switch that computes it all the same.

use serde::{Serialize, Serializer};

/// Work that some scenes do not need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shortcut {
    /// The layered response of bodies without a coating that differs from what lies below it.
    LayeredResponse,
    /// The coupling of pressure and shear where it vanishes, or where there is no friction.
    Coupling,
    /// The tangential equations where there is no friction, and before anything causes shear.
    Tangential,
    /// The normal problem while the pressure cannot change.
    Pressure,
    /// The part of shear across the load where it vanishes.
    Transverse,
    /// Cells that are mirror images of others.
    Mirror,
    /// Cells of the grid far from the contact, in every iteration.
    Box,
    /// All but six digits, in approximate inverses and on frozen zones.
    Digits,
}

impl Shortcut {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::LayeredResponse,
        Self::Coupling,
        Self::Tangential,
        Self::Pressure,
        Self::Transverse,
        Self::Mirror,
        Self::Box,
        Self::Digits,
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
            Self::Box => "cells far from the contact",
            Self::Digits => "digits that frozen zones do not need",
        }
    }
}

/// Which shortcuts are taken where the scene allows them: all, unless somebody wants to see that the answer is the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeaveOut {
    taken: [bool; Shortcut::ALL.len()],
}

impl LeaveOut {
    /// Every shortcut that the scene allows.
    pub const ALL: Self = Self { taken: [true; Shortcut::ALL.len()] };
    /// No shortcut: everything is computed.
    pub const NONE: Self = Self { taken: [false; Shortcut::ALL.len()] };

    /// Every shortcut but one.
    pub fn all_but(shortcut: Shortcut) -> Self {
        Self { taken: Shortcut::ALL.map(|other| other != shortcut) }
    }

    /// Whether a shortcut is taken where the scene allows it.
    pub fn takes(self, shortcut: Shortcut) -> bool {
        self.taken[shortcut as usize]
    }
}

impl Default for LeaveOut {
    fn default() -> Self {
        Self::ALL
    }
}

/// The list of the shortcuts that are taken.
impl Serialize for LeaveOut {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(Shortcut::ALL.into_iter().filter(|shortcut| self.takes(*shortcut)))
    }
}
