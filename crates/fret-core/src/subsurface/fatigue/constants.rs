//! Constants of a material for fatigue and fracture. None is built in: what has no constants is not computed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::invariants::Endurance;

/// Constants of a layer for fatigue and fracture, each for what it is needed for.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FatigueConstants")]
pub struct FatigueConstants<N = f64> {
    /// Yield strength [pressure], for Fatemi and Socie and for elastic shakedown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_strength: Option<N>,
    /// Weight of the normal stress in Fatemi and Socie's parameter [-]. Default: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_stress_sensitivity: Option<N>,
    /// Fatigue limit in fully reversed torsion, amplitude [pressure], for Crossland and Dang Van.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torsion_limit: Option<N>,
    /// Fatigue limit in fully reversed tension or bending, amplitude [pressure], for Crossland and Dang Van.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tension_limit: Option<N>,
    /// Critical distance L [length]: parameters are also told at the depth L/2 (point method) and as means down to 2 L (line method).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_distance: Option<N>,
    /// Life in tension over the normal strain, for cycles to initiation by Smith, Watson and Topper.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_life: Option<StrainLife<N>>,
    /// Life in torsion over the shear strain, for cycles to initiation by Fatemi and Socie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_life: Option<StrainLife<N>>,
    /// Growth of a short crack from the most severe place of the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crack: Option<CrackConstants<N>>,
    /// Fracture energy of a coating [force/length], for channelling cracks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture_energy: Option<N>,
    /// Fracture energy of the interface below a coating [force/length], for delamination.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interface_energy: Option<N>,
    /// Beuth's g(alpha, beta) of a coating [-], which channelling needs where coating and substrate differ in stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub channelling_factor: Option<N>,
    /// Phase angle of the interface crack under tension [degrees], which the mode mix needs where coating and substrate differ in stiffness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interface_phase: Option<N>,
}

/// Coffin, Manson and Basquin's law: strain amplitude `= S/E (2N)^b + e (2N)^c`; in shear with G for E.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "StrainLife")]
pub struct StrainLife<N = f64> {
    /// Fatigue strength coefficient S [pressure], positive.
    pub strength_coefficient: N,
    /// Fatigue strength exponent b [-], negative.
    pub strength_exponent: N,
    /// Fatigue ductility coefficient e [-], positive.
    pub ductility_coefficient: N,
    /// Fatigue ductility exponent c [-], negative.
    pub ductility_exponent: N,
}

/// Constants of a short crack.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CrackConstants")]
pub struct CrackConstants<N = f64> {
    /// Threshold of long cracks, range of the stress intensity while the crack is open [pressure x sqrt(length)].
    pub threshold: N,
    /// El Haddad's length l0 [length]: the threshold of a crack of length l is `threshold sqrt(l/(l + l0))`.
    pub short_crack_length: N,
    /// Length that the crack has first [length].
    pub initial_length: N,
    /// Length up to which it is followed [length].
    pub final_length: N,
    /// Paris' C: growth per cycle [length] is `C dK^m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paris_coefficient: Option<N>,
    /// Paris' m [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paris_exponent: Option<N>,
    /// Fracture toughness [pressure x sqrt(length)]: there the crack runs through.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub toughness: Option<N>,
}

/// What a constant may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Above 0.
    Positive,
    /// Below 0.
    Negative,
    /// 0 or above.
    NotNegative,
    /// An angle between -90 and 90 degrees.
    Angle,
}

impl Range {
    /// Whether a finite number lies in it.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Positive => value > 0.0,
                Self::Negative => value < 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Angle => value.abs() <= 90.0,
            }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Positive => "must be positive and finite",
            Self::Negative => "must be negative and finite",
            Self::NotNegative => "must be zero or positive, and finite",
            Self::Angle => "must lie between -90 and 90 degrees",
        }
    }
}

