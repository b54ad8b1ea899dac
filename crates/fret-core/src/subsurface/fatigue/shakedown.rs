//! Elastic shakedown at a point under a cycle of elastic stress.

use super::ball::{Point, farthest_from_centre};
use super::invariants::deviator_point;
use crate::subsurface::tensor::StressTensor;

/// Smallest yield strength (von Mises) for which some constant residual stress at the point keeps the whole cycle within the yield surface
/// [pressure]: `min over r of max over t of mises(s(t) - r)`, a smallest ball in the space of deviators.
///
/// The residual stress is free at every point: that it must be in equilibrium with that of its neighbours is left out. So this is a
/// lower bound of the yield strength that Melan's theorem asks for, and equal to it where the cycle is the same along the surface, as in
/// rolling over a half-plane (Johnson 1985, *Contact Mechanics*, sec. 9.1: `p0 = 4 k`). A constant residual stress does not change it.
pub fn shakedown_strength(cycle: &[StressTensor]) -> f64 {
    let path: Vec<Point> = cycle.iter().map(deviator_point).collect();
    1.5_f64.sqrt() * farthest_from_centre(&path)
}

/// Yield strength for which the cycle is elastic from the start [pressure]: its largest von Mises stress.
pub fn first_yield_strength(cycle: &[StressTensor]) -> f64 {
    cycle.iter().map(StressTensor::von_mises).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stress under a Hertz line contact of half-width 1 and pressure 1 at `(x, z)`, plane strain, without friction.
    ///
    /// Source: `McEwen` (1949), in Johnson (1985), *Contact Mechanics*, eq. 4.49.
    fn under_hertz_line(x: f64, z: f64, poisson: f64) -> StressTensor {
        let s = 1.0 - x * x + z * z;
        let root = (s * s + 4.0 * x * x * z * z).sqrt();
        let m = (0.5 * (root + s)).sqrt();
        let n = x.signum() * (0.5 * (root - s)).max(0.0).sqrt();
        let d = m * m + n * n;
        let xx = -(m * (1.0 + (z * z + n * n) / d) - 2.0 * z);
        let zz = -m * (1.0 - (z * z + n * n) / d);
        let xz = n * ((m * m - z * z) / d);
        StressTensor([xx, poisson * (xx + zz), zz, 0.0, xz, 0.0])
    }

    /// Rolling: every point at a depth has the stresses along the depth as its cycle. Johnson (1985), sec. 9.1: p0 = 4.00 k.
    #[test]
    fn a_rolling_cylinder_shakes_down_up_to_four_times_the_shear_strength() {
        let mut most = (0.0_f64, 0.0);
        for step in 1..200 {
            let z = 0.01 * f64::from(step);
            let cycle: Vec<StressTensor> =
                (-400..=400).map(|i| under_hertz_line(0.01 * f64::from(i), z, 0.3)).collect();
            let strength = shakedown_strength(&cycle);
            if strength > most.0 {
                most = (strength, z);
            }
        }
        let shear_strength = most.0 / 3.0_f64.sqrt();
        assert!((1.0 / shear_strength - 4.0).abs() < 2e-3, "{}", 1.0 / shear_strength); // steps of 0.01 of the half-width
        assert!((most.1 - 0.5).abs() < 0.02);
    }

    /// Stress under Hertz pressure on a circle of radius 1, largest pressure 1: Huber (1904); Timoshenko & Goodier, sec. 140.
    fn under_hertz_sphere(x: f64, y: f64, z: f64, nu: f64) -> StressTensor {
        let square = (x * x + y * y).max(1e-12);
        let s = square + z * z - 1.0;
        let u = 0.5 * (s + (s * s + 4.0 * z * z).sqrt());
        let root = u.sqrt();
        let q = z / root;
        let angle = root * (1.0 / root).atan();
        let even = (1.0 - 2.0 * nu) / 3.0 * (1.0 - q * q * q) / square;
        let down = q * q * q * u / (u * u + z * z);
        let radial = even + down + q * (u * (1.0 - nu) / (1.0 + u) + (1.0 + nu) * angle - 2.0);
        let hoop = -even - q * (2.0 * nu + u * (1.0 - nu) / (1.0 + u) - (1.0 + nu) * angle);
        let shear = -square.sqrt() * z * z / (u * u + z * z) * root / (1.0 + u);
        let (c, d) = (x / square.sqrt(), y / square.sqrt());
        let xx = radial * c * c + hoop * d * d;
        let yy = radial * d * d + hoop * c * c;
        StressTensor([xx, yy, -down, (radial - hoop) * c * d, shear * c, shear * d])
    }

    /// A sphere that rolls: p0 = 4.68 k (Johnson 1985, sec. 9.2), from the orthogonal shear, whose amplitude is .2139 p0 at a depth of .35: a
    /// residual stress can still all other components.
    #[test]
    fn a_rolling_sphere_shakes_down_up_to_what_its_orthogonal_shear_says() {
        let path = || (-300..300).map(|i| 0.02 * (f64::from(i) + 0.5)); // not on the axis
        let cycle = |y: f64, z: f64| -> Vec<StressTensor> {
            path().map(|x| under_hertz_sphere(x, y, z, 0.3)).collect()
        };
        let orthogonal = path().map(|x| under_hertz_sphere(x, 0.0, 0.35, 0.3).0[4]).fold(0.0, f64::max);
        assert!((1.0 / orthogonal - 4.68).abs() < 0.01, "{}", 1.0 / orthogonal); // the digits of the book
        let mut most = (0.0_f64, 0.0);
        for (y, steps) in [(0.0, 60), (0.2, 20)] {
            for step in 1..=steps {
                let z = 0.6 / f64::from(steps) * f64::from(step);
                let strength = shakedown_strength(&cycle(y, z));
                if strength > most.0 {
                    most = (strength, y);
                }
            }
        }
        let pressure = 3.0_f64.sqrt() / most.0;
        // the digits of the book; steps of 0.01 in depth
        assert!((pressure - 4.68).abs() < 0.01 && most.1 == 0.0, "{pressure}");
    }

    /// First yield under a cylinder and a sphere: Johnson (1985), sec. 6.2: by von Mises p0 = 3.1 k, nu = 0.3; and 1.60 Y.
    #[test]
    fn first_yield_has_the_textbook_pressures() {
        let line: Vec<StressTensor> =
            (0..400).map(|i| under_hertz_line(0.0, 0.005 * f64::from(i), 0.3)).collect();
        let in_shear = 3.0_f64.sqrt() / first_yield_strength(&line);
        assert!((in_shear - 3.1).abs() < 0.05, "{in_shear}"); // the digits of the book
        let axis = |z: f64| {
            // Johnson (1985), eq. 3.45
            let zz = -1.0 / (1.0 + z * z);
            let rr = -1.3 * (1.0 - z * (1.0_f64).atan2(z)) + 0.5 / (1.0 + z * z);
            StressTensor([rr, rr, zz, 0.0, 0.0, 0.0])
        };
        let sphere: Vec<StressTensor> = (0..400).map(|i| axis(0.005 * f64::from(i))).collect();
        assert!((1.0 / first_yield_strength(&sphere) - 1.60).abs() < 0.02);
    }

    #[test]
    fn a_constant_stress_is_shaken_down_and_a_reversed_one_is_not_helped() {
        let constant = vec![StressTensor([900.0, 0.0, -50.0, 20.0, 0.0, 0.0]); 5];
        assert!(shakedown_strength(&constant) < 1e-9);
        let swing = |value: f64| StressTensor([0.0, 0.0, 0.0, 0.0, value, 0.0]);
        let found = shakedown_strength(&[swing(100.0), swing(-100.0), swing(30.0)]);
        assert!((found - 100.0 * 3.0_f64.sqrt()).abs() < 1e-10);
        let pulsating = shakedown_strength(&[swing(0.0), swing(200.0)]);
        assert!((pulsating - found).abs() < 1e-10);
    }
}
