//! Units in which frozen problems are solved: in single precision numbers must lie near one.

use super::inverse::unit_of;

/// Units in which a frozen problem is solved.
#[derive(Debug, Clone, Copy)]
pub struct Units {
    /// Of tractions [pressure].
    pub pressure: f64,
    /// Of displacements over that of tractions [length/pressure].
    pub compliance: f64,
}

impl Units {
    /// Those of the scene.
    pub const SCENE: Self = Self { pressure: 1.0, compliance: 1.0 };

    /// Units that bring tractions up to `most` near one.
    pub fn near_one(most: f64, compliance: f64) -> Self {
        Self { pressure: unit_of(most), compliance }
    }

    /// Of displacements [length].
    pub fn length(self) -> f64 {
        self.pressure * self.compliance
    }
}
