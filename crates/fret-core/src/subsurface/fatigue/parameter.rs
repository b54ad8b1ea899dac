//! The parameters of a cycle at a point, by one name each.

use serde::Serialize;

use super::constants::FatigueConstants;
use super::critical_plane::{fatemi_socie, smith_watson_topper};
use super::invariants::{crossland, dang_van, deviator_point};
use super::life::{cycles_by_fatemi_socie, cycles_by_smith_watson_topper};
use super::shakedown::shakedown_strength;
use crate::model::ElasticMaterial;
use crate::subsurface::tensor::StressTensor;

/// What a cycle of stress at a point is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Smith-Watson-Topper parameter [pressure].
    SmithWatsonTopper,
    /// Fatemi-Socie parameter [-].
    FatemiSocie,
    /// Crossland's use of the endurance [-].
    Crossland,
    /// Dang Van's use of the endurance [-].
    DangVan,
    /// Smallest yield strength for which the cycle shakes down [pressure].
    ShakedownStrength,
}

/// A parameter at a point.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Evaluated {
    /// Its value.
    pub value: f64,
    /// Unit normal of the critical plane, where it has one.
    pub normal: Option<[f64; 3]>,
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::SmithWatsonTopper, Self::FatemiSocie, Self::Crossland, Self::DangVan, Self::ShakedownStrength];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::SmithWatsonTopper => "smith_watson_topper",
            Self::FatemiSocie => "fatemi_socie",
            Self::Crossland => "crossland",
            Self::DangVan => "dang_van",
            Self::ShakedownStrength => "shakedown_strength",
        }
    }

    /// Its value in a cycle; `None` where the constants it needs are not given.
    pub fn of(
        self,
        cycle: &[StressTensor],
        material: &ElasticMaterial,
        constants: &FatigueConstants,
    ) -> Option<Evaluated> {
        let plain = |value: f64| Some(Evaluated { value, normal: None });
        match self {
            Self::SmithWatsonTopper => {
                let plane = smith_watson_topper(cycle, material);
                Some(Evaluated { value: plane.value, normal: Some(plane.normal) })
            }
            Self::FatemiSocie => {
                let strength = constants.yield_strength?;
                let plane = fatemi_socie(cycle, material, strength, constants.sensitivity());
                Some(Evaluated { value: plane.value, normal: Some(plane.normal) })
            }
            Self::Crossland => plain(crossland(cycle, &constants.endurance()?)),
            Self::DangVan => plain(dang_van(cycle, &constants.endurance()?)),
            Self::ShakedownStrength => plain(shakedown_strength(cycle)),
        }
    }

    /// Whether its constants are given.
    pub fn is_given(self, constants: &FatigueConstants) -> bool {
        match self {
            Self::SmithWatsonTopper | Self::ShakedownStrength => true,
            Self::FatemiSocie => constants.yield_strength.is_some(),
            Self::Crossland | Self::DangVan => constants.endurance().is_some(),
        }
    }

    /// Cycles to initiation at a value, infinite above 1e18; `None` for a parameter without a law of life, or without its constants.
    pub fn cycles(self, value: f64, material: &ElasticMaterial, constants: &FatigueConstants) -> Option<f64> {
        match self {
            Self::SmithWatsonTopper => {
                constants.strain_life.map(|law| cycles_by_smith_watson_topper(value, material, &law))
            }
            Self::FatemiSocie => {
                constants.shear_life.map(|law| cycles_by_fatemi_socie(value, material, &law))
            }
            Self::Crossland | Self::DangVan | Self::ShakedownStrength => None,
        }
    }

    /// Factor on the whole cycle, with what is constant in it, up to which the material endures by this parameter; infinite where the
    /// value is not positive. Of the shakedown strength the factor on the cycle up to which it shakes down.
    pub fn factor_of_safety(self, value: f64, constants: &FatigueConstants) -> Option<f64> {
        let limit = match self {
            Self::SmithWatsonTopper | Self::FatemiSocie => return None,
            Self::Crossland | Self::DangVan => 1.0,
            Self::ShakedownStrength => constants.yield_strength?,
        };
        Some(if value > 0.0 { limit / value } else { f64::INFINITY })
    }
}

