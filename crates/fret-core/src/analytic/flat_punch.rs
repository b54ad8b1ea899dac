//! A flat-ended rigid cylinder pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, MODULUS, PUNCH_RADIUS};

/// Frictionless contact of a flat circular punch.
///
/// `P = 2E* a δ`, `p = P / (2πa √(a² − r²))`.
///
/// Source: Boussinesq (1885); Johnson (1985), *Contact Mechanics*, section 3.4.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct FlatPunch {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the punch and of the contact [length].
    pub contact_radius: f64,
    /// Approach δ [length].
    pub approach: f64,
}

#[functions]
impl FlatPunch {
    /// Punch of a radius under a normal force.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn new(punch_radius: f64, force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let (contact_radius, force) = (positive("punch radius", punch_radius)?, positive("force", force)?);
        Ok(Self {
            force,
            contact_radius,
            approach: force / (2.0 * effective_modulus(modulus)? * contact_radius),
        })
    }

    /// Pressure at distance `r` from the middle [pressure]; infinite at the edge, zero outside.
    #[shown]
    pub fn pressure(&self, r: f64) -> f64 {
        let a = self.contact_radius;
        if r.abs() > a { 0.0 } else { self.force / (2.0 * PI * a * ((a - r) * (a + r)).sqrt()) }
    }
}

/// `flat_punch` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "flat_punch",
    sentence: "Press a flat circular punch on a half-space without friction.",
    parameters: &[PUNCH_RADIUS, FORCE, MODULUS],
    solution: Contents::of::<FlatPunch>(),
    solve: |given| solved(given, |[radius, force, modulus]| FlatPunch::new(radius, force, modulus)),
};

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::FlatPunch;
    use crate::analytic::quadrature::integral;

    #[test]
    fn pressure_carries_the_force() {
        let punch = FlatPunch::new(2.0, 12.0, 3.0).unwrap();
        assert_eq!(punch.approach, 1.0);
        // r = a sin φ takes the edge singularity away.
        let ring =
            |angle: f64| 2.0 * PI * 4.0 * angle.sin() * angle.cos() * punch.pressure(2.0 * angle.sin());
        assert!((integral(0.0, 1.5, ring) / (12.0 * (1.0 - 1.5_f64.cos())) - 1.0).abs() < 1e-12);
        assert_eq!(punch.pressure(2.1), 0.0);
        assert!(punch.pressure(2.0).is_infinite());
    }
}
