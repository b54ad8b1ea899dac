//! Constants of a material for fatigue and fracture. None is built in: what has no constants is not computed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::invariants::Endurance;
use crate::document::{Keys, Range, Table};

/// An angle of a crack.
const ANGLE: Range = Range::between(-90.0, 90.0, "must lie between -90 and 90 degrees");

/// Constants of a layer for fatigue and fracture, each for what it is needed for.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, Table, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FatigueConstants {
    /// Yield strength [pressure], for Fatemi and Socie and for elastic shakedown.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub yield_strength: Option<f64>,
    /// Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::NOT_NEGATIVE)]
    pub normal_stress_sensitivity: Option<f64>,
    /// Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub torsion_limit: Option<f64>,
    /// Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub tension_limit: Option<f64>,
    /// Critical distance L [length]: parameters are also told at the depth L/2 (point method) and as means down to 2 L (line method).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub critical_distance: Option<f64>,
    /// Life in tension over the normal strain, for cycles to initiation by Smith, Watson and Topper.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_life: Option<StrainLife>,
    /// Life in torsion over the shear strain, for cycles to initiation by Fatemi and Socie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_life: Option<StrainLife>,
    /// Growth of a short crack from the most severe place of the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crack: Option<CrackConstants>,
    /// Fracture energy of a coating [force/length], for channelling cracks.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub fracture_energy: Option<f64>,
    /// Fracture energy of the interface below a coating [force/length], for delamination.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub interface_energy: Option<f64>,
    /// Beuth's g(alpha, beta) of a coating [-], which channelling needs where coating and substrate differ in stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub channelling_factor: Option<f64>,
    /// Phase angle of the interface crack under tension [degrees], which the mode mix needs where coating and substrate differ in stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(ANGLE)]
    pub interface_phase: Option<f64>,
}

/// Coffin, Manson and Basquin's law: strain amplitude `= S/E (2N)^b + e (2N)^c`; in shear with G for E.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrainLife {
    /// Fatigue strength coefficient S [pressure], positive.
    #[range(Range::POSITIVE)]
    pub strength_coefficient: f64,
    /// Fatigue strength exponent b [-], negative.
    #[range(Range::NEGATIVE)]
    pub strength_exponent: f64,
    /// Fatigue ductility coefficient e [-], positive.
    #[range(Range::POSITIVE)]
    pub ductility_coefficient: f64,
    /// Fatigue ductility exponent c [-], negative.
    #[range(Range::NEGATIVE)]
    pub ductility_exponent: f64,
}

/// Constants of a short crack.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Table, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CrackConstants {
    /// Threshold of long cracks, range of the stress intensity while the crack is open [pressure x sqrt(length)].
    #[range(Range::POSITIVE)]
    pub threshold: f64,
    /// El Haddad's length l0 [length]: the threshold of a crack of length l is `threshold sqrt(l/(l + l0))`.
    #[range(Range::POSITIVE)]
    pub short_crack_length: f64,
    /// Length that the crack has first [length].
    #[range(Range::POSITIVE)]
    pub initial_length: f64,
    /// Length up to which it is followed [length].
    #[range(Range::POSITIVE)]
    pub final_length: f64,
    /// Paris' C: growth per cycle [length] is `C dK^m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub paris_coefficient: Option<f64>,
    /// Paris' m [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub paris_exponent: Option<f64>,
    /// Fracture toughness [pressure x sqrt(length)]: there the crack runs through.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[range(Range::POSITIVE)]
    pub toughness: Option<f64>,
}

impl FatigueConstants {
    /// Fatigue limits, where both are given.
    pub fn endurance(&self) -> Option<Endurance> {
        self.torsion_limit.zip(self.tension_limit).map(|(torsion, tension)| Endurance { torsion, tension })
    }

    /// Weight of the normal stress in Fatemi and Socie's parameter.
    pub fn sensitivity(&self) -> f64 {
        self.normal_stress_sensitivity.unwrap_or(1.0)
    }

