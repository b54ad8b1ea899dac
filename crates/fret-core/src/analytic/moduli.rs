//! Effective moduli of two homogeneous bodies: how compliant they are together.

use fret_table::Numbers;
use serde::Serialize;

use super::error::{AnalyticError, positive, within};
use super::form::{Contents, Form, Functions, Solved};
use super::parameter::{LOWER, UPPER};
use crate::model::ElasticMaterial;

/// Effective moduli of two homogeneous half-spaces; a rigid body adds no compliance.
///
/// Source: Johnson (1985), *Contact Mechanics*, sections 4.2 and 7.2; Dundurs (1969) for the coupling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Numbers)]
#[non_exhaustive]
pub struct EffectiveModuli {
    /// `1/E* = Σ (1 − ν²)/E` [pressure]: normal contact.
    pub normal: f64,
    /// `1/G* = Σ (2 − ν)/G` [pressure]: tangential contact.
    pub shear: f64,
    /// `1/G = Σ 1/G` [pressure]: torsion.
    pub torsional: f64,
    /// Dundurs' `β = [(1 − 2ν)/G lower − upper] / (2 Σ (1 − ν)/G)` [-]: normal-tangential coupling, 0 for elastically similar bodies.
    pub coupling: f64,
}

impl EffectiveModuli {
    /// Moduli of a rigid body on an elastic one.
    pub fn rigid_on(lower: &ElasticMaterial) -> Self {
        Self::of_compliances(Compliances::default(), Compliances::of(lower))
    }

    /// Moduli of two elastic bodies.
    pub fn of_pair(upper: &ElasticMaterial, lower: &ElasticMaterial) -> Self {
        Self::of_compliances(Compliances::of(upper), Compliances::of(lower))
    }

    fn of_compliances(upper: Compliances, lower: Compliances) -> Self {
        let normal = upper.normal + lower.normal;
        Self {
            normal: 2.0 / normal,
            shear: 1.0 / (upper.tangential + lower.tangential),
            torsional: 1.0 / (upper.torsional + lower.torsional),
            coupling: (lower.coupling - upper.coupling) / (2.0 * normal),
        }
    }
}

impl Functions for EffectiveModuli {}

/// One body's compliances, each times its shear modulus a function of Poisson's ratio alone.
#[derive(Clone, Copy, Default)]
struct Compliances {
    normal: f64,
    tangential: f64,
    torsional: f64,
    coupling: f64,
}

impl Compliances {
    fn of(material: &ElasticMaterial) -> Self {
        let (shear_modulus, poisson) = (material.shear_modulus(), material.poisson());
        Self {
            normal: (1.0 - poisson) / shear_modulus, // = 2 (1 − ν²) / E
            tangential: (2.0 - poisson) / shear_modulus,
            torsional: 1.0 / shear_modulus,
            coupling: (1.0 - 2.0 * poisson) / shear_modulus,
        }
    }
}

/// The effective normal modulus E* itself when usable.
pub(super) fn effective_modulus(value: f64) -> Result<f64, AnalyticError> {
    positive("effective modulus", value)
}

/// Dundurs' coupling β itself when usable.
pub(super) fn coupling(value: f64) -> Result<f64, AnalyticError> {
    within("coupling", value, value.abs() < 1.0, "between -1 and 1")
}

/// `effective_moduli` in the catalogue.
pub(super) const FORM: Form = Form {
    name: "effective_moduli",
    sentence: r#"Effective moduli of two bodies, each ``{"young": ..., "poisson": ...}``; default: a rigid upper body."#,
    parameters: &[LOWER, UPPER],
    solution: Contents::of::<EffectiveModuli>(),
    solve: |given| match *given {
        [young, poisson] => Ok(Solved::of(EffectiveModuli::rigid_on(&ElasticMaterial::new(young, poisson)?))),
        [young, poisson, upper_young, upper_poisson] => {
            let upper = ElasticMaterial::new(upper_young, upper_poisson)?;
            Ok(Solved::of(EffectiveModuli::of_pair(&upper, &ElasticMaterial::new(young, poisson)?)))
        }
        _ => Err(AnalyticError::NumbersGiven(given.len())),
    },
};

#[cfg(test)]
mod tests {
    use super::EffectiveModuli;
    use crate::model::ElasticMaterial;

    #[test]
    fn moduli_follow_their_definitions() {
        let steel = ElasticMaterial::new(210e9, 0.3).unwrap();
        let glass = ElasticMaterial::new(70e9, 0.2).unwrap();
        let pair = EffectiveModuli::of_pair(&steel, &glass);
        assert!((1.0 / pair.normal * 210e9 - (0.91 + 3.0 * 0.96)).abs() < 1e-14);
        let (g_steel, g_glass) = (210e9 / 2.6, 70e9 / 2.4);
        assert!((pair.shear * (1.7 / g_steel + 1.8 / g_glass) - 1.0).abs() < 1e-14);
        assert!((pair.torsional * (1.0 / g_steel + 1.0 / g_glass) - 1.0).abs() < 1e-14);
        assert!((pair.coupling + EffectiveModuli::of_pair(&glass, &steel).coupling).abs() < 1e-16);
    }

    #[test]
    fn like_bodies_do_not_couple_and_are_twice_as_compliant_as_one_on_a_rigid_body() {
        let steel = ElasticMaterial::new(210e9, 0.3).unwrap();
        let (like, rigid) = (EffectiveModuli::of_pair(&steel, &steel), EffectiveModuli::rigid_on(&steel));
        assert_eq!(like.coupling, 0.0);
        assert!((rigid.coupling - 0.4 / 1.4).abs() < 1e-15);
        for (one, other) in
            [(rigid.normal, like.normal), (rigid.shear, like.shear), (rigid.torsional, like.torsional)]
        {
            assert!((one / other - 2.0).abs() < 1e-14);
        }
    }
}
