//! Bodies that stick wherever they touch while the normal force grows.

use std::f64::consts::PI;

use fret_table::Numbers;
use serde::Serialize;

use super::error::{AnalyticError, positive};
use super::form::{Contents, Form, Functions, solved};
use super::moduli;
use super::parameter::{COUPLING, FORCE, MODULUS, PUNCH_RADIUS, RADIUS};
use super::quadrature::integral;

/// Flat circular punch that sticks completely.
///
/// `P = 2E* a δ · ln((1 + β)/(1 − β))/(2β)`; for a rigid punch `β = (1 − 2ν)/(2(1 − ν))` and the factor is
/// `(1 − ν) ln(3 − 4ν)/(1 − 2ν)`.
///
/// Source: Mossakovskii (1954), PMM 18, 187; Spence (1968), Proc. R. Soc. A 305, 55.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct NoSlipPunch {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the punch and of the contact [length].
    pub contact_radius: f64,
    /// Approach δ [length].
    pub approach: f64,
    /// Force over that of the frictionless punch at the same approach [-].
    pub force_ratio: f64,
}

/// Sphere that sticks as it touches.
///
/// `δ = κ a²/R`, `κ = 1 / (2 ∫ t cos(θ ln((1 + t)/(1 − t))) dt)` over 0..1, `θ = ln((1 + β)/(1 − β))/(2π)`;
/// `P = κ · (punch's ratio) · 4E*a³/(3R)`.
/// For forces that only grow from zero. Coupling 0 gives the Hertz contact.
///
/// Source: Mossakovskii (1963); Spence (1968), Proc. R. Soc. A 305, 55.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct NoSlipSphere {
    /// Normal force P [force].
    pub force: f64,
    /// Radius a of the contact [length].
    pub contact_radius: f64,
    /// Approach δ [length].
    pub approach: f64,
    /// `κ = δ R/a²` [-].
    pub approach_factor: f64,
    /// Force over that of the frictionless sphere at the same contact radius [-].
    pub force_ratio: f64,
}

impl NoSlipPunch {
    /// Punch of a radius under a normal force, on bodies of effective modulus E* [pressure] and Dundurs' coupling β [-].
    ///
    /// # Errors
    /// When a value is not positive and finite, or the coupling is not between -1 and 1.
    pub fn new(punch_radius: f64, force: f64, modulus: f64, coupling: f64) -> Result<Self, AnalyticError> {
        let (contact_radius, force) = (positive("punch radius", punch_radius)?, positive("force", force)?);
        let modulus = moduli::effective_modulus(modulus)?;
        let force_ratio = stiffening(moduli::coupling(coupling)?);
        Ok(Self {
            force,
            contact_radius,
            approach: force / (2.0 * modulus * contact_radius * force_ratio),
            force_ratio,
        })
    }
}

impl Functions for NoSlipPunch {}

impl NoSlipSphere {
    /// Sphere of relative radius R under a normal force, on bodies of effective modulus E* [pressure] and Dundurs' coupling β [-].
    ///
    /// # Errors
    /// When a value is not positive and finite, or the coupling is not between -1 and 1.
    pub fn new(sphere_radius: f64, force: f64, modulus: f64, coupling: f64) -> Result<Self, AnalyticError> {
        let (sphere_radius, force) = (positive("sphere radius", sphere_radius)?, positive("force", force)?);
        let modulus = moduli::effective_modulus(modulus)?;
        let approach_factor = sphere_approach_factor(moduli::coupling(coupling)?);
        let force_ratio = approach_factor * stiffening(coupling);
        let contact_radius = (0.75 * force * sphere_radius / (modulus * force_ratio)).cbrt();
        let approach = approach_factor * contact_radius * contact_radius / sphere_radius;
        Ok(Self { force, contact_radius, approach, approach_factor, force_ratio })
    }
}

impl Functions for NoSlipSphere {}

/// `ln((1 + β)/(1 − β)) / (2β)` [-].
fn stiffening(coupling: f64) -> f64 {
    if coupling == 0.0 { 1.0 } else { coupling.atanh() / coupling }
}

/// κ of [`NoSlipSphere`], with `t = tanh v` in its integral.
fn sphere_approach_factor(coupling: f64) -> f64 {
    let theta = coupling.atanh() / PI;
    let beyond_rounding = 20.0;
    let integrand = |v: f64| v.tanh() / v.cosh().powi(2) * (2.0 * theta * v).cos();
    0.5 / integral(0.0, beyond_rounding, integrand)
}

