//! How the parameters of a cycle change with its stresses and with the material.

use super::ball::{Ball, Point};
use super::constants::FatigueConstants;
use super::invariants::{deviator_point, local, point_by_stress, stress_by_point};
use super::parameter::{Evaluated, Parameter};
use crate::model::ElasticMaterial;
use crate::subsurface::largest::Measure;
use crate::subsurface::slopes::{HYDROSTATIC, on_plane};
use crate::subsurface::tensor::StressTensor;

/// Derivatives of a parameter of a cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterSlopes {
    /// By the stress of each increment, whose parts xy, xz and yz each stand in two places of the tensor.
    pub by_stress: Vec<StressTensor>,
    /// By Young's modulus, and by Poisson's ratio.
    pub by_material: [f64; 2],
}

impl Parameter {
    /// Its derivatives at a value that was found, on the critical plane of that; `None` where the constants it needs are not given.
    pub fn slopes(
        self,
        cycle: &[StressTensor],
        (material, constants): (&ElasticMaterial, &FatigueConstants),
        found: &Evaluated,
    ) -> Option<ParameterSlopes> {
        let mut slopes =
            ParameterSlopes { by_stress: vec![StressTensor::default(); cycle.len()], by_material: [0.0; 2] };
        match self {
            Self::SmithWatsonTopper if found.value > 0.0 => {
                smith_watson_topper(cycle, material, (&found.normal?, &mut slopes));
            }
            Self::SmithWatsonTopper => {}
            Self::FatemiSocie => {
                let weight = constants.sensitivity() / constants.yield_strength?;
                fatemi_socie(cycle, material, weight, (&found.normal?, &mut slopes));
            }
            Self::Crossland => {
                let endurance = constants.endurance()?;
                let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
                let ([one, other], chord) = longest_chord(&path);
                if chord > 0.0 {
                    let by: Point = std::array::from_fn(|n| {
                        (path[one][n] - path[other][n]) / (chord * 8.0_f64.sqrt() * endurance.torsion)
                    });
                    slopes.add(one, 1.0, &stress_by_point(&by));
                    slopes.add(other, -1.0, &stress_by_point(&by));
                }
                let [highest, _] = ends(cycle.iter().map(StressTensor::hydrostatic));
                slopes.add(highest, endurance.crossland_weight() / endurance.torsion, &HYDROSTATIC);
            }
            Self::DangVan => {
                let endurance = constants.endurance()?;
                let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
                let ball = Ball::around(&path);
                let shear = |n: usize| local(&path[n], &ball.centre);
                let weight = endurance.dang_van_weight();
                let value = |n: usize| 0.5 * shear(n).tresca() + weight * cycle[n].hydrostatic();
                let [worst, _] = ends((0..cycle.len()).map(value));
                let by = Measure::Tresca.slopes(&shear(worst));
                let by_point = point_by_stress(&by).map(|part| 0.5 * part / endurance.torsion);
                slopes.add(worst, 1.0, &stress_by_point(&by_point));
                slopes.add(worst, weight / endurance.torsion, &HYDROSTATIC);
                slopes.add_held(&path, &ball, &ball.by_points(&by_point.map(|part| -part)));
            }
            Self::ShakedownStrength => {
                let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
                let ball = Ball::around(&path);
                let by = ball.radius_by_points().into_iter().map(|by| by.map(|part| 1.5_f64.sqrt() * part));
                slopes.add_held(&path, &ball, &by.collect::<Vec<_>>());
            }
        }
        Some(slopes)
    }
}

impl ParameterSlopes {
    fn add(&mut self, increment: usize, factor: f64, by: &StressTensor) {
        if let Some(sum) = self.by_stress.get_mut(increment) {
            *sum = sum.plus(factor, by);
        }
    }

    /// Adds derivatives by the points that hold the ball around a path.
    fn add_held(&mut self, path: &[Point], ball: &Ball, by: &[Point]) {
        for ((held, _), by) in ball.held.iter().zip(by) {
            if let Some(increment) = path.iter().position(|point| point == held) {
                self.add(increment, 1.0, &stress_by_point(by));
            }
        }
    }
}

/// Places of the largest and of the smallest number; of equal ones the first.
fn ends(numbers: impl Iterator<Item = f64>) -> [usize; 2] {
    let (mut most, mut least) = ((0, f64::NEG_INFINITY), (0, f64::INFINITY));
    for (place, number) in numbers.enumerate() {
        if number > most.1 {
            most = (place, number);
        }
        if number < least.1 {
            least = (place, number);
        }
    }
    [most.0, least.0]
}

/// The ends of the longest chord of a path, and its length.
fn longest_chord<const N: usize>(path: &[[f64; N]]) -> ([usize; 2], f64) {
    let mut found = ([0, 0], 0.0);
    for (n, one) in path.iter().enumerate() {
        for (m, other) in path[..n].iter().enumerate() {
            let square: f64 = one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
            if square > found.1 {
                found = ([n, m], square);
            }
        }
    }
    (found.0, found.1.sqrt())
}

/// Largest normal stress times half the range of the normal strain, `((1 + nu) sigma_n - 3 nu sigma_H) / E`.
fn smith_watson_topper(
    cycle: &[StressTensor],
    material: &ElasticMaterial,
    (normal, slopes): (&[f64; 3], &mut ParameterSlopes),
) {
    let (nu, young) = (material.poisson(), material.young());
    let across = on_plane(normal);
    let by_strain =
        StressTensor::default().plus((1.0 + nu) / young, &across).plus(-3.0 * nu / young, &HYDROSTATIC);
    let strain = |stress: &StressTensor| by_strain.times(stress);
    let [highest, _] = ends(cycle.iter().map(|stress| across.times(stress)));
    let [longest, shortest] = ends(cycle.iter().map(strain));
    let most = across.times(&cycle[highest]);
    let half = 0.5 * (strain(&cycle[longest]) - strain(&cycle[shortest]));
    slopes.add(highest, half, &across);
    slopes.add(longest, 0.5 * most, &by_strain);
    slopes.add(shortest, -0.5 * most, &by_strain);
    let by_poisson = across.plus(-3.0, &HYDROSTATIC);
    let range = by_poisson.times(&cycle[longest]) - by_poisson.times(&cycle[shortest]);
    slopes.by_material = [-most * half / young, 0.5 * most * range / young];
}