/// Bounds of a cycle that cost little: no parameter is larger than they say.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Length of the box around the path of the deviator.
    deviator: f64,
    /// The same of the strain tensor.
    strain: f64,
    /// Largest normal stress, 0 in compression.
    tension: f64,
    /// Largest and smallest hydrostatic stress.
    hydrostatic: [f64; 2],
}

impl Bounds {
    /// Bounds of a cycle.
    pub fn of(cycle: &[StressTensor], material: &ElasticMaterial) -> Self {
        let (nu, per_young) = (material.poisson(), 1.0 / material.young());
        let mut deviator = [[f64::INFINITY, f64::NEG_INFINITY]; 5];
        let mut strain = [[f64::INFINITY, f64::NEG_INFINITY]; 6];
        let (mut tension, mut hydrostatic) = (0.0_f64, [f64::INFINITY, f64::NEG_INFINITY]);
        let widen = |range: &mut [f64; 2], value: f64| *range = [range[0].min(value), range[1].max(value)];
        for stress in cycle {
            let mean = stress.hydrostatic();
            for (range, value) in deviator.iter_mut().zip(deviator_point(stress)) {
                widen(range, value);
            }
            for (part, (range, value)) in strain.iter_mut().zip(stress.0).enumerate() {
                let mean = if part < 3 { 3.0 * nu * mean } else { 0.0 };
                widen(range, per_young * ((1.0 + nu) * value - mean));
            }
            tension = tension.max(at_least_largest_principal(stress));
            widen(&mut hydrostatic, mean);
        }
        let square = |[low, high]: &[f64; 2]| (high - low) * (high - low);
        let [normal, shear] = [&strain[..3], &strain[3..]].map(|part| part.iter().map(square).sum::<f64>());
        Self {
            deviator: deviator.iter().map(square).sum::<f64>().sqrt(),
            strain: (normal + 2.0 * shear).sqrt(),
            tension,
            hydrostatic,
        }
    }

    /// What a parameter cannot exceed.
    pub fn on(&self, parameter: Parameter, material: &ElasticMaterial, constants: &FatigueConstants) -> f64 {
        let weighted =
            |weight: f64| weight * if weight > 0.0 { self.hydrostatic[1] } else { self.hydrostatic[0] };
        let value = match (parameter, constants.endurance(), constants.yield_strength) {
            (Parameter::SmithWatsonTopper, ..) => 0.5 * self.tension * self.strain,
            (Parameter::FatemiSocie, _, Some(strength)) => {
                let shear = self.deviator * std::f64::consts::FRAC_1_SQRT_2;
                0.5 * shear / material.shear_modulus()
                    * (1.0 + constants.sensitivity() * self.tension / strength)
            }
            // Crossland takes the largest hydrostatic stress, whatever the sign of the weight
            (Parameter::Crossland, Some(endurance), _) => {
                let hydrostatic = endurance.crossland_weight() * self.hydrostatic[1];
                (self.deviator / 8.0_f64.sqrt() + hydrostatic) / endurance.torsion
            }
            (Parameter::DangVan, Some(endurance), _) => {
                let shear = 0.5 * self.deviator * std::f64::consts::FRAC_1_SQRT_2;
                (shear + weighted(endurance.dang_van_weight())) / endurance.torsion
            }
            (Parameter::ShakedownStrength, ..) => 1.5_f64.sqrt() * 0.5 * self.deviator,
            _ => f64::INFINITY,
        };
        value + 1e-9 * value.abs() // rounding
    }
}

