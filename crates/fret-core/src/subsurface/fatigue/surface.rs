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
    let parts = RuizParts::of(cycle);
    Ruiz { f1: parts.f1(), f2: parts.f1() * parts.tension.0 }
}

/// What Ruiz's parameters at a point are made of: the largest of each over the cycle, and at which of its points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RuizParts {
    /// Largest shear traction [pressure].
    pub shear: (f64, usize),
    /// Longest chord of the path of slip [length], from one point to a later one.
    pub chord: (f64, [usize; 2]),
    /// Largest tension in the surface [pressure], 0 in compression.
    pub tension: (f64, usize),
}

impl RuizParts {
    /// Those of a cycle.
    pub fn of(cycle: &[SurfacePoint]) -> Self {
        let mut found = Self::default();
        for (n, one) in cycle.iter().enumerate() {
            let shear = one.shear[0].hypot(one.shear[1]);
            if shear > found.shear.0 {
                found.shear = (shear, n);
            }
            let tension = one.stress.tension_in_surface();
            if tension > found.tension.0 {
                found.tension = (tension, n);
            }
            for (m, other) in cycle[..n].iter().enumerate() {
                let chord = (one.slip[0] - other.slip[0]).hypot(one.slip[1] - other.slip[1]);
                if chord > found.chord.0 {
                    found.chord = (chord, [m, n]);
                }
            }
        }
        found
    }

    /// Largest shear traction times slip amplitude [pressure x length].
    pub fn f1(&self) -> f64 {
        self.shear.0 * 0.5 * self.chord.0
    }
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
