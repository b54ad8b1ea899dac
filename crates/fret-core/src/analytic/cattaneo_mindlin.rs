//! A sphere under constant normal force, pushed sideways for the first time.

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, solved};
use super::hertz::Hertz;
use super::parameter::{FRICTION, SHEAR_MODULUS, SPHERE, TANGENTIAL_FORCE};

/// Partial slip of a Hertz contact under a growing tangential force T at constant normal force P.
///
/// With `f = |T|/μP`: `c = a (1 − f)^(1/3)`, `q = μ [p(r; a) − p(r; c)]` where `p(r; s) = p0 √(s² − r²)/a`,
/// `shift = 3μP/(16aG*) · [1 − (1 − f)^(2/3)]`.
/// Exact for uncoupled bodies (β = 0) with ν = 0 only: otherwise it neglects the slip across the force, of order `ν/(4 − 2ν)`.
/// At `|T| = μP` the shift is that at the onset of full slip, the least possible.
///
/// Source: Cattaneo (1938); Mindlin (1949); Johnson (1985), *Contact Mechanics*, section 7.2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct CattaneoMindlin {
    /// Tangential force T [force], signed.
    pub tangential_force: f64,
    /// Largest tangential force that friction holds, μP [force].
    pub sliding_force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Largest shear that friction holds anywhere, μp0 [pressure].
    pub max_shear: f64,
    /// Tangential stiffness before any slip, `8aG*` [force / length].
    pub initial_stiffness: f64,
    /// Radius c of the disc that sticks [length].
    pub stick_radius: f64,
    /// Tangential shift of the bodies [length], with the sign of T.
    pub shift: f64,
}

#[functions]
impl CattaneoMindlin {
    /// Partial slip from the normal contact, the friction coefficient μ [-], the effective shear modulus G* [pressure] and T [force].
    ///
    /// # Errors
    /// When μ or G* is not positive and finite, or `|T| > μP`.
    pub fn new(
        hertz: &Hertz,
        friction: f64,
        shear_modulus: f64,
        tangential_force: f64,
    ) -> Result<Self, AnalyticError> {
        Self::unloaded(hertz, friction, shear_modulus)?.checked_under("tangential force", tangential_force)
    }

    pub(super) fn unloaded(hertz: &Hertz, friction: f64, shear_modulus: f64) -> Result<Self, AnalyticError> {
        let (friction, shear_modulus) =
            (positive("friction", friction)?, positive("effective shear modulus", shear_modulus)?);
        Ok(Self {
            tangential_force: 0.0,
            sliding_force: friction * hertz.force,
            contact_radius: hertz.contact_radius,
            max_shear: friction * hertz.max_pressure,
            initial_stiffness: 8.0 * hertz.contact_radius * shear_modulus,
            stick_radius: hertz.contact_radius,
            shift: 0.0,
        })
    }

    /// The same contact under another tangential force.
    pub(super) fn checked_under(
        &self,
        name: &'static str,
        tangential_force: f64,
    ) -> Result<Self, AnalyticError> {
        if tangential_force.abs() <= self.sliding_force {
            Ok(self.under(tangential_force))
        } else {
            Err(AnalyticError::TooLarge {
                name,
                value: tangential_force,
                reason: "friction holds at most",
                limit: self.sliding_force,
            })
        }
    }

    /// The same contact under another tangential force, known to be one that friction holds.
    pub(super) fn under(&self, tangential_force: f64) -> Self {
        let mut loaded = *self;
        loaded.tangential_force = tangential_force;
        loaded.stick_radius = self.contact_radius * (1.0 - loaded.load_ratio()).cbrt();
        loaded.shift = (self.full_slip_shift() * loaded.lost_to_slip(2.0)).copysign(tangential_force);
        loaded
    }

    /// Shift at the onset of full slip, `3μP/(16aG*)` [length].
    #[shown]
    pub fn full_slip_shift(&self) -> f64 {
        1.5 * self.sliding_force / self.initial_stiffness
    }

