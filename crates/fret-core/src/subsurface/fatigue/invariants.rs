//! Criteria by invariants: amplitude of the deviator and hydrostatic stress.

use serde::{Deserialize, Serialize};

use super::ball::{Point, centre};
use crate::subsurface::tensor::StressTensor;

/// Fatigue limits of a material under fully reversed loading [pressure].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Endurance {
    /// Amplitude endured in torsion.
    pub torsion: f64,
    /// Amplitude endured in tension and compression (or bending).
    pub tension: f64,
}

impl Endurance {
    /// Weight of the hydrostatic stress in Crossland's criterion: `3 t/s - sqrt(3)`.
    pub fn crossland_weight(&self) -> f64 {
        3.0 * self.torsion / self.tension - 3.0_f64.sqrt()
    }

    /// Weight of the hydrostatic stress in Dang Van's criterion: `3 t/s - 3/2`.
    pub fn dang_van_weight(&self) -> f64 {
        3.0 * self.torsion / self.tension - 1.5
    }
}

/// Crossland's use of the endurance: `(sqrt(J2)_a + w sigma_H,max) / t`; 1 is the limit.
///
/// `sqrt(J2)_a` is half the longest chord of the deviator's path, `max |S_i - S_j| / (2 sqrt 2)`; `sigma_H,max` the largest
/// hydrostatic stress of the cycle. Source: Crossland (1956), *Proc. Int. Conf. Fatigue of Metals*, 138.
pub fn crossland(cycle: &[StressTensor], endurance: &Endurance) -> f64 {
    let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
    let mut chord = 0.0_f64;
    for (n, one) in path.iter().enumerate() {
        for other in &path[..n] {
            let square: f64 = one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum();
            chord = chord.max(square);
        }
    }
    let amplitude = chord.sqrt() / 8.0_f64.sqrt();
    let hydrostatic = cycle.iter().map(StressTensor::hydrostatic).fold(f64::NEG_INFINITY, f64::max);
    (amplitude + endurance.crossland_weight() * hydrostatic) / endurance.torsion
}

/// Dang Van's use of the endurance: largest over the cycle of `(tau(t) + w sigma_H(t)) / t`; 1 is the limit.
///
/// `tau` is the largest shear (half of Tresca's stress) of the deviator less the centre of the smallest ball around its path:
/// the grain's residual stress after elastic shakedown. Source: Dang Van, Griveau & Message (1989), in *Biaxial and Multiaxial
/// Fatigue*, EGF 3, 479.
pub fn dang_van(cycle: &[StressTensor], endurance: &Endurance) -> f64 {
    let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
    let rest = centre(&path);
    let mut most = f64::NEG_INFINITY;
    for (stress, point) in cycle.iter().zip(&path) {
        most =
            most.max(0.5 * local(point, &rest).tresca() + endurance.dang_van_weight() * stress.hydrostatic());
    }
    most / endurance.torsion
}

/// Coordinates of a deviator in which the squared distance is `S : S`.
pub(super) fn deviator_point(stress: &StressTensor) -> Point {
    let [xx, yy, zz, xy, xz, yz] = stress.deviator().0;
    let root = 2.0_f64.sqrt();
    [1.5_f64.sqrt() * zz, (xx - yy) / root, root * xy, root * xz, root * yz]
}

/// Derivatives by the stress, from those by the coordinates of its deviator.
pub(super) fn stress_by_point([a, b, xy, xz, yz]: &Point) -> StressTensor {
    let root = 2.0_f64.sqrt();
    let along = 1.5_f64.sqrt() * a / 3.0;
    let [x, y] = [b / root - along, -b / root - along];
    StressTensor([x, y, 2.0 * along, root * xy, root * xz, root * yz])
}

/// Derivatives by the coordinates of the deviator, from those by the stress.
pub(super) fn point_by_stress(by: &StressTensor) -> Point {
    let [xx, yy, zz, xy, xz, yz] = by.0;
    let root = 2.0_f64.sqrt();
    [(zz - 0.5 * (xx + yy)) / 1.5_f64.sqrt(), (xx - yy) / root, xy / root, xz / root, yz / root]
}

/// The deviator less that at the centre of a ball.
pub(super) fn local(point: &Point, rest: &Point) -> StressTensor {
    tensor_of(&std::array::from_fn(|n| point[n] - rest[n]))
}

fn tensor_of([a, b, xy, xz, yz]: &Point) -> StressTensor {
    let root = 2.0_f64.sqrt();
    let zz = a / 1.5_f64.sqrt();
    let half = b / root;
    StressTensor([half - 0.5 * zz, -half - 0.5 * zz, zz, xy / root, xz / root, yz / root])
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Endurance = Endurance { torsion: 180.0, tension: 290.0 };

    /// A cycle between two states in small steps.
    fn cycle(mean: [f64; 6], amplitude: [f64; 6]) -> Vec<StressTensor> {
        (0..40)
            .map(|n| {
                let phase = (std::f64::consts::TAU * f64::from(n) / 40.0).sin();
                StressTensor(std::array::from_fn(|c| mean[c] + phase * amplitude[c]))
            })
            .collect()
    }

    #[test]
    fn both_limits_are_met_exactly_by_the_tests_that_define_them() {
        let torsion = cycle([0.0; 6], [0.0, 0.0, 0.0, 180.0, 0.0, 0.0]);
        let tension = cycle([0.0; 6], [0.0, 290.0, 0.0, 0.0, 0.0, 0.0]);
        for load in [torsion, tension] {
            assert!((crossland(&load, &LIMITS) - 1.0).abs() < 1e-12);
            assert!((dang_van(&load, &LIMITS) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn repeated_tension_by_hand() {
        // sigma between 0 and 2 s: amplitude s in both criteria, largest hydrostatic stress 2 s/3
        let s = 100.0;
        let load = cycle([s, 0.0, 0.0, 0.0, 0.0, 0.0], [s, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let by_crossland = (s / 3.0_f64.sqrt() + LIMITS.crossland_weight() * 2.0 * s / 3.0) / 180.0;
        let by_dang_van = (s / 2.0 + LIMITS.dang_van_weight() * 2.0 * s / 3.0) / 180.0;
        assert!((crossland(&load, &LIMITS) - by_crossland).abs() < 1e-12);
        assert!((dang_van(&load, &LIMITS) - by_dang_van).abs() < 1e-12);
    }

    #[test]
    fn a_mean_torsion_does_no_harm_and_coordinates_keep_the_tensor() {
        let load = cycle([0.0, 0.0, 0.0, 500.0, 0.0, 0.0], [0.0, 0.0, 0.0, 90.0, 0.0, 0.0]);
        assert!(
            (crossland(&load, &LIMITS) - 0.5).abs() < 1e-12 && (dang_van(&load, &LIMITS) - 0.5).abs() < 1e-12
        );
        let stress = StressTensor([1.0, -2.0, 5.0, 0.3, -0.7, 2.0]);
        let back = tensor_of(&deviator_point(&stress));
        for (found, exact) in back.0.iter().zip(stress.deviator().0) {
            assert!((found - exact).abs() < 1e-14);
        }
    }
}
