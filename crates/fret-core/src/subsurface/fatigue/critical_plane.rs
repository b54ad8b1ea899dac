//! Criteria on the critical plane: the plane on which the parameter is largest.

use pulp::Arch;
use serde::Serialize;

use super::plane_search::{LANES, OverPlanes, Planes, larger, smaller};
use crate::model::ElasticMaterial;
use crate::subsurface::tensor::StressTensor;

/// Squared sine of the half-angle of a narrow cone of tension: 20 degrees, twice the distance of the planes that are looked at first.
const NARROW: f64 = 0.117;

/// The largest value of a parameter over all planes, and the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CriticalPlane {
    /// The parameter.
    pub value: f64,
    /// Unit normal of the plane.
    pub normal: [f64; 3],
}

/// Smith, Watson and Topper's parameter on the critical plane: largest normal stress of the cycle (if tensile) times amplitude
/// of the normal strain [pressure].
///
/// Source: Smith, Watson & Topper (1970), *J. Materials* 5, 767; on the critical plane Szolwinski & Farris (1996), *Wear* 198, 93.
pub fn smith_watson_topper(cycle: &[StressTensor], material: &ElasticMaterial) -> CriticalPlane {
    let (nu, per_young) = (material.poisson(), 1.0 / material.young());
    if cycle.iter().all(|stress| stress.hydrostatic() + 2.0 / 3.0 * stress.von_mises() <= 0.0) {
        return CriticalPlane { value: 0.0, normal: [0.0, 0.0, 1.0] }; // no principal stress is tensile
    }
    // a free surface has no stress across it but for rounding, which is no tension
    let rounding =
        1e-12 * cycle.iter().flat_map(|stress| stress.0).fold(0.0, |most, part| part.abs().max(most));
    let starts = narrow_tension(cycle, rounding);
    let (value, normal) = Arch::new().dispatch(OverPlanes(
        &starts,
        #[inline(always)]
        |planes: &Planes, _| {
            let (mut least, mut most) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
            let mut stress_most = [0.0_f64; LANES];
            for stress in cycle {
                let across = planes.normal_stress(stress);
                let mean = 3.0 * nu * stress.hydrostatic();
                for lane in 0..LANES {
                    let strain = per_young * ((1.0 + nu) * across[lane] - mean);
                    least[lane] = smaller(least[lane], strain);
                    most[lane] = larger(most[lane], strain);
                    stress_most[lane] = larger(stress_most[lane], across[lane]);
                }
            }
            let mut values = [0.0; LANES];
            for lane in 0..LANES {
                let product = stress_most[lane] * 0.5 * (most[lane] - least[lane]);
                values[lane] = if stress_most[lane] > rounding { product } else { 0.0 };
            }
            values
        },
    ));
    CriticalPlane { value, normal }
}

/// Directions of the largest principal stress of the increments whose tension is confined to a cone that may lie between the planes the
/// search looks at: `s_1 / (s_1 - s_3)` is the squared sine of its half-angle.
fn narrow_tension(cycle: &[StressTensor], rounding: f64) -> Vec<[f64; 3]> {
    let mut normals = Vec::new();
    for stress in cycle {
        let [mean, equivalent] = [stress.hydrostatic(), stress.von_mises()];
        // the largest principal stress lies between a third and two thirds of von Mises' stress above the mean
        if mean + 2.0 / 3.0 * equivalent <= rounding || mean + equivalent / 3.0 > 1.155 * NARROW * equivalent
        {
            continue;
        }
        let principal = stress.principal();
        let [first, _, third] = principal.values;
        if first > rounding && first < NARROW * (first - third) {
            normals.push(principal.directions[0]);
        }
    }
    normals
}

