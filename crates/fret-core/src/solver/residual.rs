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
        let discs = Discs::new(self, q, s, stiffness);
        if discs.total <= 0.0 {
            return [0.0; 3];
        }
        let mut motion = [0.0; 3];
        for mode in 0..3 {
            if self.modes.by_force[mode] {
                motion[mode] = stiffness * guess[mode];
            }
        }
        let mut here = discs.potential(&motion);
        if size(&here.defect) > 0.5 * discs.total {
            // A guess far off: nothing moved may be nearer.
            let at_rest = discs.potential(&[0.0; 3]);
            if at_rest.value < here.value {
                motion = [0.0; 3];
                here = at_rest;
            }
        }
        for _ in 0..60 {
            let defect = size(&here.defect);
            if defect <= 4e-16 * discs.total {
                break;
            }
            let mut change = self.modes.solve(&here.curvature, &here.defect.map(|d| -d));
            let length = size(&change);
            if length > 2.0 * discs.spread {
                change = change.map(|c| c * 2.0 * discs.spread / length);
            }
            let slope: f64 = change.iter().zip(&here.defect).map(|(c, d)| c * d).sum();
            if slope >= 0.0 {
                break;
            }
            let slack = 1e-15 * (here.value.abs() + discs.total * discs.spread);
            let mut share = 1.0;
            let mut accepted = false;
            for _ in 0..30 {
                let trial = [0, 1, 2].map(|mode| motion[mode] + share * change[mode]);
                let there = discs.potential(&trial);
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
            if !accepted || (size(&here.defect) > 0.5 * defect && size(&here.defect) < 1e-14 * discs.total) {
                break;
            }
        }
        motion.map(|m| m / stiffness)
    }
}

fn size(vector: &[f64; 3]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The vectors `q - r s` of the cells in contact with the radii of their discs, gathered for many looks.
struct Discs<'a> {
    task: &'a TangentialTask<'a>,
    x: Vec<f64>,
    y: Vec<f64>,
    limit: Vec<f64>,
    /// Sum of the radii.
    total: f64,
    /// Largest component of a vector, or radius.
    spread: f64,
}

impl<'a> Discs<'a> {
    fn new(task: &'a TangentialTask<'_>, q: &TangentialField, s: &TangentialField, stiffness: f64) -> Self {
        let gathered = |q: &[f64], s: &[f64]| -> Vec<f64> {
            task.contact.iter().map(|&cell| q[cell] - stiffness * s[cell]).collect()
        };
        let limit: Vec<f64> = task.contact.iter().map(|&cell| task.bound[cell]).collect();
        let (x, y) = (gathered(&q.x, &s.x), gathered(&q.y, &s.y));
        let total = sum(&limit);
        let spread = x.iter().chain(&y).chain(&limit).fold(0.0_f64, |most, value| most.max(value.abs()));
        Self { task, x, y, limit, total, spread }
    }

    fn potential(&self, motion: &[f64; 3]) -> Potential {
        let mut potential =
            if self.task.modes.by_force[2] { self.with_rotation(motion) } else { self.straight(motion) };
        for mode in 0..3 {
            if self.task.modes.by_force[mode] {
                potential.value -= motion[mode] * self.task.resultant[mode];
                potential.defect[mode] -= self.task.resultant[mode];
            } else {
                potential.defect[mode] = 0.0;
            }
        }
        potential
    }

    /// Sums over the cells when no rotation is sought.
    fn straight(&self, motion: &[f64; 3]) -> Potential {
        let mut value = 0.0;
        let mut force = [0.0; 2];
        let mut curvature = [0.0; 3];
        let prescribed = self.task.modes.displacement(motion, 0);
        for ((x, y), &limit) in self.x.iter().zip(&self.y).zip(&self.limit) {
            let v = [x + prescribed[0], y + prescribed[1]];
            let square = v[0] * v[0] + v[1] * v[1];
            let length = square.sqrt();
            let inside = length <= limit;
            let share = if inside { 1.0 } else { limit / length };
            let along = if inside { [0.0, 0.0] } else { [v[0] / length, v[1] / length] };
            value += if inside { 0.5 * square } else { limit * (length - 0.5 * limit) };
            force[0] += share * v[0];
            force[1] += share * v[1];
            curvature[0] += share * (1.0 - along[0] * along[0]);
            curvature[1] += share * (1.0 - along[1] * along[1]);
            curvature[2] -= share * along[0] * along[1];
        }
        let [xx, yy, xy] = curvature;
        Potential {
            value,
            defect: [force[0], force[1], 0.0],
            curvature: [[xx, xy, 0.0], [xy, yy, 0.0], [0.0; 3]],
        }
    }

    /// Sums over the cells with all three motions.
    fn with_rotation(&self, motion: &[f64; 3]) -> Potential {
        let modes = self.task.modes;
        let mut value = 0.0;
        let mut defect = [0.0; 3];
        let mut curvature = [[0.0; 3]; 3];
        for (index, &cell) in self.task.contact.iter().enumerate() {
            let rigid = modes.displacement(motion, cell);
            let v = [self.x[index] + rigid[0], self.y[index] + rigid[1]];
            let limit = self.limit[index];
            let length = (v[0] * v[0] + v[1] * v[1]).sqrt();
            let inside = length <= limit;
            let share = if inside { 1.0 } else { limit / length };
            let along = if inside { [0.0, 0.0] } else { [v[0] / length, v[1] / length] };
            value += if inside { 0.5 * length * length } else { limit * (length - 0.5 * limit) };
            let products = modes.products([share * v[0], share * v[1]], cell);
            for mode in 0..3 {
                defect[mode] += products[mode];
                let a = modes.mode(mode, cell);
                let an = a[0] * along[0] + a[1] * along[1];
                for other in 0..3 {
                    let b = modes.mode(other, cell);
                    let bn = b[0] * along[0] + b[1] * along[1];
                    curvature[mode][other] += share * (a[0] * b[0] + a[1] * b[1] - an * bn);
                }
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
