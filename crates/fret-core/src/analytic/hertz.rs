//! A sphere pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, MODULUS, RADIUS};

/// Frictionless contact of spheres (paraboloids `r² / 2R`).
///
/// `a³ = 3PR/(4E*)`, `p0 = 3P/(2πa²)`, `δ = a²/R`, `p = p0 √(1 − r²/a²)`.
/// Holds for `a << R`; exact with friction too when the bodies do not couple (coupling β = 0).
///
/// Source: Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct Hertz {
    /// Relative radius R of the spheres, `1/R = 1/R1 + 1/R2` [length].
    pub radius: f64,
    /// Effective modulus E* [pressure].
    pub modulus: f64,
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Pressure p0 in the middle [pressure].
    pub max_pressure: f64,
    /// Approach δ of distant points [length].
    pub approach: f64,
}

#[functions]
impl Hertz {
    /// Contact under a normal force.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn sphere(sphere_radius: f64, force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let sphere_radius = positive("sphere radius", sphere_radius)?;
        let (force, modulus) = (positive("force", force)?, effective_modulus(modulus)?);
        Ok(Self::with_contact_radius((0.75 * force * sphere_radius / modulus).cbrt(), sphere_radius, modulus))
    }

    /// Contact under a given approach [length].
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn sphere_at_approach(
        sphere_radius: f64,
        approach: f64,
        modulus: f64,
    ) -> Result<Self, AnalyticError> {
        let sphere_radius = positive("sphere radius", sphere_radius)?;
        let (approach, modulus) = (positive("approach", approach)?, effective_modulus(modulus)?);
        Ok(Self::with_contact_radius((approach * sphere_radius).sqrt(), sphere_radius, modulus))
    }

    fn with_contact_radius(a: f64, sphere_radius: f64, modulus: f64) -> Self {
        Self {
            radius: sphere_radius,
            modulus,
            force: 4.0 * modulus * a.powi(3) / (3.0 * sphere_radius),
            contact_radius: a,
            max_pressure: 2.0 * modulus * a / (PI * sphere_radius),
            approach: a * a / sphere_radius,
        }
    }

    /// Pressure at distance `r` from the middle [pressure]; zero outside the contact.
    #[shown]
    pub fn pressure(&self, r: f64) -> f64 {
        let depth = 1.0 - (r / self.contact_radius).powi(2);
        self.max_pressure * depth.max(0.0).sqrt()
    }
}

/// `hertz` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "hertz",
    sentence: "Press a sphere on a half-space without friction.",
    parameters: &[RADIUS, FORCE, MODULUS],
    solution: Contents::of::<Hertz>(),
    solve: |given| solved(given, |[radius, force, modulus]| Hertz::sphere(radius, force, modulus)),
};

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::PI;

    use super::Hertz;
    use crate::analytic::quadrature::integral;

    /// A rigid sphere of 10 mm on steel (E 200e3, ν 0.3) under 100 N; in N and mm.
    pub(in crate::analytic) fn steel_example() -> Hertz {
        Hertz::sphere(10.0, 100.0, 200e3 / 0.91).unwrap()
    }

    #[test]
    fn sphere_matches_the_steel_example() {
        let hertz = steel_example();
        assert!((hertz.contact_radius - 0.150_553_510_55).abs() < 1e-11);
        assert!((hertz.max_pressure - 2_106.491_024_52).abs() < 1e-8);
        assert!((hertz.approach - 2.266_635_953_9e-3).abs() < 1e-13);
    }

    #[test]
    fn pressure_carries_the_force() {
        let hertz = steel_example();
        let carried = integral(0.0, hertz.contact_radius, |r| 2.0 * PI * r * hertz.pressure(r));
        assert!((carried / 100.0 - 1.0).abs() < 1e-13);
        assert_eq!(hertz.pressure(hertz.contact_radius * 1.001), 0.0);
    }

    #[test]
    fn approach_and_force_are_two_doors_to_one_contact() {
        let hertz = steel_example();
        let again = Hertz::sphere_at_approach(10.0, hertz.approach, 200e3 / 0.91).unwrap();
        assert!((again.force / hertz.force - 1.0).abs() < 1e-14);
    }

    #[test]
    fn unusable_values_are_refused() {
        assert!(Hertz::sphere(0.0, 1.0, 1.0).is_err());
        assert!(Hertz::sphere(1.0, -1.0, 1.0).is_err());
        assert!(Hertz::sphere(1.0, 1.0, f64::NAN).is_err());
        assert!(Hertz::sphere_at_approach(1.0, 0.0, 1.0).is_err());
    }
}
