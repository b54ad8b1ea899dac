//! Criteria on the critical plane: the plane on which the parameter is largest.

use std::sync::LazyLock;

use pulp::{Arch, Simd, WithSimd};
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
    Arch::new().dispatch(OverPlanes(
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
    ))
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
    Arch::new().dispatch(OverPlanes(
        #[inline(always)]
        |planes: &Planes, mut best: f64| {
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
            let mut values = [f64::NEG_INFINITY; LANES];
            for (lane, value) in values.iter_mut().enumerate() {
                let factor = 0.5 * per_shear * (1.0 + sensitivity * stress_most[lane] / yield_strength);
                // no chord is longer than the diagonal of the box around the path
                let side = |[low, high]: &[[f64; LANES]; 2]| high[lane] - low[lane];
                let box_square: f64 = bounds.iter().map(|bounds| side(bounds) * side(bounds)).sum();
                if factor * box_square.sqrt() <= best {
                    continue;
                }
                let mut chord = 0.0_f64;
                for (index, one) in path.iter().enumerate() {
                    for other in &path[..index] {
                        let [a, b, c] = [0, 1, 2].map(|axis| one[axis][lane] - other[axis][lane]);
                        chord = larger(chord, a * a + b * b + c * c);
                    }
                }
                *value = factor * chord.sqrt();
                best = larger(best, *value);
            }
            values
        },
    ))
}

/// The search over planes for the largest value of a parameter.
struct OverPlanes<F>(F);

impl<F: FnMut(&Planes, f64) -> [f64; LANES]> WithSimd for OverPlanes<F> {
    type Output = CriticalPlane;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> CriticalPlane {
        largest_over_planes(self.0)
    }
}

/// Planes that are looked at together.
const LANES: usize = 8;

#[inline(always)]
fn larger(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}

#[inline(always)]
fn smaller(one: f64, other: f64) -> f64 {
    if other < one { other } else { one }
}

/// Unit normals of some planes: their parts along x, y, z.
#[derive(Clone, Copy)]
struct Planes([[f64; LANES]; 3]);

impl Planes {
    fn of(normals: &[[f64; 3]]) -> Self {
        let last = normals.len().saturating_sub(1);
        Self(std::array::from_fn(|axis| std::array::from_fn(|lane| normals[lane.min(last)][axis])))
    }

    #[inline(always)]
    fn normal(&self, lane: usize) -> [f64; 3] {
        self.0.map(|part| part[lane])
    }

    /// Normal stress on each plane [pressure].
    #[inline(always)]
    fn normal_stress(&self, stress: &StressTensor) -> [f64; LANES] {
        let ([xx, yy, zz, xy, xz, yz], [nx, ny, nz]) = (stress.0, &self.0);
        let mut across = [0.0; LANES];
        for l in 0..LANES {
            across[l] = nx[l] * (xx * nx[l] + 2.0 * (xy * ny[l] + xz * nz[l]))
                + ny[l] * (yy * ny[l] + 2.0 * yz * nz[l])
                + zz * nz[l] * nz[l];
        }
        across
    }

    /// Normal stress on each plane, and shear traction along x, y, z [pressure].
    #[inline(always)]
    fn traction(&self, stress: &StressTensor) -> ([f64; LANES], [[f64; LANES]; 3]) {
        let (mut across, mut shear) = ([0.0; LANES], [[0.0; LANES]; 3]);
        let ([xx, yy, zz, xy, xz, yz], [nx, ny, nz]) = (stress.0, &self.0);
        for l in 0..LANES {
            let x = xx * nx[l] + xy * ny[l] + xz * nz[l];
            let y = xy * nx[l] + yy * ny[l] + yz * nz[l];
            let z = xz * nx[l] + yz * ny[l] + zz * nz[l];
            across[l] = x * nx[l] + y * ny[l] + z * nz[l];
            shear[0][l] = x - across[l] * nx[l];
            shear[1][l] = y - across[l] * ny[l];
            shear[2][l] = z - across[l] * nz[l];
        }
        (across, shear)
    }
}

/// Normals over half the sphere, every ten degrees.
static COARSE: LazyLock<Vec<Planes>> = LazyLock::new(|| {
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
    normals.chunks(LANES).map(Planes::of).collect()
});

/// Largest value over the half sphere of normals: every ten degrees, then closer and closer around the best to a thousandth of
/// a degree. The parameter may return minus infinity where it cannot reach the second argument, the best so far.
#[inline(always)]
fn largest_over_planes(mut parameter: impl FnMut(&Planes, f64) -> [f64; LANES]) -> CriticalPlane {
    let mut best = (f64::NEG_INFINITY, [0.0, 0.0, 1.0]);
    for planes in COARSE.iter() {
        look(&mut parameter, planes, &mut best);
    }
    let mut step = 5.0_f64.to_radians();
    while step > 1e-3_f64.to_radians() {
        let (centre, before) = (best.1, best.0);
        let [one, other] = tangents(centre);
        let [a, b] = DIRECTIONS;
        let mut moved = Planes([[0.0; LANES]; 3]);
        for axis in 0..3 {
            for lane in 0..LANES {
                moved.0[axis][lane] = centre[axis] + step * (a[lane] * one[axis] + b[lane] * other[axis]);
            }
        }
        for lane in 0..LANES {
            let [x, y, z] = moved.normal(lane);
            let length = (x * x + y * y + z * z).sqrt();
            moved.0.iter_mut().for_each(|part| part[lane] /= length);
        }
        look(&mut parameter, &moved, &mut best);
        if best.0 == before {
            step *= 0.5;
        }
    }
    CriticalPlane { value: best.0, normal: best.1 }
}

/// Takes the best of some planes where it is better than the best so far.
#[inline(always)]
fn look(
    parameter: &mut impl FnMut(&Planes, f64) -> [f64; LANES],
    planes: &Planes,
    best: &mut (f64, [f64; 3]),
) {
    for (lane, value) in parameter(planes, best.0).into_iter().enumerate() {
        if value > best.0 {
            *best = (value, planes.normal(lane));
        }
    }
}

/// Where a better normal is looked for around the best.
const DIRECTIONS: [[f64; LANES]; 2] =
    [[1.0, -1.0, 0.0, 0.0, 0.7, 0.7, -0.7, -0.7], [0.0, 0.0, 1.0, -1.0, 0.7, -0.7, 0.7, -0.7]];

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
