//! A flat punch with a rounded edge pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, MODULUS, number};
use super::quadrature::integral;
use super::root::root_of_increasing;

/// Frictionless contact of a punch that is flat within `b`, gap `(r - b)² / 2R` beyond.
///
/// With `δ(t) = (t/R) (√(t² − b²) − b arccos(b/t))` the approach is `δ(a)`, the force `2E* ∫ t δ'(t) dt` and the pressure
/// `(E*/π) ∫ δ'(t) / √(t² − r²) dt` up to `a`.
///
/// Source: Sneddon (1965), Int. J. Engng Sci. 3, 47; Ciavarella (1999), Int. J. Solids Struct. 36, 4149.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct RoundedPunch {
    /// Normal force [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Approach [length].
    pub approach: f64,
    flat_radius: f64,
    edge_radius: f64,
    modulus: f64,
}

#[functions]
impl RoundedPunch {
    /// Punch of a flat radius `b` and an edge radius `R` under a normal force.
    ///
    /// # Errors
    /// When a value is not positive and finite, or the contact so large that it leaves the flat out of sight.
    pub fn new(flat_radius: f64, edge_radius: f64, force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let (b, radius) = (positive("flat radius", flat_radius)?, positive("edge radius", edge_radius)?);
        let (force, modulus) = (positive("force", force)?, effective_modulus(modulus)?);
        // In units of b the contact radius depends on one number, F R / (2 E* b^3) = ∫ t δ'(t) R dt.
        let wanted = force * radius / (2.0 * modulus * b.powi(3));
        within("force R / (2 E* b^3)", wanted, wanted < 1e12, "below 1e12: use a sphere")?;
        let reach = root_of_increasing(1.0, 1e5, |a| moment(a) - wanted);
        Ok(Self {
            force,
            contact_radius: reach * b,
            approach: reach * ((reach * reach - 1.0).sqrt() - (1.0 / reach).acos()) * b * b / radius,
            flat_radius: b,
            edge_radius: radius,
            modulus,
        })
    }

    /// Radius of the flat [length].
    pub fn flat_radius(&self) -> f64 {
        self.flat_radius
    }

    /// Pressure at distance `r` from the middle [pressure]; zero outside the contact.
    #[shown]
    pub fn pressure(&self, r: f64) -> f64 {
        let (r, b, a) = (r.abs(), self.flat_radius, self.contact_radius);
        if r >= a {
            return 0.0;
        }
        // t² = r² + s² takes the root away.
        let from = (b * b - r * r).max(0.0).sqrt();
        let part = |s: f64| {
            let t = r.hypot(s);
            if t > b { rate(t / b) * b / (self.edge_radius * t) } else { 0.0 }
        };
        self.modulus / PI * integral(from, (a * a - r * r).sqrt(), part)
    }
}

/// `δ'(t) R / b` at `t / b`.
fn rate(t: f64) -> f64 {
    2.0 * (t * t - 1.0).max(0.0).sqrt() - (1.0 / t).min(1.0).acos()
}

/// `∫ t δ'(t) dt R / b³` from the flat to `a / b`.
fn moment(a: f64) -> f64 {
    integral(1.0, a, |t| t * rate(t))
}

/// `rounded_punch` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "rounded_punch",
    sentence: "Press a flat punch with a rounded edge on a half-space without friction.",
    parameters: &[
        number("flat_radius", "Radius b of the flat part [length]."),
        number("edge_radius", "Radius R of curvature of the edge [length]."),
        FORCE,
        MODULUS,
    ],
    solution: Contents::of::<RoundedPunch>(),
    solve: |given| {
        solved(given, |[flat, edge, force, modulus]| RoundedPunch::new(flat, edge, force, modulus))
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::Hertz;

    #[test]
    fn pressure_carries_the_force_and_a_small_flat_is_a_sphere() {
        let punch = RoundedPunch::new(1.0, 10.0, 0.05, 2.0).unwrap();
        let a = punch.contact_radius;
        let carried = integral(0.0, 1.0, |r| 2.0 * PI * r * punch.pressure(r))
            + integral(1.0, a, |r| 2.0 * PI * r * punch.pressure(r));
        assert!((carried / 0.05 - 1.0).abs() < 1e-9, "{carried}"); // the pressure has a kink at the flat's rim
        let nearly = RoundedPunch::new(1e-3, 10.0, 0.05, 2.0).unwrap();
        let hertz = Hertz::sphere(10.0, 0.05, 2.0).unwrap();
        // The flat changes the contact by its share of the radius, to first order in the approach.
        assert!((nearly.contact_radius / hertz.contact_radius - 1.0).abs() < 2e-3);
        assert!((nearly.pressure(0.1) / hertz.pressure(0.1) - 1.0).abs() < 1e-2);
        assert_eq!(punch.pressure(1.01 * a), 0.0);
    }
}
