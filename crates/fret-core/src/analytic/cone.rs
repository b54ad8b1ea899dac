//! A blunt rigid cone pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, MODULUS, number};

/// Frictionless contact of a cone, gap `r t` with the slope `t` of its side against the surface.
///
/// `P = πa²E*t/2`, `δ = πat/2`, `p = (E*t/2) arcosh(a/r)`. For `t << 1`.
///
/// Source: Love (1939); Sneddon (1965), Int. J. Engng Sci. 3, 47.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct Cone {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Approach δ [length].
    pub approach: f64,
    /// Mean pressure `E*t/2` [pressure], whatever the load.
    pub mean_pressure: f64,
}

#[functions]
impl Cone {
    /// Cone of a slope `t` [-] under a normal force.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn new(slope: f64, force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let (slope, force) = (positive("slope", slope)?, positive("force", force)?);
        let mean_pressure = effective_modulus(modulus)? * slope / 2.0;
        let contact_radius = (force / (PI * mean_pressure)).sqrt();
        Ok(Self { force, contact_radius, approach: PI * contact_radius * slope / 2.0, mean_pressure })
    }

    /// Pressure at distance `r` from the tip [pressure]; infinite (logarithm) at the tip, zero outside the contact.
    #[shown]
    pub fn pressure(&self, r: f64) -> f64 {
        self.mean_pressure * (self.contact_radius / r.abs()).max(1.0).acosh()
    }
}

/// `cone` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "cone",
    sentence: "Press a blunt cone, of the `slope` [-] of its side against the surface, on a half-space without friction.",
    parameters: &[
        number(
            "slope",
            "Slope of the side against the surface [-]: the gap is the slope times the distance from the tip.",
        ),
        FORCE,
        MODULUS,
    ],
    solution: Contents::of::<Cone>(),
    solve: |given| solved(given, |[slope, force, modulus]| Cone::new(slope, force, modulus)),
};

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::Cone;
    use crate::analytic::quadrature::integral;

    #[test]
    fn pressure_carries_the_force_and_the_work_of_approach_is_stored() {
        let cone = Cone::new(0.1, 5.0, 30.0).unwrap();
        let carried = integral(0.0, cone.contact_radius, |r| 2.0 * PI * r * cone.pressure(r));
        assert!((carried / 5.0 - 1.0).abs() < 1e-12);
        assert!((cone.force - 2.0 * 30.0 * cone.approach.powi(2) / (PI * 0.1)).abs() < 1e-13); // Sneddon's P(δ)
        assert_eq!(cone.pressure(2.0 * cone.contact_radius), 0.0);
        assert!(Cone::new(0.0, 1.0, 1.0).is_err());
    }
}
