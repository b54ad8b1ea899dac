//! Rigid punches that are pressed and tilted, without friction. A parabola needs no form of its own: tilted by a slope θ it touches as
//! before, `Rθ` to the side, under the moment `P R θ` about its axis.

use std::f64::consts::PI;

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, solved};
use super::moduli::effective_modulus;
use super::parameter::{FORCE, LINE_FORCE, MODULUS, PUNCH_RADIUS, TILT, number};

/// A flat circular punch under a force P and tilted by a slope θ along x, deeper at positive x.
///
/// `M = (4/3) E* a³ θ`, `p = P/(2πa √(a² − r²)) + (2E*θ/π) x/√(a² − r²)`; in full contact while `M <= P a/3`.
///
/// Source: Johnson (1985), *Contact Mechanics*, sections 3.4 and 5.5(c).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct TiltedPunch {
    /// Normal force P [force].
    pub force: f64,
    /// Slope θ [-].
    pub tilt: f64,
    /// Moment M about y, positive with the pressure to positive x [force x length].
    pub moment: f64,
    /// Radius a of the punch and of the contact [length].
    pub contact_radius: f64,
    /// Effective modulus E* [pressure].
    pub modulus: f64,
}

/// A flat punch of the half-width a and infinite length under a force P' per length and tilted by a slope θ across it, deeper at
/// positive x.
///
/// `M' = (π/4) E* a² θ`, `p = P'/(π √(a² − x²)) + (E*θ/2) x/√(a² − x²)`; in full contact while `M' <= P' a/2`.
///
/// Source: Johnson (1985), *Contact Mechanics*, section 2.8.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct TiltedLinePunch {
    /// Force per length P' [force / length].
    pub line_force: f64,
    /// Slope θ [-].
    pub tilt: f64,
    /// Moment per length M', positive with the pressure to positive x [force].
    pub moment: f64,
    /// Half-width a of the punch and of the contact [length].
    pub half_width: f64,
    /// Effective modulus E* [pressure].
    pub modulus: f64,
}

/// Refuses a tilt that lifts an edge.
fn full_contact(tilt: f64, limit: f64) -> Result<f64, AnalyticError> {
    within("tilt", tilt, tilt.is_finite(), "finite")?;
    if tilt.abs() > limit {
        let reason = "all of the punch is in contact up to";
        return Err(AnalyticError::TooLarge { name: "tilt", value: tilt, reason, limit });
    }
    Ok(tilt)
}

#[functions]
impl TiltedPunch {
    /// Punch of a radius under a force and a slope.
    ///
    /// # Errors
    /// When a value is out of range, or an edge would lift.
    pub fn new(punch_radius: f64, force: f64, modulus: f64, tilt: f64) -> Result<Self, AnalyticError> {
        let (a, force) = (positive("punch radius", punch_radius)?, positive("force", force)?);
        let modulus = effective_modulus(modulus)?;
        let tilt = full_contact(tilt, force / (4.0 * modulus * a * a))?;
        Ok(Self { force, tilt, moment: 4.0 / 3.0 * modulus * a.powi(3) * tilt, contact_radius: a, modulus })
    }

    /// Pressure at a point [pressure]; infinite at the edge, zero outside.
    #[shown]
    pub fn pressure(&self, x: f64, y: f64) -> f64 {
        let (a, r) = (self.contact_radius, x.hypot(y));
        if r > a {
            return 0.0;
        }
        let root = ((a - r) * (a + r)).sqrt();
        (self.force / (2.0 * PI * a) + 2.0 * self.modulus * self.tilt * x / PI) / root
    }
}

#[functions]
impl TiltedLinePunch {
    /// Punch of a half-width under a force per length and a slope.
    ///
    /// # Errors
    /// When a value is out of range, or an edge would lift.
    pub fn new(half_width: f64, line_force: f64, modulus: f64, tilt: f64) -> Result<Self, AnalyticError> {
        let (a, line_force) = (positive("half-width", half_width)?, positive("line force", line_force)?);
        let modulus = effective_modulus(modulus)?;
        let tilt = full_contact(tilt, 2.0 * line_force / (PI * modulus * a))?;
        Ok(Self { line_force, tilt, moment: PI / 4.0 * modulus * a * a * tilt, half_width: a, modulus })
    }

