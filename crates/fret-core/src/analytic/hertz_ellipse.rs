//! Bodies of different curvature along x and y, pressed together without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::elliptic_integrals::CompleteElliptic;
use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, MODULUS, number};
use super::root::root_of_increasing;

/// Frictionless contact of ellipsoids (gap `x² / 2Rx + y² / 2Ry`).
///
/// With `A <= B` the two gap coefficients `1/2R`, a the semi-axis along A and `e² = 1 − b²/a²`: `B/A = [E/(1 − e²) − K]/(K − E)`,
/// `a³ = 3P(K − E)/(2π E* e² A)`, `p0 = 3P/(2πab)`, `δ = p0 b K/E*`.
///
/// Source: Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct HertzEllipse {
    /// Normal force P [force].
    pub force: f64,
    /// Semi-axes of the contact along x and y [length]; the longer lies along the larger radius.
    pub semi_axes: [f64; 2],
    /// Pressure p0 in the middle [pressure].
    pub max_pressure: f64,
    /// Approach δ of distant points [length].
    pub approach: f64,
}

#[functions]
impl HertzEllipse {
    /// Contact of relative radii of curvature `[Rx, Ry]` [length] under a normal force.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn ellipsoid(radii: [f64; 2], force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let [radius_x, radius_y] =
            [positive("radius along x", radii[0])?, positive("radius along y", radii[1])?];
        let (force, modulus) = (positive("force", force)?, effective_modulus(modulus)?);
        let flatter = radius_x.max(radius_y);
        let axis_ratio = axis_ratio(radius_x.min(radius_y) / flatter);
        let integrals = CompleteElliptic::complementary(axis_ratio);
        let a = (3.0 * force * integrals.difference * flatter / (PI * modulus)).cbrt();
        let b = a * axis_ratio;
        let max_pressure = 1.5 * force / (PI * a * b);
        Ok(Self {
            force,
            semi_axes: if radius_x >= radius_y { [a, b] } else { [b, a] },
            max_pressure,
            approach: max_pressure * b * integrals.first_kind / modulus,
        })
    }

    /// Pressure at a point [pressure]; zero outside the contact.
    #[shown]
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        let depth = 1.0 - (x / self.semi_axes[0]).powi(2) - (y / self.semi_axes[1]).powi(2);
        self.max_pressure * depth.max(0.0).sqrt()
    }
}

/// Ratio b/a of the contact from the ratio `A/B <= 1` of the gap's curvatures.
fn axis_ratio(curvature_ratio: f64) -> f64 {
    // A/B = (b/a)² D / (K − D) and D >= K − D, so A/B <= b/a <= √(A/B); searched in the logarithm.
    let misfit = |logarithm: f64| {
        let ratio = logarithm.exp().min(1.0);
        let integrals = CompleteElliptic::complementary(ratio);
        ratio * ratio * integrals.difference / (integrals.first_kind - integrals.difference) - curvature_ratio
    };
    root_of_increasing(curvature_ratio.ln(), 0.5 * curvature_ratio.ln(), misfit).exp().min(1.0)
}

/// `hertz_ellipse` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "hertz_ellipse",
    sentence: "Press an ellipsoid on a half-space without friction; relative radii of curvature [length].",
    parameters: &[
        number("radius_x", "Relative radius of curvature along x [length]."),
        number("radius_y", "Relative radius of curvature along y [length]."),
        FORCE,
        MODULUS,
    ],
    solution: Contents::of::<HertzEllipse>(),
    solve: |given| {
        solved(given, |[radius_x, radius_y, force, modulus]| {
            HertzEllipse::ellipsoid([radius_x, radius_y], force, modulus)
        })
    },
};

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::HertzEllipse;
    use crate::analytic::hertz::Hertz;
    use crate::analytic::quadrature::integral;

    #[test]
    fn ellipse_matches_the_printed_example() {
        // A = 0.05, B = 0.1 per mm: radii 10 and 5 mm.
        let contact = HertzEllipse::ellipsoid([5.0, 10.0], 100.0, 200e3 / 0.91).unwrap();
        let [along_x, along_y] = contact.semi_axes;
        assert!((along_y - 0.167_796_724_2).abs() < 1e-10);
        assert!((along_x - 0.105_811_893).abs() < 1e-9);
        assert!((along_x / along_y - 0.630_595_701_4).abs() < 1e-10);
        assert!((contact.max_pressure - 2_689.201_993).abs() < 1e-6);
        assert!((contact.approach - 2.527_402_701e-3).abs() < 1e-12);
    }

    #[test]
    fn equal_radii_give_the_sphere() {
        let (ellipse, sphere) =
            (HertzEllipse::ellipsoid([2.0, 2.0], 3.0, 5.0).unwrap(), Hertz::sphere(2.0, 3.0, 5.0).unwrap());
        assert!((ellipse.semi_axes[0] / sphere.contact_radius - 1.0).abs() < 1e-14);
        assert!((ellipse.approach / sphere.approach - 1.0).abs() < 1e-14);
    }

    #[test]
    fn slender_contacts_satisfy_the_curvature_at_both_axes() {
        // Far along the short axis the contact looks like a line contact of the local load: b = 2 p0 Ry / E*.
        let contact = HertzEllipse::ellipsoid([1e8, 1.0], 1.0, 1.0).unwrap();
        let line = 2.0 * contact.max_pressure;
        assert!((contact.semi_axes[1] / line - 1.0).abs() < 1e-6); // (b/a)² ln(a/b)
        assert!(contact.semi_axes.iter().all(|axis| axis.is_finite() && *axis > 0.0));
    }

    #[test]
    fn pressure_carries_the_force() {
        let contact = HertzEllipse::ellipsoid([7.0, 1.0], 4.0, 9.0).unwrap();
        let [a, b] = contact.semi_axes;
        // In the stretched polar radius the ellipse is a unit disc.
        let carried = integral(0.0, 1.0, |s| 2.0 * PI * a * b * s * contact.pressure(s * a, 0.0));
        assert!((carried / 4.0 - 1.0).abs() < 1e-13);
        assert!(HertzEllipse::ellipsoid([0.0, 1.0], 1.0, 1.0).is_err());
    }
}