/// Fatemi and Socie's parameter on the critical plane [-]: amplitude of the shear strain times `1 + k sigma_n,max / sigma_y`,
/// with the largest normal stress of the cycle (if tensile).
///
/// The shear strain's range is the longest chord of its path in the plane. Source: Fatemi & Socie (1988), *Fatigue Fract. Engng
/// Mater. Struct.* 11, 149.
pub fn fatemi_socie(
    cycle: &[StressTensor],
    material: &ElasticMaterial,
    yield_strength: f64,
    sensitivity: f64,
) -> CriticalPlane {
    let per_shear = 1.0 / material.shear_modulus();
    let mut path = Vec::with_capacity(cycle.len());
    let (value, normal) = Arch::new().dispatch(OverPlanes(
        &[],
        #[inline(always)]
        |planes: &Planes, floor: f64| {
            path.clear();
            let mut stress_most = [0.0_f64; LANES];
            let mut bounds = [[[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]]; 3];
            for stress in cycle {
                let (across, shear) = planes.traction(stress);
                for lane in 0..LANES {
                    stress_most[lane] = larger(stress_most[lane], across[lane]);
                }
                for ([low, high], shear) in bounds.iter_mut().zip(&shear) {
                    for lane in 0..LANES {
                        low[lane] = smaller(low[lane], shear[lane]);
                        high[lane] = larger(high[lane], shear[lane]);
                    }
                }
                path.push(shear);
            }
            let factor =
                stress_most.map(|most| 0.5 * per_shear * (1.0 + sensitivity * most / yield_strength));
            // no chord is longer than the diagonal of the box around the path
            let side = |[low, high]: &[[f64; LANES]; 2], lane: usize| high[lane] - low[lane];
            let is_too_low = |lane: usize| {
                let square: f64 = bounds.iter().map(|bounds| side(bounds, lane) * side(bounds, lane)).sum();
                factor[lane] * square.sqrt() <= floor
            };
            if (0..LANES).all(is_too_low) {
                return [f64::NEG_INFINITY; LANES];
            }
            let mut chord = [0.0_f64; LANES];
            for (index, one) in path.iter().enumerate() {
                for other in &path[..index] {
                    for lane in 0..LANES {
                        let [a, b, c] = [0, 1, 2].map(|axis| one[axis][lane] - other[axis][lane]);
                        chord[lane] = larger(chord[lane], a * a + b * b + c * c);
                    }
                }
            }
            std::array::from_fn(|lane| factor[lane] * chord[lane].sqrt())
        },
    ));
    CriticalPlane { value, normal }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steel() -> ElasticMaterial {
        ElasticMaterial::new(210e3, 0.3).unwrap()
    }

    fn reversed(amplitude: [f64; 6]) -> Vec<StressTensor> {
        let at = |n: i32| (std::f64::consts::TAU * f64::from(n) / 24.0).cos();
        (0..24).map(|n| StressTensor(amplitude.map(|value| at(n) * value))).collect()
    }

    #[test]
    fn smith_watson_topper_in_tension_and_torsion_by_hand() {
        let tension = smith_watson_topper(&reversed([0.0, 300.0, 0.0, 0.0, 0.0, 0.0]), &steel());
        assert!((tension.value - 300.0 * 300.0 / 210e3).abs() < 1e-9 * tension.value);
        assert!((tension.normal[1].abs() - 1.0).abs() < 1e-9);
        // torsion: the plane at 45 degrees, sigma_n = tau, eps_n = tau (1 + nu)/E
        let torsion = smith_watson_topper(&reversed([0.0, 0.0, 0.0, 0.0, 120.0, 0.0]), &steel());
        assert!((torsion.value - 120.0 * 120.0 * 1.3 / 210e3).abs() < 1e-9 * torsion.value);
        assert!((torsion.normal[0].abs() - 0.5_f64.sqrt()).abs() < 1e-4 && torsion.normal[1].abs() < 1e-4);
    }

    #[test]
    fn fatemi_socie_in_tension_and_torsion_by_hand() {
        // on a plane whose normal is at the angle t to the load: tension: gamma_a = s (1 + nu) sin 2t / E, sigma_n = s cos^2 t;
        // torsion: gamma_a = tau cos 2t / G, sigma_n = tau |sin 2t|; the largest over t by a fine table
        let (s, tau, limit, k) = (300.0, 150.0, 500.0, 1.0);
        let shear = 210e3 / 2.6;
        let mut expected = [0.0_f64; 2];
        for n in 0..200_000 {
            let t = std::f64::consts::PI * f64::from(n) / 200_000.0;
            let tension = s * 1.3 * (2.0 * t).sin().abs() / 210e3 * (1.0 + k * s * t.cos().powi(2) / limit);
            let torsion =
                tau * (2.0 * t).cos().abs() / shear * (1.0 + k * tau * (2.0 * t).sin().abs() / limit);
            expected = [expected[0].max(tension), expected[1].max(torsion)];
        }
        let found = [
            fatemi_socie(&reversed([s, 0.0, 0.0, 0.0, 0.0, 0.0]), &steel(), limit, k).value,
            fatemi_socie(&reversed([0.0, 0.0, 0.0, tau, 0.0, 0.0]), &steel(), limit, k).value,
        ];
        for (found, exact) in found.into_iter().zip(expected) {
            assert!((found - exact).abs() < 1e-7 * exact, "{found} {exact}");
        }
    }

    #[test]
    fn the_rounding_of_a_free_surface_is_no_tension() {
        let pressed = |across: f64| StressTensor([-2e9, -1e9, across, 0.0, 0.0, 0.0]);
        assert_eq!(smith_watson_topper(&[pressed(-3e8), pressed(1e-7)], &steel()).value, 0.0);
    }

    #[test]
    fn compression_alone_gives_no_smith_watson_topper() {
        let cycle = [
            StressTensor([-100.0, -100.0, -300.0, 0.0, 0.0, 0.0]),
            StressTensor([-10.0, -10.0, -30.0, 0.0, 0.0, 0.0]),
        ];
        assert_eq!(smith_watson_topper(&cycle, &steel()).value, 0.0);
    }

    /// Random numbers between -1 and 1.
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Cycles whose parts swing with phases and harmonics of their own about a mean, as below a contact that slides and is pulled.
    fn cycles(count: usize, increments: usize, mean: f64) -> Vec<Vec<StressTensor>> {
        let mut seed = 17;
        let mut cycle = || {
            let parts: [[f64; 5]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| random(&mut seed)));
            let at = |n: usize| {
                let turn = std::f64::consts::TAU * n as f64 / increments as f64;
                let of = |(part, [even, c, s, c2, s2]): (usize, [f64; 5])| {
                    let swing = c * turn.cos()
                        + s * turn.sin()
                        + 0.4 * (c2 * (2.0 * turn).cos() + s2 * (2.0 * turn).sin());
                    0.5 * even + swing + if part < 3 { mean } else { 0.0 }
                };
                let mut number = 0..;
                StressTensor(parts.map(|part| of((number.next().unwrap(), part))))
            };
            (0..increments).map(at).collect()
        };
        (0..count).map(|_| cycle()).collect()
    }

    /// All planes whose normals lie a degree apart, over half the sphere.
    fn every_degree() -> Vec<[f64; 3]> {
        let mut normals = Vec::new();
        for ring in 0..=90 {
            let polar = f64::from(ring).to_radians();
            let turns = (360.0 * polar.sin()).ceil().max(1.0);
            for turn in 0..turns as i32 {
                let turn = (360.0 * f64::from(turn) / turns).to_radians();
                normals.push([polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos()]);
            }
        }
        normals
    }

    fn traction(stress: &StressTensor, n: &[f64; 3]) -> [f64; 3] {
        let [xx, yy, zz, xy, xz, yz] = stress.0;
        [
            xx * n[0] + xy * n[1] + xz * n[2],
            xy * n[0] + yy * n[1] + yz * n[2],
            xz * n[0] + yz * n[1] + zz * n[2],
        ]
    }

    fn product(a: &[f64; 3], b: &[f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// Both parameters on one plane, straight from their definitions.
    fn on_plane(cycle: &[StressTensor], n: &[f64; 3], limit: f64) -> [f64; 2] {
        let (young, nu) = (210e3, 0.3);
        let tractions: Vec<[f64; 3]> = cycle.iter().map(|stress| traction(stress, n)).collect();
        let normal: Vec<f64> = tractions.iter().map(|t| product(t, n)).collect();
        let most = normal.iter().copied().fold(0.0, f64::max);
        let strains: Vec<f64> = cycle
            .iter()
            .zip(&normal)
            .map(|(stress, across)| ((1.0 + nu) * across - nu * 3.0 * stress.hydrostatic()) / young)
            .collect();
        let range = strains.iter().copied().fold(f64::MIN, f64::max)
            - strains.iter().copied().fold(f64::MAX, f64::min);
        let mut chord = 0.0_f64;
        for (i, one) in tractions.iter().enumerate() {
            for (j, other) in tractions.iter().enumerate().take(i) {
                let apart: [f64; 3] = std::array::from_fn(|axis| {
                    (one[axis] - normal[i] * n[axis]) - (other[axis] - normal[j] * n[axis])
                });
                chord = chord.max(product(&apart, &apart).sqrt());
            }
        }
        [0.5 * most * range, 0.5 * chord / (young / 2.6) * (1.0 + most / limit)]
    }

    /// The plane that is found is nowhere worse than the best of all planes a degree apart by more than 1e-4 of the parameter: cycles out
    /// of phase under much, some and no mean compression, where hills lie beside each other and tension is confined to narrow cones.
    #[test]
    fn no_plane_a_degree_apart_is_larger_than_the_critical_one() {
        let planes = every_degree();
        let mut worst = [0.0_f64; 2];
        for (mean, increments) in [(0.0, 9), (-1.5, 9), (-2.0, 9)] {
            for cycle in cycles(60, increments, mean) {
                let limit = 1.0;
                let found = [
                    smith_watson_topper(&cycle, &steel()).value,
                    fatemi_socie(&cycle, &steel(), limit, 1.0).value,
                ];
                let mut largest = [0.0_f64; 2];
                for normal in &planes {
                    let here = on_plane(&cycle, normal, limit);
                    largest = [0, 1].map(|which| largest[which].max(here[which]));
                }
                for which in 0..2 {
                    if largest[which] > 0.0 {
                        let missing = 1.0 - found[which] / largest[which];
                        worst[which] = worst[which].max(missing);
                    }
                }
            }
        }
        println!("largest shortfall {worst:?}");
        assert!(worst.iter().all(|missing| *missing < 1e-4), "{worst:?}");
    }
}