/// `no_slip_punch` in the catalogue.
pub(super) const PUNCH: Form = Form {
    name: "no_slip_punch",
    sentence: "Press a flat circular punch that sticks; `coupling` is Dundurs' beta [-].",
    parameters: &[PUNCH_RADIUS, FORCE, MODULUS, COUPLING],
    solution: Contents::of::<NoSlipPunch>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, coupling]| NoSlipPunch::new(radius, force, modulus, coupling))
    },
};

/// `no_slip_sphere` in the catalogue.
pub(super) const SPHERE: Form = Form {
    name: "no_slip_sphere",
    sentence: "Press a sphere that sticks as it touches; `coupling` is Dundurs' beta [-], 0 gives the Hertz contact.",
    parameters: &[RADIUS, FORCE, MODULUS, COUPLING],
    solution: Contents::of::<NoSlipSphere>(),
    solve: |given| {
        solved(given, |[radius, force, modulus, coupling]| {
            NoSlipSphere::new(radius, force, modulus, coupling)
        })
    },
};

#[cfg(test)]
mod tests {
    use super::{NoSlipPunch, NoSlipSphere};
    use crate::analytic::hertz::Hertz;
    use crate::analytic::moduli::EffectiveModuli;
    use crate::model::ElasticMaterial;

    fn rigid_on(poisson: f64) -> EffectiveModuli {
        EffectiveModuli::rigid_on(&ElasticMaterial::new(1.0, poisson).unwrap())
    }

    #[test]
    fn punch_stiffening_matches_printed_values() {
        for (poisson, ratio) in [
            (0.0, 1.098_612),
            (0.1, 1.074_950),
            (0.2, 1.051_276),
            (0.3, 1.028_627),
            (0.4, 1.009_417),
            (0.45, 1.002_769),
        ] {
            let moduli = rigid_on(poisson);
            let punch = NoSlipPunch::new(2.0, 3.0, moduli.normal, moduli.coupling).unwrap();
            assert!((punch.force_ratio - ratio).abs() < 5.1e-7);
            assert!((punch.force / (4.0 * moduli.normal * punch.approach) / ratio - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn sphere_matches_printed_values() {
        // Digits confirmed to 6-7 places by an independent axisymmetric boundary-element solution.
        for (poisson, factor, force, same_approach, radius) in [
            (0.0, 1.088_733_748, 1.196_096_275, 1.052_891_477, 0.942_058_677),
            (0.1, 1.066_369_619, 1.146_294_423, 1.040_961_180, 0.955_508_615),
            (0.2, 1.044_692_545, 1.098_260_702, 1.028_543_586, 0.969_240_423),
            (0.3, 1.024_580_243, 1.053_910_557, 1.016_213_100, 0.982_649_751),
            (0.4, 1.007_984_730, 1.017_476_630, 1.005_410_724, 0.994_241_421),
            (0.45, 1.002_337_439, 1.005_112_473, 1.001_598_658, 0.998_301_628),
        ] {
            let moduli = rigid_on(poisson);
            let sphere = NoSlipSphere::new(4.0, 1e-3, moduli.normal, moduli.coupling).unwrap();
            let hertz = Hertz::sphere(4.0, 1e-3, moduli.normal).unwrap();
            let deep = Hertz::sphere_at_approach(4.0, sphere.approach, moduli.normal).unwrap();
            assert!((sphere.approach_factor - factor).abs() < 1e-9);
            assert!((sphere.force_ratio - force).abs() < 1e-9);
            assert!((sphere.force / deep.force - same_approach).abs() < 1e-9);
            assert!((sphere.contact_radius / hertz.contact_radius - radius).abs() < 1e-9);
        }
    }

    #[test]
    fn without_coupling_sticking_changes_nothing() {
        let (sphere, hertz) =
            (NoSlipSphere::new(1.0, 1.0, 5.0, 0.0).unwrap(), Hertz::sphere(1.0, 1.0, 5.0).unwrap());
        assert!((sphere.contact_radius / hertz.contact_radius - 1.0).abs() < 1e-13);
        assert!((sphere.approach / hertz.approach - 1.0).abs() < 1e-13);
        assert!(NoSlipSphere::new(1.0, 1.0, 5.0, 1.0).is_err());
    }
}