/// A number that the largest principal stress does not exceed, and nearly reaches [pressure].
///
/// It is at most two thirds of von Mises' stress above the mean; from there Newton's steps towards the largest root of the deviator's
/// characteristic polynomial `s^3 - J2 s - J3`, which is convex, stay above it.
fn at_least_largest_principal(stress: &StressTensor) -> f64 {
    let mean = stress.hydrostatic();
    let most = 2.0 / 3.0 * stress.von_mises();
    let [xx, yy, zz, xy, xz, yz] = stress.deviator().0;
    let second = 0.75 * most * most;
    let third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    let mut above = most;
    for _ in 0..4 {
        let slope = 3.0 * above * above - second;
        // rounding near a double root, where the slope vanishes
        if !(slope > 1e-3 * second) {
            break;
        }
        above -= ((above * above - second) * above - third) / slope;
    }
    // rounding of the steps, and of the sum with the mean
    mean + above + 1e-10 * (most + mean.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subsurface::fatigue::{Endurance, FatigueConstants};

    #[test]
    fn no_parameter_exceeds_its_bound() {
        let mut seed = 3_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let material = ElasticMaterial::new(1000.0, 0.3).unwrap();
        let limits = Endurance { torsion: 2.0, tension: 3.0 };
        let constants = FatigueConstants {
            yield_strength: Some(4.0),
            torsion_limit: Some(limits.torsion),
            tension_limit: Some(limits.tension),
            ..FatigueConstants::default()
        };
        let mut nearest = [0.0_f64; 5];
        for _ in 0..300 {
            let mean = 2.0 * random();
            let cycle: Vec<StressTensor> = (0..5)
                .map(|_| {
                    let mut stress = StressTensor(std::array::from_fn(|_| random()));
                    for part in &mut stress.0[..3] {
                        *part += mean;
                    }
                    stress
                })
                .collect();
            let bounds = Bounds::of(&cycle, &material);
            for (parameter, near) in Parameter::ALL.into_iter().zip(&mut nearest) {
                let value = parameter.of(&cycle, &material, &constants).unwrap().value;
                let bound = bounds.on(parameter, &material, &constants);
                assert!(value <= bound, "{parameter:?}: {value} {bound}");
                *near = near.max(value / bound);
            }
        }
        assert!(nearest.iter().all(|near| *near > 0.5), "{nearest:?}"); // bounds that are of use
    }

    #[test]
    fn the_bound_of_the_largest_principal_stress_is_near_and_above() {
        let mut seed = 9_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for number in 0..3000 {
            let mean = [0.0, 1e6, -30.0][number % 3];
            let mut stress = StressTensor(std::array::from_fn(|_| random()));
            match number % 5 {
                0 => stress.0[3..].fill(0.0),
                1 => stress = StressTensor([1.0, 1.0, random(), 0.0, 0.0, 1e-9 * random()]),
                _ => {}
            }
            stress.0[..3].iter_mut().for_each(|part| *part += mean);
            let (exact, bound) = (stress.principal().values[0], at_least_largest_principal(&stress));
            let size = stress.von_mises();
            // near a double root of the largest two, steps of Newton halve the distance: 2^-4 of a third
            assert!(
                exact <= bound && bound - exact < 0.03 * size + 1e-9 * mean.abs(),
                "{stress:?} {exact} {bound}"
            );
        }
        assert_eq!(at_least_largest_principal(&StressTensor::default()), 0.0);
    }

    #[test]
    fn factors_of_safety_are_those_on_the_whole_cycle() {
        let material = ElasticMaterial::new(1000.0, 0.3).unwrap();
        let constants = FatigueConstants {
            yield_strength: Some(4.0),
            torsion_limit: Some(2.0),
            tension_limit: Some(3.0),
            ..FatigueConstants::default()
        };
        let cycle = |scale: f64| {
            [[0.0, 0.0, 0.2], [1.0, -0.3, 0.8], [0.5, -2.0, 0.1]]
                .map(|[xx, zz, xz]| StressTensor([scale * xx, 0.0, scale * zz, 0.0, scale * xz, 0.0]))
        };
        for (parameter, limit) in
            [(Parameter::Crossland, 1.0), (Parameter::DangVan, 1.0), (Parameter::ShakedownStrength, 4.0)]
        {
            let value = parameter.of(&cycle(1.0), &material, &constants).unwrap().value;
            let factor = parameter.factor_of_safety(value, &constants).unwrap();
            let at_limit = parameter.of(&cycle(factor), &material, &constants).unwrap().value;
            assert!((at_limit / limit - 1.0).abs() < 1e-9, "{parameter:?}");
        }
    }
}