impl<N> StrainLife<N> {
    fn numbers<'a>(&'a self, all: &mut Vec<(String, Range, &'a N)>, name: &str) {
        let mut add = |key: &str, range, value| all.push((format!("{name}.{key}"), range, value));
        add("strength_coefficient", Range::Positive, &self.strength_coefficient);
        add("strength_exponent", Range::Negative, &self.strength_exponent);
        add("ductility_coefficient", Range::Positive, &self.ductility_coefficient);
        add("ductility_exponent", Range::Negative, &self.ductility_exponent);
    }

    fn plain(&self, number: &impl Fn(&N) -> f64) -> StrainLife {
        StrainLife {
            strength_coefficient: number(&self.strength_coefficient),
            strength_exponent: number(&self.strength_exponent),
            ductility_coefficient: number(&self.ductility_coefficient),
            ductility_exponent: number(&self.ductility_exponent),
        }
    }
}

impl<N> FatigueConstants<N> {
    /// All constants that are given: key, what it may be, value.
    pub fn numbers(&self) -> Vec<(String, Range, &N)> {
        use Range::{Angle, NotNegative, Positive};
        let mut all = Vec::new();
        for (key, range, value) in [
            ("yield_strength", Positive, &self.yield_strength),
            ("normal_stress_sensitivity", NotNegative, &self.normal_stress_sensitivity),
            ("torsion_limit", Positive, &self.torsion_limit),
            ("tension_limit", Positive, &self.tension_limit),
            ("critical_distance", Positive, &self.critical_distance),
            ("fracture_energy", Positive, &self.fracture_energy),
            ("interface_energy", Positive, &self.interface_energy),
            ("channelling_factor", Positive, &self.channelling_factor),
            ("interface_phase", Angle, &self.interface_phase),
        ] {
            all.extend(value.as_ref().map(|value| (key.to_owned(), range, value)));
        }
        if let Some(life) = &self.strain_life {
            life.numbers(&mut all, "strain_life");
        }
        if let Some(life) = &self.shear_life {
            life.numbers(&mut all, "shear_life");
        }
        if let Some(crack) = &self.crack {
            for (key, value) in [
                ("crack.threshold", Some(&crack.threshold)),
                ("crack.short_crack_length", Some(&crack.short_crack_length)),
                ("crack.initial_length", Some(&crack.initial_length)),
                ("crack.final_length", Some(&crack.final_length)),
                ("crack.paris_coefficient", crack.paris_coefficient.as_ref()),
                ("crack.paris_exponent", crack.paris_exponent.as_ref()),
                ("crack.toughness", crack.toughness.as_ref()),
            ] {
                all.extend(value.map(|value| (key.to_owned(), Positive, value)));
            }
        }
        all
    }

    /// The constants as plain numbers.
    pub fn plain(&self, number: impl Fn(&N) -> f64) -> FatigueConstants {
        let of = |value: &Option<N>| value.as_ref().map(&number);
        FatigueConstants {
            yield_strength: of(&self.yield_strength),
            normal_stress_sensitivity: of(&self.normal_stress_sensitivity),
            torsion_limit: of(&self.torsion_limit),
            tension_limit: of(&self.tension_limit),
            critical_distance: of(&self.critical_distance),
            strain_life: self.strain_life.as_ref().map(|life| life.plain(&number)),
            shear_life: self.shear_life.as_ref().map(|life| life.plain(&number)),
            crack: self.crack.as_ref().map(|crack| CrackConstants {
                threshold: number(&crack.threshold),
                short_crack_length: number(&crack.short_crack_length),
                initial_length: number(&crack.initial_length),
                final_length: number(&crack.final_length),
                paris_coefficient: of(&crack.paris_coefficient),
                paris_exponent: of(&crack.paris_exponent),
                toughness: of(&crack.toughness),
            }),
            fracture_energy: of(&self.fracture_energy),
            interface_energy: of(&self.interface_energy),
            channelling_factor: of(&self.channelling_factor),
            interface_phase: of(&self.interface_phase),
        }
    }
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
        let numbers = self.numbers();
        let out = numbers.iter().find(|(_, range, value)| !range.holds(**value));
        if let Some((key, range, value)) = out {
            return Some((key.clone(), format!("{key} = {value:?}: {}", range.words())));
        }
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
