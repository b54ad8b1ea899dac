//! What is prescribed in one increment: a force or a motion, for each rigid degree of freedom.

use serde::{Deserialize, Serialize};

/// What is prescribed for one rigid degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Control {
    /// The resultant [force], or [force x length] for twist; the motion follows.
    Force(f64),
    /// The rigid motion [length], or [rad] for twist; the resultant follows.
    Motion(f64),
}

/// Loads and motions at the end of one increment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LoadStep {
    /// Normal force (compression positive) or approach.
    pub normal: Control,
    /// Tangential force on the lower body, or shift of the upper body, along x and y.
    pub tangential: [Control; 2],
    /// Moment about z on the lower body, or rotation of the upper body.
    pub twist: Control,
}

impl LoadStep {
    /// Bodies that nothing holds or moves.
    pub const FREE: Self = Self {
        normal: Control::Force(0.0),
        tangential: [Control::Force(0.0); 2],
        twist: Control::Motion(0.0),
    };

    /// What is prescribed at a share of the straight way from one step to another that prescribes the same kinds.
    pub fn between(from: &Self, to: &Self, share: f64) -> Self {
        let one = |from: Control, to: Control| match (from, to) {
            (Control::Force(a), Control::Force(b)) if share < 1.0 => Control::Force(a + (b - a) * share),
            (Control::Motion(a), Control::Motion(b)) if share < 1.0 => Control::Motion(a + (b - a) * share),
            (_, to) => to,
        };
        Self {
            normal: one(from.normal, to.normal),
            tangential: [0, 1].map(|axis| one(from.tangential[axis], to.tangential[axis])),
            twist: one(from.twist, to.twist),
        }
    }
}
