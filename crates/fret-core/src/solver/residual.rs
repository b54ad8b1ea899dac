//! The judge: how well pressure and shear satisfy their laws. Finds approach, shift and twist on the way.

use super::rigid::RigidModes;
use crate::model::field::{TangentialField, dot, sum};

/// Verdict on the normal side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalVerdict {
    /// Rigid approach [length].
    pub approach: f64,
    /// Largest `|min(gap, K00 p)|` over the cells, in units of the mean displacement under the load.
    pub residual: f64,
}

/// Judges pressures; `height` is normal displacement + undeformed gap and becomes the gap. `own` is a cell's influence on itself.
pub fn judge_normal(
    pressure: &[f64],
    height: &mut [f64],
    undeformed: &[f64],
    own: f64,
    approach: Option<f64>,
) -> NormalVerdict {
    let loaded = sum(pressure);
    let approach = approach.unwrap_or_else(|| mean_where_loaded(pressure, height));
    if loaded <= 0.0 {
        let lowest = height.iter().copied().fold(f64::INFINITY, f64::min);
        for gap in height.iter_mut() {
            *gap -= approach;
        }
        let residual = if lowest >= approach { 0.0 } else { 1.0 };
        return NormalVerdict { approach, residual };
    }
    let work = dot(pressure, height) - dot(pressure, undeformed);
    let scale = (work / loaded).abs();
    let mut worst = 0.0_f64;
    for (gap, &p) in height.iter_mut().zip(pressure) {
        *gap -= approach;
        worst = worst.max(gap.min(own * p).abs());
    }
    NormalVerdict { approach, residual: if scale > 0.0 { worst / scale } else { f64::INFINITY } }
}

/// Mean of a field over the loaded cells; its lowest value when none is loaded.
fn mean_where_loaded(pressure: &[f64], field: &[f64]) -> f64 {
    let mut total = 0.0;
    let mut count = 0_usize;
    for (&p, &value) in pressure.iter().zip(field) {
        if p > 0.0 {
            total += value;
            count += 1;
        }
    }
    if count > 0 { total / count as f64 } else { field.iter().copied().fold(f64::INFINITY, f64::min) }
}

/// What the tangential equations of one increment ask for, over the cells of a box.
#[derive(Debug)]
pub struct TangentialTask<'a> {
    /// Cells in contact.
    pub contact: &'a [usize],
    /// Friction bound mu p of every cell [pressure].
    pub bound: &'a [f64],
    /// Tangential displacement before the increment [length].
    pub before: &'a TangentialField,
    /// Rigid motions.
    pub modes: &'a RigidModes,
    /// Increments of the motions that are prescribed [length]; 0 for the others.
    pub motion: [f64; 3],
    /// Sums over the cells of shear times mode, for the motions that follow from a resultant [pressure].
    pub resultant: [f64; 3],
    /// Influence of a cell's own shear [length/pressure].
    pub own: f64,
}

/// Verdict on the tangential side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialVerdict {
    /// Increments of shift (x, y) and of twist x length [length].
    pub motion: [f64; 3],
    /// `|q - Proj(q - s / K)| / |mu p|`, Euclidean.
    pub residual: f64,
}

/// Gradient, curvature and value of the convex potential whose root is the rigid motion.
struct Potential {
    value: f64,
    defect: [f64; 3],
    curvature: [[f64; 3]; 3],
}