/// Half the longest chord of the shear traction over the shear modulus, times `1 + weight sigma_n,max`.
fn fatemi_socie(
    cycle: &[StressTensor],
    material: &ElasticMaterial,
    weight: f64,
    (normal, slopes): (&[f64; 3], &mut ParameterSlopes),
) {
    let across = on_plane(normal);
    let shear = |stress: &StressTensor| -> [f64; 3] {
        let traction = stress.on_plane(*normal);
        std::array::from_fn(|axis| traction[axis] - across.times(stress) * normal[axis])
    };
    let path: Vec<[f64; 3]> = cycle.iter().map(shear).collect();
    let ([one, other], chord) = longest_chord(&path);
    let [highest, _] = ends(cycle.iter().map(|stress| across.times(stress)));
    let most = across.times(&cycle[highest]).max(0.0);
    let per_shear = 1.0 / material.shear_modulus();
    let (factor, amplitude) = (0.5 * per_shear * (1.0 + weight * most), 0.5 * per_shear * chord);
    if chord > 0.0 {
        // The chord lies in the plane: what the shear traction changes along it, the traction does.
        let along: [f64; 3] = std::array::from_fn(|axis| (path[one][axis] - path[other][axis]) / chord);
        let ([x, y, z], [a, b, c]) = (*normal, along);
        let by = StressTensor([x * a, y * b, z * c, x * b + y * a, x * c + z * a, y * c + z * b]);
        slopes.add(one, factor, &by);
        slopes.add(other, -factor, &by);
    }
    if most > 0.0 {
        slopes.add(highest, weight * amplitude, &across);
    }
    let value = factor * chord;
    // 1/G = 2 (1 + nu) / E
    slopes.by_material = [-value / material.young(), value / (1.0 + material.poisson())];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Every parameter of random cycles under some mean compression against differences of its values, by all stresses and both constants. The
    /// critical plane is found to 2e-5, a value on it to 3e-10: differences of 1e-3 tell 1e-6, and planes that are so far off 1e-5.
    #[test]
    fn slopes_are_those_of_the_parameters() {
        let mut random = Random::seeded(9);
        let constants = FatigueConstants {
            yield_strength: Some(4.0),
            torsion_limit: Some(2.0),
            tension_limit: Some(3.0),
            ..FatigueConstants::default()
        };
        let mut worst = [0.0_f64; 5];
        for _ in 0..20 {
            let mean = random.between(-0.5, 0.2);
            let cycle: Vec<StressTensor> = (0..7)
                .map(|_| {
                    StressTensor(std::array::from_fn(|part| {
                        random.between(-1.0, 1.0) + if part < 3 { mean } else { 0.0 }
                    }))
                })
                .collect();
            let way: Vec<StressTensor> = cycle
                .iter()
                .map(|_| StressTensor(std::array::from_fn(|_| random.between(-1.0, 1.0))))
                .collect();
            let (young, nu) = (10.0, 0.3);
            for (place, parameter) in Parameter::ALL.into_iter().enumerate() {
                let on_a_plane = matches!(parameter, Parameter::SmithWatsonTopper | Parameter::FatemiSocie);
                let step = if on_a_plane { 1e-3 } else { 1e-6 };
                let at = |stress: f64, [by_young, by_nu]: [f64; 2]| {
                    let moved: Vec<StressTensor> =
                        cycle.iter().zip(&way).map(|(at, way)| at.plus(stress, way)).collect();
                    let material = ElasticMaterial::new(young + by_young, nu + by_nu).unwrap();
                    parameter.of(&moved, &material, &constants).unwrap()
                };
                let found = at(0.0, [0.0; 2]);
                let material = ElasticMaterial::new(young, nu).unwrap();
                let slopes = parameter.slopes(&cycle, (&material, &constants), &found).unwrap();
                let by_stress: f64 = slopes.by_stress.iter().zip(&way).map(|(by, way)| by.times(way)).sum();
                let difference = |up: f64, down: f64, step: f64| (up - down) / (2.0 * step);
                let of = |one: [f64; 3], other: [f64; 3], step: f64| {
                    difference(
                        at(one[0], [one[1], one[2]]).value,
                        at(other[0], [other[1], other[2]]).value,
                        step,
                    )
                };
                let expected = [
                    of([step, 0.0, 0.0], [-step, 0.0, 0.0], step),
                    of([0.0, 1e-3, 0.0], [0.0, -1e-3, 0.0], 1e-3),
                    of([0.0, 0.0, 1e-3], [0.0, 0.0, -1e-3], 1e-3),
                ];
                for (found, expected) in
                    [by_stress, slopes.by_material[0], slopes.by_material[1]].into_iter().zip(expected)
                {
                    worst[place] = worst[place].max((found - expected).abs() / (1.0 + expected.abs()));
                }
            }
        }
        for ((parameter, worst), bound) in
            Parameter::ALL.into_iter().zip(worst).zip([1e-5, 1e-5, 1e-7, 1e-7, 1e-7])
        {
            assert!(worst < bound, "{parameter:?} {worst:e}");
        }
    }
}
