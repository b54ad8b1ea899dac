//! Criteria on the critical plane: the plane on which the parameter is largest.

use std::sync::LazyLock;

use serde::Serialize;

use crate::model::ElasticMaterial;
use crate::subsurface::tensor::StressTensor;

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
    largest_over_planes(|n, _| {
        let (mut least, mut most, mut stress_most) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for stress in cycle {
            let normal = normal_stress(stress, n);
            let strain = per_young * ((1.0 + nu) * normal - 3.0 * nu * stress.hydrostatic());
            least = least.min(strain);
            most = most.max(strain);
            stress_most = stress_most.max(normal);
        }
        if stress_most > rounding { stress_most * 0.5 * (most - least) } else { 0.0 }
    })
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
    largest_over_planes(|n, best| {
        path.clear();
        let mut stress_most = 0.0_f64;
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for stress in cycle {
            let traction = stress.on_plane(n);
            let normal = traction[0] * n[0] + traction[1] * n[1] + traction[2] * n[2];
            stress_most = stress_most.max(normal);
            let shear: [f64; 3] = std::array::from_fn(|axis| traction[axis] - normal * n[axis]);
            for axis in 0..3 {
                bounds[axis] = [bounds[axis][0].min(shear[axis]), bounds[axis][1].max(shear[axis])];
            }
            path.push(shear);
        }
        let factor = 0.5 * per_shear * (1.0 + sensitivity * stress_most / yield_strength);
        // no chord is longer than the diagonal of the box around the path
        let box_square: f64 = bounds.iter().map(|[low, high]| (high - low) * (high - low)).sum();
        if factor * box_square.sqrt() <= best {
            return f64::NEG_INFINITY;
        }
        let mut chord = 0.0_f64;
        for (index, one) in path.iter().enumerate() {
            for other in &path[..index] {
                let square: f64 = one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
                chord = chord.max(square);
            }
        }
        factor * chord.sqrt()
    })
}

fn normal_stress(stress: &StressTensor, n: [f64; 3]) -> f64 {
    let traction = stress.on_plane(n);
    traction[0] * n[0] + traction[1] * n[1] + traction[2] * n[2]
}

/// Normals over half the sphere, every ten degrees.
static COARSE: LazyLock<Vec<[f64; 3]>> = LazyLock::new(|| {
    const STEP: f64 = 10.0;
    let mut normals = Vec::new();
    for ring in 0..=9 {
        let polar = (f64::from(ring) * STEP).to_radians();
        let turns = (360.0 / STEP * polar.sin()).ceil().max(1.0) as i32;
        let (turns, span) = if ring == 9 { (turns / 2, 180.0_f64) } else { (turns, 360.0) };
        for turn in 0..turns {
            let turn = (span * f64::from(turn) / f64::from(turns)).to_radians();
            normals.push([polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos()]);
        }
    }
    normals
});

/// Largest value over the half sphere of normals: every ten degrees, then closer and closer around the best to a thousandth of
/// a degree. The parameter may return minus infinity where it cannot reach the second argument, the best so far.
fn largest_over_planes(mut parameter: impl FnMut([f64; 3], f64) -> f64) -> CriticalPlane {
    let mut best = (f64::NEG_INFINITY, [0.0, 0.0, 1.0]);
    for &normal in COARSE.iter() {
        let value = parameter(normal, best.0);
        if value > best.0 {
            best = (value, normal);
        }
    }
    let mut step = 5.0_f64.to_radians();
    while step > 1e-3_f64.to_radians() {
        let (centre, before) = (best.1, best.0);
        let [one, other] = tangents(centre);
        for (a, b) in DIRECTIONS {
            let moved: [f64; 3] =
                std::array::from_fn(|axis| centre[axis] + step * (a * one[axis] + b * other[axis]));
            let length = moved.iter().map(|part| part * part).sum::<f64>().sqrt();
            let normal = moved.map(|part| part / length);
            let value = parameter(normal, best.0);
            if value > best.0 {
                best = (value, normal);
            }
        }
        if best.0 == before {
            step *= 0.5;
        }
    }
    CriticalPlane { value: best.0, normal: best.1 }
}

/// Where a better normal is looked for around the best.
const DIRECTIONS: [(f64, f64); 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)];

/// Two unit vectors at right angles to a normal and to each other; those along and across its meridian.
fn tangents([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let flat = x.hypot(y);
    let [c, s] = if flat > 1e-9 { [x / flat, y / flat] } else { [1.0, 0.0] };
    [[z * c, z * s, -flat], [-s, c, 0.0]]
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
}
