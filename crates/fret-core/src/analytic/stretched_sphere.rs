//! A sphere pressed on a half-space that is stretched.

use fret_table::{Numbers, functions};
use serde::Serialize;

use super::cattaneo_line::stick_ratio;
use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, Functions, solved};
use super::hertz::Hertz;
use super::moduli::effective_modulus;
use super::parameter::{FRICTION, SHEAR_MODULUS, SPHERE, STRAIN, TANGENTIAL_FORCE};

/// Partial slip of a Hertz contact of bodies with Poisson's ratio 0 under a tangential force T along x and a strain along x that
/// grows with it.
///
/// With `f = |T|/μP`: `q = μp0 [√(1 − r²/a²) − (c/a) √(1 − ((x − e)² + y²)/c²)]`, `c = a (1 − f)^(1/3)`, `e = a 8 G* ε/(πμp0)`: what sticks is
/// an offset circle. ε is the strain of the lower surface less that of the upper one; `e = aσ/(πμp0)` under a tension σ of one of two
/// bodies of one elasticity. Exact for uncoupled bodies with ν = 0, as long as all that slips slips one way: `|e| + c <= a`.
///
/// Source: the field of an ellipsoidal shear is uniform in strain; as for the line of Nowell & Hills (1987).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct StretchedSphere {
    /// Tangential force T along x [force], signed.
    pub tangential_force: f64,
    /// Largest tangential force that friction holds, μP [force].
    pub sliding_force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Largest shear that friction holds anywhere, μp0 [pressure].
    pub max_shear: f64,
    /// Radius c of the disc that sticks [length].
    pub stick_radius: f64,
    /// Middle e of that disc along x [length].
    pub stick_offset: f64,
}

#[functions]
impl StretchedSphere {
    /// Partial slip from the normal contact, the friction coefficient μ [-], the effective shear modulus G* [pressure], T and the
    /// relative strain ε along x [-].
    ///
    /// # Errors
    /// When μ or G* is not positive and finite, `|T| > μP`, or the strain makes the contact slip in opposite senses.
    pub fn new(
        hertz: &Hertz,
        friction: f64,
        shear_modulus: f64,
        tangential_force: f64,
        strain: f64,
    ) -> Result<Self, AnalyticError> {
        let friction = positive("friction", friction)?;
        let shear_modulus = positive("effective shear modulus", shear_modulus)?;
        within("strain", strain, strain.is_finite(), "finite")?;
        let (a, sliding_force) = (hertz.contact_radius, friction * hertz.force);
        let max_shear = friction * hertz.max_pressure;
        if !(tangential_force.abs() <= sliding_force) {
            return Err(AnalyticError::TooLarge {
                name: "tangential force",
                value: tangential_force,
                reason: "friction holds at most",
                limit: sliding_force,
            });
        }
        let stick_radius = a * (1.0 - tangential_force.abs() / sliding_force).cbrt();
        let per_strain = 8.0 * a * shear_modulus / (std::f64::consts::PI * max_shear);
        let limit = (a - stick_radius) / per_strain;
        if strain.abs() > limit {
            return Err(AnalyticError::TooLarge {
                name: "strain",
                value: strain,
                reason: "all that slips slips one way up to",
                limit,
            });
        }
        let stick_offset = per_strain * strain * if tangential_force < 0.0 { -1.0 } else { 1.0 };
        Ok(Self { tangential_force, sliding_force, contact_radius: a, max_shear, stick_radius, stick_offset })
    }

    /// Shear along x at a point [pressure], with the sign of the force; zero outside the contact.
    #[shown]
    pub fn shear(&self, x: f64, y: f64) -> f64 {
        let a = self.contact_radius;
        let root = |x: f64, radius: f64| {
            let r = x.hypot(y);
            ((radius - r) * (radius + r)).max(0.0).sqrt() / a
        };
        let sign = if self.tangential_force < 0.0 { -1.0 } else { 1.0 };
        sign * self.max_shear * (root(x, a) - root(x - self.stick_offset, self.stick_radius))
    }
}

/// A Hertz contact of bodies that do not couple, stretched alike in all directions of the surface against each other.
///
/// A ring slips along the radius and a disc sticks: `E* ε/(μp0) = K(k) − E(k)`, `k² = 1 − c²/a²`, for a strain that grows at a constant
/// normal force and any Poisson's ratio.
///
/// Source: the integral equation of Lubkin (1951), J. Appl. Mech. 18, 183, whose torsion has the same kernel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct EquibiaxialSphere {
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Radius c of the disc that sticks [length].
    pub stick_radius: f64,
}

