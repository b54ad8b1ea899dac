//! A cylinder pressed on a half-space without friction.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{LINE_FORCE, MODULUS, RADIUS};

/// Frictionless line contact of cylinders, gap `x² / 2R`.
///
/// `a² = 4P'R/(πE*)`, `p0 = 2P'/(πa)`.
/// An approach exists relative to a point at a depth alone: in two dimensions displacement grows with the logarithm of the distance.
///
/// Source: Hertz (1881); Johnson (1985), *Contact Mechanics*, section 4.2(c).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct HertzLine {
    /// Relative radius R of the cylinders [length].
    pub radius: f64,
    /// Effective modulus E* [pressure].
    pub modulus: f64,
    /// Force per length P' [force / length].
    pub line_force: f64,
    /// Half-width a of the contact [length].
    pub half_width: f64,
    /// Pressure p0 in the middle [pressure].
    pub max_pressure: f64,
}

#[functions]
impl HertzLine {
    /// Contact of relative radius R under a force per length.
    ///
    /// # Errors
    /// When a value is not positive and finite.
    pub fn cylinder(radius: f64, line_force: f64, modulus: f64) -> Result<Self, AnalyticError> {
        let (radius, line_force) = (positive("radius", radius)?, positive("line force", line_force)?);
        let modulus = effective_modulus(modulus)?;
        let half_width = (4.0 * line_force * radius / (PI * modulus)).sqrt();
        Ok(Self {
            radius,
            modulus,
            line_force,
            half_width,
            max_pressure: 2.0 * line_force / (PI * half_width),
        })
    }

    /// Approach relative to points at a `depth` below the surfaces [length], with E* [pressure] and the sum of `1/G` of the bodies that
    /// deform [1/pressure]: `2P'/(πE*) [ln(2d/a) + 1/2] − P'/(2π) Σ 1/G`, for depths far greater than a. Source: Johnson, eq. 5.57.
    pub fn approach(&self, depth: f64, modulus: f64, shear_compliance: f64) -> f64 {
        let above = 2.0 / (PI * modulus) * (libm::log(2.0 * depth / self.half_width) + 0.5);
        self.line_force * (above - shear_compliance / (2.0 * PI))
    }

    /// Pressure at `x` from the middle [pressure]; zero outside the contact.
    #[shown]
    pub fn pressure(&self, x: f64) -> f64 {
        let depth = 1.0 - (x / self.half_width).powi(2);
        self.max_pressure * depth.max(0.0).sqrt()
    }
}

/// `hertz_line` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "hertz_line",
    sentence: "Press a cylinder on a half-space without friction, under a force per length [force/length].",
    parameters: &[RADIUS, LINE_FORCE, MODULUS],
    solution: Contents::of::<HertzLine>(),
    solve: |given| {
        solved(given, |[radius, line_force, modulus]| HertzLine::cylinder(radius, line_force, modulus))
    },
};

#[cfg(test)]
mod tests {
    use super::HertzLine;
    use crate::analytic::quadrature::integral;

    #[test]
    fn cylinder_matches_the_steel_example() {
        let contact = HertzLine::cylinder(10.0, 100.0, 200e3 / 0.91).unwrap();
        assert!((contact.half_width - 0.076_113_336_1).abs() < 1e-10);
        assert!((contact.max_pressure - 836.410_286_5).abs() < 1e-7);
        let carried = integral(-contact.half_width, contact.half_width, |x| contact.pressure(x));
        assert!((carried / 100.0 - 1.0).abs() < 1e-13);
        assert!(HertzLine::cylinder(10.0, 0.0, 1.0).is_err());
    }
}
