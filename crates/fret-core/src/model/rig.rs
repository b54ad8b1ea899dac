//! The machine that holds the upper body: one spring normally, one along each tangential axis, between the body and what is driven.

use serde::{Deserialize, Serialize};

/// Compliances of the machine [length/force]; 0 where it is rigid. In a line contact, of a unit of its length.
///
/// The far end of a spring is where the actuator is: `actuator = shift + compliance x tangential force`, normally
/// `actuator_approach = approach + compliance x normal force`. Its energy is reversible: what friction dissipates is the same at both ends.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Rig {
    /// Along z.
    pub normal: f64,
    /// Along x and y.
    pub tangential: [f64; 2],
}

impl Rig {
    /// A machine that does not give.
    pub const RIGID: Self = Self { normal: 0.0, tangential: [0.0; 2] };

    /// Whether it does not give.
    pub fn is_rigid(&self) -> bool {
        *self == Self::RIGID
    }

    /// Where the actuator is tangentially [length], with the upper body at `shift` under a force on the lower one.
    pub fn actuator(&self, shift: [f64; 2], force: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| shift[axis] + self.tangential[axis] * force[axis])
    }

    /// Where the actuator is normally [length].
    pub fn actuator_approach(&self, approach: f64, force: f64) -> f64 {
        approach + self.normal * force
    }

    /// The spring that each of `parts` equal parts of a contact has by itself.
    #[must_use]
    pub fn of_part(&self, parts: usize) -> Self {
        let parts = parts as f64;
        Self { normal: self.normal * parts, tangential: self.tangential.map(|spring| spring * parts) }
    }
}
