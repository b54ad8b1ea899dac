//! A sphere under constant normal force, twisted about the normal for the first time.

use std::f64::consts::{FRAC_2_PI, PI};

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::elliptic_integrals::CompleteElliptic;
use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, solved};
use super::hertz::Hertz;
use super::parameter::{FRICTION, SPHERE, number};
use super::quadrature::integral;
use super::root::root_of_increasing;

/// Partial slip of a Hertz contact under a growing twisting moment M at constant normal force.
///
/// With `k² = 1 − c²/a²`: `twist = μp0/(2G) · (K − E)`, `M = (16/3) G twist c³ + 8μp0 ∫ t² (K − E) dt` from c to a, the integrals in it of
/// modulus² `1 − t²/a²`. Full slip: Hetényi & `McDonald` (1958).
/// Exact for any pair of homogeneous bodies: torsion does not couple with pressure.
///
/// Source: Lubkin (1951), J. Appl. Mech. 18, 183.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct Torsion {
    /// Twisting moment M [force x length], signed.
    pub moment: f64,
    /// Rotation of the upper body against the lower [rad], with the sign of M.
    pub twist: f64,
    /// Radius c of the disc that sticks [length].
    pub stick_radius: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Largest shear that friction holds anywhere, μp0 [pressure].
    pub max_shear: f64,
}

#[functions]
impl Torsion {
    /// Contact twisted by a moment; `shear_modulus` is G, `1/G = Σ 1/G` of the bodies.
    ///
    /// # Errors
    /// When μ or G is not positive and finite, or `|M|` reaches [`Self::full_slip_moment`], where the twist grows without bound.
    pub fn under_moment(
        hertz: &Hertz,
        friction: f64,
        shear_modulus: f64,
        moment: f64,
    ) -> Result<Self, AnalyticError> {
        let limit = Self::full_slip_moment(hertz, friction)?;
        let contact = Self::untwisted(hertz, friction);
        let shear_modulus = positive("shear modulus", shear_modulus)?;
        if moment.abs() >= limit || moment.is_nan() {
            return Err(AnalyticError::TooLarge {
                name: "twisting moment",
                value: moment,
                reason: "friction holds less than",
                limit,
            });
        }
        let slipped = root_of_increasing(0.0, 1.0, |slipped| contact.moment_at(slipped) - moment.abs());
        Ok(Self {
            moment,
            twist: contact.twist_at(slipped, shear_modulus).copysign(moment),
            stick_radius: contact.contact_radius * (1.0 - slipped).sqrt(),
            ..contact
        })
    }

    /// Contact twisted until only a disc of radius c sticks, `0 < c <= a`.
    ///
    /// # Errors
    /// When μ or G is not positive and finite, or c is out of range.
    pub fn with_stick_radius(
        hertz: &Hertz,
        friction: f64,
        shear_modulus: f64,
        stick_radius: f64,
    ) -> Result<Self, AnalyticError> {
        positive("friction", friction)?;
        let shear_modulus = positive("shear modulus", shear_modulus)?;
        let a = hertz.contact_radius;
        within(
            "stick radius",
            stick_radius,
            stick_radius > 0.0 && stick_radius <= a,
            "within the contact radius",
        )?;
        let contact = Self::untwisted(hertz, friction);
        let slipped = (a - stick_radius) * (a + stick_radius) / (a * a);
        Ok(Self {
            moment: contact.moment_at(slipped),
            twist: contact.twist_at(slipped, shear_modulus),
            stick_radius,
            ..contact
        })
    }

    /// Largest moment that friction holds, `3πμPa/16` [force x length].
    ///
    /// # Errors
    /// When μ is not positive and finite.
    pub fn full_slip_moment(hertz: &Hertz, friction: f64) -> Result<f64, AnalyticError> {
        Ok(3.0 * PI * positive("friction", friction)? * hertz.force * hertz.contact_radius / 16.0)
    }

    /// Circumferential shear at distance `r` from the middle [pressure], with the sign of M; zero outside the contact.
    ///
    /// `μp` in the rim; `q = (2μp0 r/π) ∫ E dt / (t √(t² − r²))` from c to a where the bodies stick.
    #[shown]
    pub fn shear(&self, r: f64) -> f64 {
        let (a, c, r) = (self.contact_radius, self.stick_radius, r.abs());
        let shape = if r >= c {
            (1.0 - (r / a).powi(2)).max(0.0).sqrt()
        } else {
            // t² = r² + s² takes the singularity away
            let integrand = |s: f64| {
                let t = r.hypot(s);
                CompleteElliptic::complementary((t / a).min(1.0)).second_kind / (t * t)
            };
            FRAC_2_PI * r * integral(((c - r) * (c + r)).sqrt(), ((a - r) * (a + r)).sqrt(), integrand)
        };
        (self.max_shear * shape).copysign(self.moment)
    }

    fn untwisted(hertz: &Hertz, friction: f64) -> Self {
        Self {
            moment: 0.0,
            twist: 0.0,
            stick_radius: hertz.contact_radius,
            contact_radius: hertz.contact_radius,
            max_shear: friction * hertz.max_pressure,
        }
    }

