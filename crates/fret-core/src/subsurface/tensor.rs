//! Stress at a point and on a plane of points, and the single numbers engineers judge it by.

use ndarray::Array2;
use rayon::prelude::*;
use serde::Serialize;

/// Components xx, yy, zz, xy, xz, yz of a stress [pressure], tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct StressTensor(pub [f64; 6]);

/// Names of the components, in their order.
pub const COMPONENT_NAMES: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// Principal stresses, largest first, each with the unit vector along which it acts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Principal {
    /// Values [pressure], `values[0] >= values[1] >= values[2]`.
    pub values: [f64; 3],
    /// Directions `[x, y, z]`.
    pub directions: [[f64; 3]; 3],
}

impl StressTensor {
    /// Mean of the normal stresses [pressure], tension positive.
    pub fn hydrostatic(&self) -> f64 {
        let [xx, yy, zz, ..] = self.0;
        (xx + yy + zz) / 3.0
    }

    /// The tensor without its mean.
    #[must_use]
    pub fn deviator(&self) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        // differences first: nothing is lost under a large mean
        let (a, b, c) = (xx - yy, yy - zz, zz - xx);
        Self([(a - c) / 3.0, (b - a) / 3.0, (c - b) / 3.0, xy, xz, yz])
    }

    /// Von Mises equivalent stress [pressure]: `sqrt(3 J2)`.
    pub fn von_mises(&self) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let (a, b, c) = (xx - yy, yy - zz, zz - xx);
        (0.5 * (a * a + b * b + c * c) + 3.0 * (xy * xy + xz * xz + yz * yz)).sqrt()
    }

    /// Tresca equivalent stress [pressure]: largest minus smallest principal stress, twice the largest shear.
    pub fn tresca(&self) -> f64 {
        let [largest, _, smallest] = self.principal().values;
        largest - smallest
    }

    /// Traction on a plane with unit normal `n` [pressure].
    pub fn on_plane(&self, n: [f64; 3]) -> [f64; 3] {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        [
            xx * n[0] + xy * n[1] + xz * n[2],
            xy * n[0] + yy * n[1] + yz * n[2],
            xz * n[0] + yz * n[1] + zz * n[2],
        ]
    }

    /// Principal stresses and directions, by Jacobi's rotations (to rounding, also for equal ones).
    pub fn principal(&self) -> Principal {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let size: f64 = self.0.iter().map(|value| value.abs()).sum();
        for _sweep in 0..12 {
            if a[0][1].abs() + a[0][2].abs() + a[1][2].abs() <= 1e-17 * size {
                break;
            }
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                let r = 3 - p - q;
                let (apq, arp, arq) = (a[p][q], a[r][p], a[r][q]);
                a[p][p] -= t * apq;
                a[q][q] += t * apq;
                (a[p][q], a[q][p]) = (0.0, 0.0);
                (a[r][p], a[r][q]) = (c * arp - s * arq, s * arp + c * arq);
                (a[p][r], a[q][r]) = (a[r][p], a[r][q]);
                for row in &mut v {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
            }
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
        Principal { values: order.map(|i| a[i][i]), directions: order.map(|i| [v[0][i], v[1][i], v[2][i]]) }
    }
}

/// Stress under every cell at one depth, shape `(nx, ny)` each.
#[derive(Debug, Clone, PartialEq)]
pub struct StressField {
    /// xx, yy, zz, xy, xz, yz [pressure].
    pub components: [Array2<f64>; 6],
}

impl StressField {
    /// A field of zeros.
    pub fn zeros(shape: [usize; 2]) -> Self {
        Self { components: std::array::from_fn(|_| Array2::zeros((shape[0], shape[1]))) }
    }

    /// Adds an even stress along x and y [pressure].
    pub fn add(&mut self, stress: [f64; 2]) {
        for (component, stress) in self.components.iter_mut().zip(stress) {
            if stress != 0.0 {
                *component += stress;
            }
        }
    }

    /// Takes the numbers of another field of the same shape.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.components.par_iter_mut().zip(&other.components).for_each(|(to, from)| to.clone_from(from));
    }

    /// Stress at a cell.
    pub fn at(&self, i: usize, j: usize) -> StressTensor {
        StressTensor(std::array::from_fn(|component| self.components[component][[i, j]]))
    }

    /// A number of every cell's stress.
    pub fn map(&self, number: impl Fn(&StressTensor) -> f64) -> Array2<f64> {
        Array2::from_shape_fn(self.components[0].dim(), |(i, j)| number(&self.at(i, j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_states_have_their_textbook_numbers() {
        let tension = StressTensor([7.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!((tension.von_mises(), tension.tresca(), tension.hydrostatic()), (7.0, 7.0, 7.0 / 3.0));
        let shear = StressTensor([0.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
        assert!(
            (shear.von_mises() - 2.0 * 3.0_f64.sqrt()).abs() < 1e-15 && (shear.tresca() - 4.0).abs() < 1e-15
        );
        let principal = shear.principal();
        assert!((principal.values[0] - 2.0).abs() < 1e-15 && principal.values[1].abs() < 1e-15);
        let [x, y, z] = principal.directions[0];
        assert!((x - z).abs() < 1e-15 && y.abs() < 1e-15); // along the diagonal
        let pressed = StressTensor([-5.0, -5.0, -5.0, 0.0, 0.0, 0.0]);
        assert_eq!((pressed.von_mises(), pressed.tresca(), pressed.hydrostatic()), (0.0, 0.0, -5.0));
    }

    #[test]
    fn principal_stresses_rebuild_the_tensor() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for case in 0..300 {
            let mut t = StressTensor(std::array::from_fn(|_| random()));
            if case % 3 == 0 {
                t.0[1] = t.0[0];
                t.0[3] *= 1e-9;
            }
            let Principal { values, directions } = t.principal();
            assert!(values[0] >= values[1] && values[1] >= values[2]);
            for (value, n) in values.into_iter().zip(directions) {
                let traction = t.on_plane(n);
                for axis in 0..3 {
                    assert!((traction[axis] - value * n[axis]).abs() < 3e-15, "{t:?}"); // rounding of a few rotations
                }
            }
            // invariants
            let d = t.deviator();
            assert!((d.von_mises() - t.von_mises()).abs() < 1e-14 && d.hydrostatic().abs() < 1e-15);
            assert!(t.tresca() <= 2.0 / 3.0_f64.sqrt() * t.von_mises() * (1.0 + 1e-14));
        }
    }
}
