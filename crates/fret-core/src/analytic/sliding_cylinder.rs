//! A cylinder that slides across its axis on a half-space, where shear acts on the pressure.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, solved};
use super::moduli::{coupling, effective_modulus};
use super::parameter::{COUPLING, LINE_FORCE, MODULUS, RADIUS, number};

/// Line contact of a cylinder in full sliding, with normal-tangential coupling.
///
/// `p = (E*/2R) cos(πγ) (a + x)^(1/2 − γ) (a − x)^(1/2 + γ)`, `tan(πγ) = βμ`, `P' = πa² E* (1 − 4γ²)/(4R)`; the middle of the contact lies `2γa`
/// behind the cylinder's axis: at `−2γa` with the shear on the lower body along +x. x counts from the middle.
///
/// Source: Bufler (1959); Johnson (1985), *Contact Mechanics*, section 8.2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct SlidingCylinder {
    /// Force per length P' [force / length].
    pub line_force: f64,
    /// Half-width a of the contact [length].
    pub half_width: f64,
    /// Exponent γ [-], positive where coupling and friction are.
    pub exponent: f64,
    /// Middle of the contact from the cylinder's axis [length], with the shear on the lower body along +x.
    pub offset: f64,
    /// Largest pressure [pressure].
    pub max_pressure: f64,
    /// `E*/(2R)` [pressure / length].
    #[serde(skip)]
    scale: f64,
}

#[functions]
impl SlidingCylinder {
    /// Contact of relative radius R under a force per length, with the effective modulus E* [pressure], Dundurs' coupling β [-] and
    /// the friction coefficient μ [-], negative for shear along −x.
    ///
    /// # Errors
    /// When a length, a force or the modulus is not positive and finite, `|β| >= 1`, or the friction is not finite.
    pub fn new(
        radius: f64,
        line_force: f64,
        modulus: f64,
        beta: f64,
        friction: f64,
    ) -> Result<Self, AnalyticError> {
        let (radius, line_force) = (positive("radius", radius)?, positive("line force", line_force)?);
        let (modulus, beta) = (effective_modulus(modulus)?, coupling(beta)?);
        within("friction", friction, friction.is_finite(), "finite")?;
        let exponent = (beta * friction).atan() / PI;
        let half_width =
            (4.0 * line_force * radius / (PI * modulus * (1.0 - 4.0 * exponent * exponent))).sqrt();
        let mut found = Self {
            line_force,
            half_width,
            exponent,
            offset: -2.0 * exponent * half_width,
            max_pressure: 0.0,
            scale: modulus / (2.0 * radius),
        };
        // the derivative of the logarithm vanishes at x = -2 gamma a
        found.max_pressure = found.pressure(-2.0 * exponent * half_width);
        Ok(found)
    }

    /// Pressure at `x` from the middle of the contact [pressure]; zero outside.
    #[shown]
    pub fn pressure(&self, x: f64) -> f64 {
        let (a, gamma) = (self.half_width, self.exponent);
        if x.abs() >= a {
            return 0.0;
        }
        self.scale * (PI * gamma).cos() * (a + x).powf(0.5 - gamma) * (a - x).powf(0.5 + gamma)
    }
}

/// `sliding_cylinder` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "sliding_cylinder",
    sentence: "Slide a cylinder across its axis on a half-space, with Dundurs' coupling beta [-].",
    parameters: &[
        RADIUS,
        LINE_FORCE,
        MODULUS,
        COUPLING,
        number(
            "friction_coefficient",
            "Coefficient of friction [-], negative for shear on the lower body along -x.",
        ),
    ],
    solution: Contents::of::<SlidingCylinder>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, coupling, friction]| {
            SlidingCylinder::new(radius, force, modulus, coupling, friction)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::super::HertzLine;
    use super::*;

    #[test]
    fn numbers_of_a_strong_coupling() {
        // beta mu = 0.25: found by Cauchy quadrature of the formula
        let found = SlidingCylinder::new(10.0, 0.01, 2.0, 0.5, 0.5).unwrap();
        let hertz = HertzLine::cylinder(10.0, 0.01, 2.0).unwrap();
        assert!((found.exponent - 0.077_979).abs() < 5e-7);
        assert!((found.offset / found.half_width + 0.155_958).abs() < 5e-7);
        assert!((found.half_width / hertz.half_width - 1.012_388).abs() < 5e-7);
        assert!((found.max_pressure / hertz.max_pressure - 0.994_228).abs() < 5e-7);
        let turned = SlidingCylinder::new(10.0, 0.01, 2.0, 0.5, -0.5).unwrap();
        assert!((turned.pressure(0.03) - found.pressure(-0.03)).abs() < 1e-15);
        assert_eq!(turned.offset, -found.offset);
    }

    #[test]
    fn pressure_carries_the_force_and_lies_on_the_cylinder() {
        // surface slope under pressure p and shear mu p: -(2/(pi E*)) Int p(s)/(x - s) ds + (2 beta mu/E*) p = -(x - x_axis)/R, here by
        // strips, whose integral is a logarithm
        let (radius, modulus, beta, friction) = (10.0, 2.0, 0.3, 0.8);
        let found = SlidingCylinder::new(radius, 0.01, modulus, beta, friction).unwrap();
        let (a, strips) = (found.half_width, 40_000_u32);
        let width = 2.0 * a / f64::from(strips);
        let middle = |i: u32| -a + (f64::from(i) + 0.5) * width;
        let carried: f64 = (0..strips).map(|i| found.pressure(middle(i)) * width).sum();
        assert!((carried / 0.01 - 1.0).abs() < 1e-5); // roots at the edges
        for place in [-0.6, 0.0, 0.4, 0.8] {
            let x = place * a + 0.5 * width;
            let sum: f64 = (0..strips)
                .map(|i| {
                    let near = x - middle(i);
                    found.pressure(middle(i)) * ((near + 0.5 * width) / (near - 0.5 * width)).abs().ln()
                })
                .sum();
            let slope = -2.0 / (PI * modulus) * sum + 2.0 * beta * friction / modulus * found.pressure(x);
            let exact = -(x + found.offset) / radius;
            assert!((slope - exact).abs() < 1e-3 * a / radius, "{place}: {slope} {exact}");
        }
    }
}