    /// Twist when the share `slipped = 1 − c²/a²` of the area slips.
    fn twist_at(&self, slipped: f64, shear_modulus: f64) -> f64 {
        self.max_shear / (2.0 * shear_modulus) * first_less_second(slipped)
    }

    /// Moment when the share `slipped` of the area slips; the integral over `1 − t²/a²` in place of t.
    fn moment_at(&self, slipped: f64) -> f64 {
        let stick = if slipped < 1.0 {
            8.0 / 3.0 * (1.0 - slipped).powf(1.5) * first_less_second(slipped)
        } else {
            0.0
        };
        let slip =
            integral(0.0, slipped, |m| 4.0 * (1.0 - m).max(0.0).sqrt() * first_less_second(m.min(BELOW_ONE)));
        self.max_shear * self.contact_radius.powi(3) * (stick + slip)
    }
}

/// The largest squared modulus whose integrals are finite.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON;

/// `K − E` of a squared modulus.
fn first_less_second(squared_modulus: f64) -> f64 {
    squared_modulus * CompleteElliptic::complementary((1.0 - squared_modulus).sqrt()).difference
}

/// `torsion` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "torsion",
    sentence: "Twist a Hertz contact about its normal for the first time; exact for any pair of homogeneous bodies.",
    parameters: &[
        SPHERE,
        FRICTION,
        number("shear_modulus", "Torsional shear modulus G [pressure]: ``effective_moduli(...).torsional``."),
        number("moment", "Torsional moment [force x length], less than ``3 pi mu P a / 16``."),
    ],
    solution: Contents::of::<Torsion>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, friction, shear_modulus, moment]| {
            Torsion::under_moment(&Hertz::sphere(radius, force, modulus)?, friction, shear_modulus, moment)
        })
    },
};

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::Torsion;
    use crate::analytic::hertz::tests::steel_example;
    use crate::analytic::quadrature::integral;

    const G: f64 = 200e3 / 2.6;

    #[test]
    fn twist_and_moment_match_printed_values() {
        let hertz = steel_example();
        let (a, p0) = (hertz.contact_radius, hertz.max_pressure);
        for (stick, twist, moment) in [
            (0.9, 0.080_663_279_7, 0.176_345_381_5),
            (0.7, 0.258_524_278_5, 0.409_738_479_6),
            (0.5, 0.472_729_81, 0.528_575_965_6),
            (0.3, 0.765_647_907_3, 0.576_868_042_6),
        ] {
            let torsion = Torsion::with_stick_radius(&hertz, 0.2, G, stick * a).unwrap();
            assert!((torsion.twist * G / (0.2 * p0) - twist).abs() < 1e-9);
            assert!((torsion.moment / (0.2 * 100.0 * a) - moment).abs() < 1e-10);
            let back = Torsion::under_moment(&hertz, 0.2, G, -torsion.moment).unwrap();
            assert!((back.stick_radius / torsion.stick_radius - 1.0).abs() < 1e-11);
            assert!((back.twist / torsion.twist + 1.0).abs() < 1e-11);
        }
        let limit = Torsion::full_slip_moment(&hertz, 0.2).unwrap();
        assert!((limit / (20.0 * a) - 0.589_048_622_5).abs() < 1e-10);
    }

    #[test]
    fn shear_carries_the_moment_and_meets_friction_at_the_stick_edge() {
        let hertz = steel_example();
        let a = hertz.contact_radius;
        for stick in [0.9, 0.5, 0.1] {
            let torsion = Torsion::with_stick_radius(&hertz, 0.2, G, stick * a).unwrap();
            let ring = |r: f64| 2.0 * PI * r * r * torsion.shear(r);
            let carried = integral(0.0, stick * a, ring) + integral(stick * a, a, ring);
            assert!((carried / torsion.moment - 1.0).abs() < 1e-9);
            let inside = torsion.shear(stick * a * (1.0 - 1e-12));
            assert!((inside / (0.2 * hertz.pressure(stick * a)) - 1.0).abs() < 1e-5); // square root of the distance
        }
    }

    #[test]
    fn a_small_moment_meets_the_stiffness_without_slip() {
        let hertz = steel_example();
        let torsion = Torsion::under_moment(&hertz, 0.2, G, 1e-8).unwrap();
        assert!(
            (torsion.moment / torsion.twist / (16.0 / 3.0 * G * hertz.contact_radius.powi(3)) - 1.0).abs()
                < 1e-6
        );
        assert_eq!(Torsion::under_moment(&hertz, 0.2, G, 0.0).unwrap().twist, 0.0);
    }

    #[test]
    fn the_full_slip_moment_is_refused_because_its_twist_is_infinite() {
        let hertz = steel_example();
        let limit = Torsion::full_slip_moment(&hertz, 0.2).unwrap();
        assert!(Torsion::under_moment(&hertz, 0.2, G, limit).is_err());
        assert!(Torsion::under_moment(&hertz, 0.2, G, 0.999_999 * limit).is_ok());
        assert!(Torsion::with_stick_radius(&hertz, 0.2, G, 0.0).is_err());
    }
}