    /// Pressure at `x` from the middle [pressure]; infinite at the edge, zero outside.
    #[shown]
    pub fn pressure(&self, x: f64) -> f64 {
        let a = self.half_width;
        if x.abs() > a {
            return 0.0;
        }
        (self.line_force / PI + 0.5 * self.modulus * self.tilt * x) / ((a - x) * (a + x)).sqrt()
    }
}

/// `tilted_punch` in the catalogue.
pub(super) const OF_DISC: Form = Form {
    name: "tilted_punch",
    sentence: "Press a flat circular punch that is tilted by a slope, all of it in contact.",
    parameters: &[PUNCH_RADIUS, FORCE, MODULUS, TILT],
    solution: Contents::of::<TiltedPunch>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, tilt]| TiltedPunch::new(radius, force, modulus, tilt))
    },
};

/// `tilted_line_punch` in the catalogue.
pub(super) const OF_LINE: Form = Form {
    name: "tilted_line_punch",
    sentence: "Press a flat punch of infinite length that is tilted by a slope, all of it in contact.",
    parameters: &[number("half_width", "Half the width of the punch [length]."), LINE_FORCE, MODULUS, TILT],
    solution: Contents::of::<TiltedLinePunch>(),
    solve: |given| {
        solved(given, |[half_width, force, modulus, tilt]| {
            TiltedLinePunch::new(half_width, force, modulus, tilt)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::quadrature::integral;

    #[test]
    fn pressures_carry_force_and_moment() {
        let punch = TiltedPunch::new(2.0, 12.0, 3.0, 0.2).unwrap();
        // x = r cos, r = a sin(angle): the mean over a circle of p is that of the force, of p x half the amplitude times r
        let ring = |angle: f64, phi: f64| {
            let r = 2.0 * angle.sin();
            let here = punch.pressure(r * phi.cos(), r * phi.sin()) * 2.0 * angle.cos() * r;
            [here, here * r * phi.cos()]
        };
        let over =
            |part: usize| integral(0.0, 2.0 * PI, |phi| integral(0.0, 1.5, |angle| ring(angle, phi)[part]));
        assert!((over(0) / (12.0 * (1.0 - 1.5_f64.cos())) - 1.0).abs() < 1e-10);
        // of the moment (3/2) Int sin^3 up to the angle: 1 - (3/2) cos + cos^3/2
        let share = 1.0 - 1.5 * 1.5_f64.cos() + 0.5 * 1.5_f64.cos().powi(3);
        assert!((over(1) / (punch.moment * share) - 1.0).abs() < 1e-10);
        let line = TiltedLinePunch::new(2.0, 12.0, 3.0, 0.7).unwrap();
        let strip = |angle: f64| line.pressure(2.0 * angle.sin()) * 2.0 * angle.cos();
        assert!((integral(-1.5, 1.5, strip) / (12.0 * 3.0 / PI) - 1.0).abs() < 1e-10);
        let moment = integral(-1.5, 1.5, |angle| strip(angle) * 2.0 * angle.sin());
        assert!((moment / (line.moment * (3.0 - 3.0_f64.sin()) / PI) - 1.0).abs() < 1e-10);
    }

    #[test]
    fn an_edge_lifts_at_a_third_and_at_a_half_of_the_lever() {
        let most = 12.0 / (4.0 * 3.0 * 4.0);
        let punch = TiltedPunch::new(2.0, 12.0, 3.0, most * (1.0 - 1e-15)).unwrap();
        assert!((punch.moment / (12.0 * 2.0 / 3.0) - 1.0).abs() < 1e-14);
        assert!(
            punch.pressure(-2.0 + 1e-9, 0.0) >= 0.0
                && TiltedPunch::new(2.0, 12.0, 3.0, 1.001 * most).is_err()
        );
        let most = 2.0 * 12.0 / (PI * 3.0 * 2.0);
        let line = TiltedLinePunch::new(2.0, 12.0, 3.0, -most * (1.0 - 1e-15)).unwrap();
        assert!((line.moment / (-12.0 * 2.0 / 2.0) - 1.0).abs() < 1e-14);
        assert!(TiltedLinePunch::new(2.0, 12.0, 3.0, 1.001 * most).is_err());
    }
}