impl TangentialTask<'_> {
    /// Judges shear `q` with displacement `u`; `s` becomes minus the slip increment. `guess` starts the search for the motions.
    pub fn judge(
        &self,
        q: &TangentialField,
        u: &TangentialField,
        guess: [f64; 3],
        s: &mut TangentialField,
    ) -> TangentialVerdict {
        let stiffness = 1.0 / self.own;
        s.clear();
        for &cell in self.contact {
            let rigid = self.modes.displacement(&self.motion, cell);
            let (now, before) = (u.at(cell), self.before.at(cell));
            s.set(cell, [now[0] - before[0] - rigid[0], now[1] - before[1] - rigid[1]]);
        }
        let found =
            if self.modes.any_by_force() { self.motion_by_force(q, s, stiffness, guess) } else { [0.0; 3] };
        let mut off = 0.0;
        let mut bound = 0.0;
        for &cell in self.contact {
            let rigid = self.modes.displacement(&found, cell);
            let pull = [s.x[cell] - rigid[0], s.y[cell] - rigid[1]];
            s.set(cell, pull);
            let limit = self.bound[cell];
            let shear = q.at(cell);
            let image = project([shear[0] - stiffness * pull[0], shear[1] - stiffness * pull[1]], limit);
            off += (shear[0] - image[0]).powi(2) + (shear[1] - image[1]).powi(2);
            bound += limit * limit;
        }
        let mut motion = self.motion;
        for mode in 0..3 {
            if self.modes.by_force[mode] {
                motion[mode] = found[mode];
            }
        }
        let residual = if bound > 0.0 { (off / bound).sqrt() } else { 0.0 };
        TangentialVerdict { motion, residual }
    }

    /// Root of `sum Proj(q - r s + r motion) . mode = resultant`: Newton on a convex potential, with Armijo's rule.
    fn motion_by_force(
        &self,
        q: &TangentialField,
        s: &TangentialField,
        stiffness: f64,
        guess: [f64; 3],
    ) -> [f64; 3] {
        let total: f64 = self.contact.iter().map(|&cell| self.bound[cell]).sum();
        if total <= 0.0 {
            return [0.0; 3];
        }
        let mut spread = 0.0_f64;
        for &cell in self.contact {
            spread = spread.max((q.x[cell] - stiffness * s.x[cell]).abs());
            spread = spread.max((q.y[cell] - stiffness * s.y[cell]).abs());
            spread = spread.max(self.bound[cell]);
        }
        let mut motion = [0.0; 3];
        for mode in 0..3 {
            if self.modes.by_force[mode] {
                motion[mode] = stiffness * guess[mode];
            }
        }
        let mut here = self.potential(q, s, stiffness, &motion);
        let at_zero = self.potential(q, s, stiffness, &[0.0; 3]);
        if at_zero.value < here.value {
            motion = [0.0; 3];
            here = at_zero;
        }
        let size = |defect: &[f64; 3]| defect.iter().map(|d| d * d).sum::<f64>().sqrt();
        for _ in 0..60 {
            let defect = size(&here.defect);
            if defect <= 4e-16 * total {
                break;
            }
            let mut change = self.modes.solve(&here.curvature, &here.defect.map(|d| -d));
            let length = size(&change);
            if length > 2.0 * spread {
                change = change.map(|c| c * 2.0 * spread / length);
            }
            let slope: f64 = change.iter().zip(&here.defect).map(|(c, d)| c * d).sum();
            if slope >= 0.0 {
                break;
            }
            let mut share = 1.0;
            let mut accepted = false;
            for _ in 0..30 {
                let trial = [0, 1, 2].map(|mode| motion[mode] + share * change[mode]);
                let there = self.potential(q, s, stiffness, &trial);
                let slack = 1e-15 * (here.value.abs() + total * spread);
                if there.value <= here.value + 1e-4 * share * slope
                    || (there.value <= here.value + slack && size(&there.defect) < defect)
                {
                    motion = trial;
                    here = there;
                    accepted = true;
                    break;
                }
                share *= 0.5;
            }
            if !accepted {
                break;
            }
        }
        motion.map(|m| m / stiffness)
    }

    fn potential(
        &self,
        q: &TangentialField,
        s: &TangentialField,
        stiffness: f64,
        motion: &[f64; 3],
    ) -> Potential {
        let mut value = 0.0;
        let mut defect = self.resultant.map(|target| -target);
        let mut curvature = [[0.0; 3]; 3];
        let rotates = self.modes.by_force[2];
        let mut straight = [0.0; 3];
        for &cell in self.contact {
            let rigid = self.modes.displacement(motion, cell);
            let v =
                [q.x[cell] - stiffness * s.x[cell] + rigid[0], q.y[cell] - stiffness * s.y[cell] + rigid[1]];
            let limit = self.bound[cell];
            let square = v[0] * v[0] + v[1] * v[1];
            let (image, share, along) = if square <= limit * limit {
                value += 0.5 * square;
                (v, 1.0, [0.0; 2])
            } else {
                let size = square.sqrt();
                value += limit * (size - 0.5 * limit);
                let along = [v[0] / size, v[1] / size];
                ([limit * along[0], limit * along[1]], limit / size, along)
            };
            if rotates {
                let products = self.modes.products(image, cell);
                for mode in 0..3 {
                    defect[mode] += products[mode];
                    let a = self.modes.mode(mode, cell);
                    let an = a[0] * along[0] + a[1] * along[1];
                    for (other, entry) in curvature[mode].iter_mut().enumerate() {
                        let b = self.modes.mode(other, cell);
                        let bn = b[0] * along[0] + b[1] * along[1];
                        *entry += share * (a[0] * b[0] + a[1] * b[1] - an * bn);
                    }
                }
            } else {
                defect[0] += image[0];
                defect[1] += image[1];
                straight[0] += share * (1.0 - along[0] * along[0]);
                straight[1] += share * (1.0 - along[1] * along[1]);
                straight[2] -= share * along[0] * along[1];
            }
        }
        if !rotates {
            curvature[0][0] = straight[0];
            curvature[1][1] = straight[1];
            curvature[0][1] = straight[2];
            curvature[1][0] = straight[2];
        }
        for mode in 0..3 {
            if self.modes.by_force[mode] {
                value -= motion[mode] * self.resultant[mode];
            } else {
                defect[mode] = 0.0;
            }
        }
        Potential { value, defect, curvature }
    }
}

/// Nearest point of the friction disc.
#[inline]
pub fn project(vector: [f64; 2], limit: f64) -> [f64; 2] {
    let square = vector[0] * vector[0] + vector[1] * vector[1];
    if square <= limit * limit {
        vector
    } else {
        let share = limit / square.sqrt();
        [vector[0] * share, vector[1] * share]
    }
}