impl EquibiaxialSphere {
    /// The contact under a relative strain ε [-] in all directions; E* is the effective modulus [pressure].
    ///
    /// # Errors
    /// When μ or E* is not positive and finite, or the strain is not finite.
    pub fn new(hertz: &Hertz, friction: f64, modulus: f64, strain: f64) -> Result<Self, AnalyticError> {
        let (friction, modulus) = (positive("friction", friction)?, effective_modulus(modulus)?);
        within("strain", strain, strain.is_finite(), "finite")?;
        let stick = stick_ratio(modulus * strain.abs() / (friction * hertz.max_pressure));
        Ok(Self { contact_radius: hertz.contact_radius, stick_radius: stick * hertz.contact_radius })
    }
}

impl Functions for EquibiaxialSphere {}

/// `stretched_sphere` in the catalogue.
pub(super) const ALONG_X: Form = Form {
    name: "stretched_sphere",
    sentence: "Push a Hertz contact along x while a strain along x grows in proportion; Poisson's ratio 0.",
    parameters: &[SPHERE, FRICTION, SHEAR_MODULUS, TANGENTIAL_FORCE, STRAIN],
    solution: Contents::of::<StretchedSphere>(),
    solve: |given| {
        solved(given, |[radius, normal, modulus, friction, shear_modulus, tangential, strain]| {
            StretchedSphere::new(
                &Hertz::sphere(radius, normal, modulus)?,
                friction,
                shear_modulus,
                tangential,
                strain,
            )
        })
    },
};

/// `equibiaxial_sphere` in the catalogue.
pub(super) const EQUIBIAXIAL: Form = Form {
    name: "equibiaxial_sphere",
    sentence: "Stretch a Hertz contact alike in all directions: ``E* strain/(mu p0) = K(k) - E(k)``, ``k^2 = 1 - c^2/a^2``.",
    parameters: &[SPHERE, FRICTION, STRAIN],
    solution: Contents::of::<EquibiaxialSphere>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, friction, strain]| {
            EquibiaxialSphere::new(&Hertz::sphere(radius, force, modulus)?, friction, modulus, strain)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::EffectiveModuli;
    use crate::model::ElasticMaterial;

    #[test]
    fn an_offset_circle_sticks_and_the_shear_carries_the_force() {
        // tension sigma of one of two equal bodies: e/a = sigma/(pi mu p0), strain sigma/E at nu = 0
        let (young, friction, sigma) = (2.0, 0.3, 0.002);
        let material = ElasticMaterial::new(young, 0.0).unwrap();
        let moduli = EffectiveModuli::of_pair(&material, &material);
        let hertz = Hertz::sphere(10.0, 1e-3, moduli.normal).unwrap();
        let force = 0.6 * friction * hertz.force;
        let found = StretchedSphere::new(&hertz, friction, moduli.shear, force, sigma / young).unwrap();
        let expected = sigma / (std::f64::consts::PI * friction * hertz.max_pressure);
        assert!((found.stick_offset / found.contact_radius / expected - 1.0).abs() < 1e-14);
        assert!((found.stick_radius / found.contact_radius - 0.4_f64.cbrt()).abs() < 1e-15);
        let (cells, a) = (2000_i32, found.contact_radius);
        let side = 2.0 * a / f64::from(cells);
        let at = |i: i32| -a + (f64::from(i) + 0.5) * side;
        let carried: f64 = (0..cells)
            .flat_map(|i| (0..cells).map(move |j| (i, j)))
            .map(|(i, j)| found.shear(at(i), at(j)) * side * side)
            .sum();
        assert!((carried / force - 1.0).abs() < 1e-4); // the square root at the edges, in cells
        assert!(StretchedSphere::new(&hertz, friction, moduli.shear, 0.0, 1e-9).is_err());
    }

    #[test]
    fn stretching_alike_in_all_directions_leaves_a_disc_stuck() {
        let hertz = Hertz::sphere(10.0, 1e-3, 1.5).unwrap();
        for (stick, load) in [(0.9, 0.161_327), (0.5, 0.945_460)] {
            let strain = load * 0.3 * hertz.max_pressure / 1.5;
            let found = EquibiaxialSphere::new(&hertz, 0.3, 1.5, strain).unwrap();
            assert!((found.stick_radius / found.contact_radius - stick).abs() < 2e-6); // 6 digits of the load
        }
    }
}
