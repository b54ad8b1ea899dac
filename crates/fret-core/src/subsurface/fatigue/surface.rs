//! Criteria of the surface itself: friction and slip.

use serde::Serialize;

use crate::subsurface::tensor::StressTensor;

/// What happens at a point of the surface in one increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Shear traction along x and y [pressure].
    pub shear: [f64; 2],
    /// Accumulated slip along x and y [length].
    pub slip: [f64; 2],
    /// Stress in the surface [pressure].
    pub stress: StressTensor,
}

/// Ruiz's two parameters at a point.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Ruiz {
    /// `tau delta` [pressure x length]: where friction damages the surface.
    pub f1: f64,
    /// `sigma_T tau delta` [pressure^2 x length]: where a crack starts and grows.
    pub f2: f64,
}

/// Ruiz's parameters over a cycle: largest shear traction times amplitude of the slip (half the longest chord of its path), and
/// that times the largest tension in the surface (largest principal stress in its plane, zero if compressive).
///
/// Source: Ruiz, Boddington & Chen (1984), *Exp. Mech.* 24, 208.
pub fn ruiz(cycle: &[SurfacePoint]) -> Ruiz {
    let shear = cycle.iter().map(|point| point.shear[0].hypot(point.shear[1])).fold(0.0, f64::max);
    let mut range = 0.0_f64;
    for (n, one) in cycle.iter().enumerate() {
        for other in &cycle[..n] {
            range = range.max((one.slip[0] - other.slip[0]).hypot(one.slip[1] - other.slip[1]));
        }
    }
    let tension = cycle
        .iter()
        .map(|point| {
            let [xx, yy, _, xy, ..] = point.stress.0;
            0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)
        })
        .fold(0.0, f64::max);
    let f1 = shear * 0.5 * range;
    Ruiz { f1, f2: f1 * tension }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliding_strip_by_hand() {
        // slip between -2 and 2, shear 30, tension in the surface between -50 and 50 along x
        let cycle: Vec<SurfacePoint> = (0..16)
            .map(|n| {
                let phase = (std::f64::consts::TAU * f64::from(n) / 16.0).cos();
                SurfacePoint {
                    shear: [30.0 * phase, 0.0],
                    slip: [5.0 + 2.0 * phase, 1.0],
                    stress: StressTensor([50.0 * phase, 0.0, -100.0, 0.0, -30.0 * phase, 0.0]),
                }
            })
            .collect();
        let found = ruiz(&cycle);
        assert!((found.f1 - 60.0).abs() < 1e-12 && (found.f2 - 3000.0).abs() < 1e-9);
    }
}