    /// What is wrong with them: the key and the reason.
    pub fn fault(&self) -> Option<(String, String)> {
        self.key_fault().or_else(|| self.contradiction())
    }

    /// What of them does not go together: the key and the reason.
    pub fn contradiction(&self) -> Option<(String, String)> {
        if self.torsion_limit.is_some() != self.tension_limit.is_some() {
            let what = "torsion_limit and tension_limit belong together: Crossland and Dang Van need both";
            return Some(("torsion_limit".to_owned(), what.to_owned()));
        }
        let crack = self.crack?;
        if crack.paris_coefficient.is_some() != crack.paris_exponent.is_some() {
            let what = "crack: paris_coefficient and paris_exponent belong together";
            return Some(("crack".to_owned(), what.to_owned()));
        }
        let what = "crack: final_length must be greater than initial_length";
        (crack.final_length <= crack.initial_length).then(|| ("crack".to_owned(), what.to_owned()))
    }
}

/// Constants of the layers of a body, as a case names them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LayerConstants {
    /// Depth of the upper face of each layer [length], rising, and its constants.
    layers: Vec<(f64, FatigueConstants)>,
}

impl LayerConstants {
    /// Constants of layers, from the surface down.
    pub fn new(layers: Vec<(f64, FatigueConstants)>) -> Self {
        let is_none = layers.iter().all(|(_, constants)| *constants == FatigueConstants::default());
        Self { layers: if is_none { Vec::new() } else { layers } }
    }

    /// The same constants in all layers.
    pub fn everywhere(constants: FatigueConstants) -> Self {
        Self::new(vec![(0.0, constants)])
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.layers.is_empty()
    }

    /// Constants of the layer that holds a depth: that of the middle of a layer of the half-space, for a graded coating is many of them.
    pub fn at(&self, middle: f64) -> FatigueConstants {
        let named = self.layers.iter().rev().find(|(top, _)| *top <= middle);
        named.map_or_else(FatigueConstants::default, |(_, constants)| *constants)
    }

    /// These, and where a layer has none at all those of another.
    #[must_use]
    pub fn or(self, constants: FatigueConstants) -> Self {
        if self.is_none() {
            return Self::everywhere(constants);
        }
        let given = |own: FatigueConstants| if own == FatigueConstants::default() { constants } else { own };
        Self::new(self.layers.into_iter().map(|(top, own)| (top, given(own))).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constants(yield_strength: f64) -> FatigueConstants {
        FatigueConstants { yield_strength: Some(yield_strength), ..FatigueConstants::default() }
    }

    #[test]
    fn each_layer_has_its_own_constants() {
        let none = FatigueConstants::default();
        let layers = LayerConstants::new(vec![(0.0, constants(3.0)), (1.0, none), (2.0, constants(5.0))]);
        assert_eq!(
            [0.5, 1.5, 2.5].map(|depth| layers.at(depth).yield_strength),
            [Some(3.0), None, Some(5.0)]
        );
        let filled = layers.or(constants(7.0));
        assert_eq!([0.5, 1.5, 2.5].map(|depth| filled.at(depth).yield_strength), [3.0, 7.0, 5.0].map(Some));
        assert_eq!(LayerConstants::default().or(constants(7.0)).at(9.0).yield_strength, Some(7.0));
    }

    #[test]
    fn what_no_material_has_is_found() {
        assert!(constants(1.0).fault().is_none());
        for wrong in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(constants(wrong).fault().unwrap().0, "yield_strength");
        }
        let half = FatigueConstants { torsion_limit: Some(1.0), ..FatigueConstants::default() };
        assert!(half.fault().unwrap().1.contains("belong together"));
        let life = StrainLife {
            strength_coefficient: 1.0,
            strength_exponent: 0.1,
            ductility_coefficient: 1.0,
            ductility_exponent: -0.6,
        };
        let rising = FatigueConstants { strain_life: Some(life), ..FatigueConstants::default() };
        assert_eq!(rising.fault().unwrap().0, "strain_life.strength_exponent");
    }
}