    /// Shear at distance `r` from the middle [pressure], along the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, r: f64) -> f64 {
        let (a, c, r) = (self.contact_radius, self.stick_radius, r.abs());
        let shape = if r >= a {
            0.0
        } else if r >= c {
            ((a - r) * (a + r)).sqrt() / a
        } else {
            // √(a² − r²) − √(c² − r²), without the cancellation
            a * self.lost_to_slip(2.0) / (((a - r) * (a + r)).sqrt() + ((c - r) * (c + r)).sqrt())
        };
        self.max_shear * shape * self.sign()
    }

    /// Slip of the upper body on the lower at distance `r` [length], along the force; zero where the bodies stick.
    ///
    /// `3μP r²/(32a³G*) · [(1 − (2/π) asin(c/r))(1 − 2c²/r²) + (2/π)(c/r) √(1 − c²/r²)]` for `c <= r <= a`: the shift less the
    /// displacement inside the disc a and outside the disc c, averaged over the direction. Source: Johnson (1985), §7.2.
    #[shown]
    pub fn slip(&self, r: f64) -> f64 {
        let (a, c, r) = (self.contact_radius, self.stick_radius, r.abs());
        if r <= c || r > a {
            return 0.0;
        }
        let s = c / r;
        let shape = std::f64::consts::FRAC_2_PI
            * (s.acos() * (1.0 - 2.0 * s * s) + s * ((1.0 - s) * (1.0 + s)).sqrt());
        self.full_slip_shift() * (r / a).powi(2) / 2.0 * shape * self.sign()
    }

    /// Energy dissipated by friction since the tangential force was zero [force x length].
    ///
    /// `3(μP)²/(80aG*) · (1 − c/a)³ (1 + 3c/a + c²/a²)`: a quarter of the loss in a cycle of this amplitude.
    #[shown]
    pub fn dissipated_energy(&self) -> f64 {
        let stick = self.stick_radius / self.contact_radius;
        let shape = self.lost_to_slip(1.0).powi(3) * (1.0 + 3.0 * stick + stick * stick);
        0.3 * self.sliding_force.powi(2) / self.initial_stiffness * shape
    }

    fn load_ratio(&self) -> f64 {
        (self.tangential_force.abs() / self.sliding_force).min(1.0)
    }

    /// `1 − (c/a)^power`, exact for small loads.
    fn lost_to_slip(&self, power: f64) -> f64 {
        -((-self.load_ratio()).ln_1p() * power / 3.0).exp_m1()
    }

    fn sign(&self) -> f64 {
        1.0_f64.copysign(self.tangential_force)
    }
}

/// `cattaneo_mindlin` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "cattaneo_mindlin",
    sentence: "Partial slip of a Hertz contact under a first tangential load.",
    parameters: &[SPHERE, FRICTION, SHEAR_MODULUS, TANGENTIAL_FORCE],
    solution: Contents::of::<CattaneoMindlin>(),
    solve: |given| {
        solved(given, |[radius, normal, modulus, friction, shear_modulus, tangential]| {
            CattaneoMindlin::new(
                &Hertz::sphere(radius, normal, modulus)?,
                friction,
                shear_modulus,
                tangential,
            )
        })
    },
};

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::PI;

    use super::CattaneoMindlin;
    use crate::analytic::hertz::tests::steel_example;
    use crate::analytic::quadrature::integral;

    pub(in crate::analytic) const STEEL_SHEAR_MODULUS: f64 = 200e3 / 2.6 / 1.7; // a rigid sphere on steel [MPa]

    fn example(load_ratio: f64) -> CattaneoMindlin {
        CattaneoMindlin::new(&steel_example(), 0.1, STEEL_SHEAR_MODULUS, 10.0 * load_ratio).unwrap()
    }

    #[test]
    fn stick_radius_and_shift_match_printed_values() {
        for (f, stick) in [(0.5, 0.793_700_526), (0.754, 0.626_582_655_6), (0.92, 0.430_886_938)] {
            let slip = example(f);
            assert!((slip.stick_radius / slip.contact_radius - stick).abs() < 1e-9);
        }
        assert!((example(0.5).shift - 1.018_475_80e-4).abs() < 1e-12);
        assert!((example(0.92).shift - 2.241_333_75e-4).abs() < 1e-12);
    }

    #[test]
    fn shear_carries_the_force_and_stays_within_friction() {
        let hertz = steel_example();
        for f in [1e-9, 0.3, -0.92, 1.0] {
            let slip = example(f);
            let ring = |r: f64| 2.0 * PI * r * slip.shear(r);
            let (a, c) = (slip.contact_radius, slip.stick_radius);
            let carried = integral(0.0, c, ring) + integral(c, a, ring);
            assert!(
                (carried / (10.0 * f) - 1.0).abs() < if f < 1e-6 { 1e-6 } else { 1e-12 },
                "{carried} {f}"
            );
            for k in 0..50 {
                let r = f64::from(k) / 49.0 * a;
                assert!(slip.shear(r).abs() <= 0.1 * hertz.pressure(r) * (1.0 + 1e-14));
            }
        }
    }

    #[test]
    fn friction_times_slip_is_the_dissipated_energy() {
        // In the rim the shear is μp from the moment the slip reaches it, so the work is ∫ μp s dA.
        let hertz = steel_example();
        for f in [0.2, 0.7, 1.0] {
            let slip = example(f);
            let ring = |r: f64| 2.0 * PI * r * 0.1 * hertz.pressure(r) * slip.slip(r);
            let work = integral(slip.stick_radius, slip.contact_radius, ring);
            assert!((work / slip.dissipated_energy() - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn a_small_load_meets_the_initial_stiffness() {
        let slip = example(1e-6);
        assert!((slip.tangential_force / slip.shift / slip.initial_stiffness - 1.0).abs() < 1e-6); // 1 − f/6
        assert_eq!(example(1.0).stick_radius, 0.0);
        assert_eq!(example(1.0).shift, example(1.0).full_slip_shift());
    }

    #[test]
    fn more_than_friction_holds_is_refused() {
        let refusal = CattaneoMindlin::new(&steel_example(), 0.1, 1e4, -12.0).unwrap_err().to_string();
        assert!(refusal.starts_with("tangential force = -12: friction holds at most 10"), "{refusal}");
        assert!(CattaneoMindlin::new(&steel_example(), 0.0, 1e4, 0.0).is_err());
        assert!(CattaneoMindlin::new(&steel_example(), 0.1, 1e4, f64::NAN).is_err());
    }
}
