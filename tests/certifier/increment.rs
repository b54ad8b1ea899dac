//! The laws that one increment has to hold.

use fret_core::history::{Regime, StepRecord};
use fret_core::model::{Control, CoulombFriction, LoadStep, SurfaceGrid, Zone};
use ndarray::Array2;

use super::influence::Influence;
use super::measure::{Raise, dot, hypot, largest, over, size};
use super::slip_path::{CellPath, Pace, Past};
use super::{Before, Certificate};

/// The rule by which friction dissipates in a cell, per area: the mean of the friction bounds `[before, after]` the increment times the way.
pub fn dissipated([before, after]: [f64; 2], way: f64) -> f64 {
    0.5 * (before + after) * way
}

/// The rule for the slip of a cell that comes out of contact: half of its motion along the shear before, times the fraction of the friction
/// bound that this shear was.
pub fn slip_until_open(change: [f64; 2], shear: [f64; 2], bound: f64) -> [f64; 2] {
    let size = hypot(shear);
    if size == 0.0 || bound == 0.0 {
        return [0.0; 2];
    }
    let along = shear.map(|part| part / size);
    let half = 0.5 * dot(change, along).max(0.0) * size / bound;
    along.map(|part| part * half)
}

/// The way of a slip increment: where a cell slips at both ends of the increment, the arc with it as chord that turns by the angle of the
/// shear, faded into the chord as the cosine falls to 1/2.
pub fn way(chord: [f64; 2], shear: [[f64; 2]; 2], zones: [Zone; 2]) -> f64 {
    let [before, after] = shear;
    let cosine = dot(before, after) / (hypot(before) * hypot(after));
    if zones != [Zone::Slip; 2] || !(cosine > 0.5 && cosine < 1.0) {
        return hypot(chord);
    }
    let arc = cosine.acos() / (2.0 * (1.0 - cosine)).sqrt();
    hypot(chord) * (arc * (2.0 * cosine - 1.0) + 2.0 * (1.0 - cosine))
}

#[derive(Clone, Copy)]
pub(super) struct Fields<'a> {
    pub(super) p: &'a Array2<f64>,
    pub(super) q: &'a [Array2<f64>; 2],
    pub(super) slip: &'a [Array2<f64>; 2],
    pub(super) gap: &'a Array2<f64>,
    pub(super) zone: &'a Array2<Zone>,
}

/// One increment with all it has to hold.
pub(super) struct Increment<'a> {
    /// Cycles may stand for others that are not computed.
    pub(super) jumps: bool,
    pub(super) grid: &'a SurfaceGrid,
    pub(super) influence: &'a Influence,
    pub(super) undeformed: &'a Array2<f64>,
    pub(super) before: &'a Before,
    pub(super) zone_before: Option<&'a Array2<Zone>>,
    pub(super) record: &'a StepRecord,
    /// There is friction somewhere in the history: slip is followed.
    pub(super) slides: bool,
    pub(super) law: &'a CoulombFriction,
    pub(super) load: LoadStep,
    pub(super) fields: Fields<'a>,
    pub(super) displacements: &'a [Array2<f64>; 3],
    /// What went before, and the length of this increment over the last and the same of the normal load, where slip is integrated to second
    /// order.
    pub(super) past: Option<(&'a Past, Pace)>,
    /// What went before is known.
    pub(super) is_known: bool,
    /// Strain of the lower surface less that of the upper one.
    pub(super) strain: [f64; 2],
}

impl Increment<'_> {
    /// Judges everything.
    pub(super) fn certificate(&self) -> Certificate {
        let mut certificate = Certificate {
            increment: self.record.increment,
            whole: self.record.parts == 1 && self.is_known,
            equilibrium: self.equilibrium(),
            motion: self.motion(),
            columns: self.columns(),
            moment: over(self.record.twist_moment - self.resultants()[3], self.units()[3]),
            turns: self.load.twist != Control::Motion(0.0) || self.before.twist != 0.0,
            ..Certificate::default()
        };
        self.judge_normal(&mut certificate);
        self.judge_friction(&mut certificate);
        certificate.balance = self.balance();
        certificate
    }

    fn judge_normal(&self, certificate: &mut Certificate) {
        let Fields { p, gap, .. } = self.fields;
        let u = &self.displacements[0];
        let total = p.sum();
        let mean = if total > 0.0 { (p * u).sum() / total } else { 0.0 };
        // Flat periodic surfaces are not displaced; what a cell gives way by to the mean pressure is then what counts.
        let loaded = p.iter().filter(|p| **p > 0.0).count().max(1) as f64;
        let mean = mean.max(1e-5 * self.influence.own_normal * total / loaded);
        let largest = largest(p);
        for ((i, j), &p) in p.indexed_iter() {
            let at = [i, j];
            let worn = self.before.worn.as_ref().map_or(0.0, |worn| worn[at]);
            let [x, y] = self.place(at);
            let tilted = self.record.tilt[0] * x + self.record.tilt[1] * y;
            let found = self.undeformed[at] - tilted + worn + u[at] - self.record.approach;
            let terms = [self.undeformed[at], tilted, worn, u[at], self.record.approach, mean];
            if found != gap[at] {
                certificate.gap.raise(over(found - gap[at], size(&terms)));
            }
            // Without a load the approach is what an overlap can be compared with.
            let off = if mean > 0.0 {
                found.min(self.influence.own_normal * p) / mean
            } else {
                over(found.min(0.0), size(&terms))
            };
            certificate.complementarity.raise(off);
            certificate.tension.raise(over((-p).max(0.0), largest));
        }
    }

    fn judge_friction(&self, certificate: &mut Certificate) {
        let Fields { p, q, slip, zone, .. } = self.fields;
        let bound = self.bound();
        let most = largest(&bound);
        let norm = bound.iter().map(|bound| bound * bound).sum::<f64>().sqrt();
        let kt = self.influence.own_tangential;
        let (mut off, mut work, mut limit) = (0.0, 0.0, 0.0);
        let scale = self.largest_term_of_slip();
        for ((i, j), &zone) in zone.indexed_iter() {
            let at = [i, j];
            let (q, bound) = ([q[0][at], q[1][at]], bound[at]);
            let length = hypot(q);
            certificate.excess.raise(over((length - bound).max(0.0), most));
            let kept = [0, 1].map(|axis| slip[axis][at] - self.before.slip[axis][at]);
            let zones = [self.zone_before.map_or(Zone::Open, |zone| zone[at]), zone];
            let shear_before = [0, 1].map(|axis| self.before.shear[axis][at]);
            let bound_before = self.bound_at(at, self.before.pressure[at]);
            work += dissipated([bound_before, bound], way(kept, [shear_before, q], zones));
            limit += bound.max(bound_before) * hypot(kept);
            if zone == Zone::Slip {
                certificate.on_circle.raise(over((bound - length).max(0.0), most));
            }
            let path = self.past.map_or(CellPath::STRAIGHT, |(past, pace)| past.path(at, pace));
            if zone == Zone::Stick && certificate.whole && path.counted([0.0; 2], zone) == [0.0; 2] {
                // Exactly: nothing is added to the slip of a cell that does not slip.
                certificate.slip.raise(if kept == [0.0; 2] { 0.0 } else { 1.0 });
            }
            if zone == Zone::Open && certificate.whole && self.slides {
                let slip = slip_until_open(self.slip_increment(at), shear_before, bound_before);
                certificate.slip.raise(over(hypot([kept[0] - slip[0], kept[1] - slip[1]]), scale));
            }
            if !certificate.whole || !self.slides || zone == Zone::Open || p[at] <= 0.0 {
                continue;
            }
            let change = self.slip_increment(at);
            let counted = path.counted(change, zone);
            certificate.slip.raise(over(hypot([kept[0] - counted[0], kept[1] - counted[1]]), scale));
            let v = path.end(change);
            let w = v.map(|v| v / kt);
            let image = project([q[0] + w[0], q[1] + w[1]], bound);
            off += (q[0] - image[0]).powi(2) + (q[1] - image[1]).powi(2);
            if zone == Zone::Stick {
                certificate.stick.raise(over(hypot(w), norm));
                continue;
            }
            if bound > 0.0 {
                let across = (q[0] * w[1] - q[1] * w[0]).abs() / bound;
                certificate.direction.raise(over(across, norm * (1.0 + hypot(w) / bound)));
                certificate.against.raise(over((-dot(q, w) / bound).max(0.0), norm));
            }
        }
        certificate.coulomb = over(off.sqrt(), norm);
        let area = self.grid.cell_area();
        let more = self.record.dissipated_energy - self.before.energy;
        let unit = size(&[limit * area, self.record.dissipated_energy]);
        // Of an increment in parts only the sign is known; one that ends a cycle counts those as well that the cycle stands for.
        let wrong = match (certificate.whole, self.jumps) {
            (true, false) => more - work * area,
            (true, true) => (work * area - more).max(0.0),
            (false, _) => (-more).max(0.0),
        };
        certificate.energy = over(wrong, unit);
    }

    /// Middle of a cell.
    fn place(&self, at: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.grid.centre(axis, at[axis]))
    }

    /// The first law of thermodynamics, of the numbers that are kept: the work of all loads, bulk stresses included, less the change of
    /// the elastic energy, the work of the mean shear on the kept slip and what cells that open or close leave, over the sizes of these.
    /// Means of both ends are exact for a linear response. Of increments solved as a whole, without wear.
    fn balance(&self) -> f64 {
        if self.record.parts > 1 || self.before.worn.is_some() {
            return 0.0;
        }
        let Fields { p, q, slip, gap, .. } = self.fields;
        let (now, then) = (self.record, self.before);
        let [u, v, w] = self.displacements;
        let (mut stored, mut slipped, mut opened, mut friction) = (0.0, 0.0, 0.0, 0.0);
        let (mut force, mut moment, mut tilting) = ([0.0; 3], 0.0, [0.0; 2]);
        for ((i, j), &p1) in p.indexed_iter() {
            let at = [i, j];
            let (p0, before) = (then.pressure[at], [0, 1].map(|axis| then.shear[axis][at]));
            let after = [0, 1].map(|axis| q[axis][at]);
            let mean = [0, 1].map(|axis| 0.5 * (before[axis] + after[axis]));
            stored += 0.5 * (p1 * u[at] + after[0] * v[at] + after[1] * w[at]);
            stored -= 0.5
                * (p0 * then.normal[at]
                    + before[0] * then.tangential[0][at]
                    + before[1] * then.tangential[1][at]);
            // Cells that have opened move as they like, and nothing is kept of it.
            let moved = if p1 > 0.0 {
                [0, 1].map(|axis| slip[axis][at] - then.slip[axis][at])
            } else {
                self.slip_increment(at)
            };
            slipped += dot(mean, moved);
            friction += hypot(mean) * hypot(self.slip_increment(at));
            if p0 > 0.0 || p1 > 0.0 {
                opened += 0.5 * (p1 * then.gap[at] - p0 * gap[at]);
            }
            let [x, y] = self.place(at);
            let pressure = 0.5 * (p0 + p1);
            for (sum, value) in force.iter_mut().zip([pressure, mean[0], mean[1]]) {
                *sum += value;
            }
            moment += x * mean[1] - y * mean[0];
            tilting = [tilting[0] + x * pressure, tilting[1] + y * pressure];
        }
        let by_tilt = (0..2).map(|axis| tilting[axis] * (now.tilt[axis] - then.tilt[axis])).sum::<f64>();
        let works = [
            force[0] * (now.approach - then.approach),
            force[1] * (now.shift[0] - then.shift[0]),
            force[2] * (now.shift[1] - then.shift[1]),
            moment * (now.twist - then.twist),
            by_tilt,
            (now.bulk_work - then.bulk_work) / self.grid.cell_area(),
        ];
        let off = works.iter().sum::<f64>() - stored - slipped - opened;
        over(off, size(&works).max(size(&[stored, opened, friction])))
    }

    /// Friction bound of every cell.
    fn bound(&self) -> Array2<f64> {
        let mut bound = self.fields.p.clone();
        bound.indexed_iter_mut().for_each(|((i, j), p)| *p = self.bound_at([i, j], *p));
        bound
    }

    /// Friction bound of a cell under a pressure, `min(mu p, tau)`.
    fn bound_at(&self, [i, j]: [usize; 2], pressure: f64) -> f64 {
        let strength = self.law.max_shear().map_or(f64::INFINITY, |strength| strength.at(i, j));
        (self.law.at(i, j) * pressure).min(strength)
    }

    /// That of every cell; of one that has come into contact, that of a whole increment at its rate from the moment of touch on.
    pub(super) fn drift(&self) -> [Array2<f64>; 2] {
        let mut drift = [0, 1].map(|_| Array2::zeros(self.fields.p.dim()));
        for ((i, j), &p) in self.fields.p.indexed_iter() {
            let at = [i, j];
            let change = self.slip_increment(at);
            let entered = self.zone_before.is_some_and(|zone| zone[at] == Zone::Open) && p > 0.0;
            let path = self.past.filter(|_| entered).map(|(past, pace)| past.path(at, pace));
            let found = path.map_or(change, |path| path.rate(change));
            (0..2).for_each(|axis| drift[axis][at] = found[axis]);
        }
        drift
    }

    /// Motion of the upper point less that of the lower one in the increment [length].
    fn slip_increment(&self, at: [usize; 2]) -> [f64; 2] {
        let turned = self.record.twist - self.before.twist;
        let turn = [-turned * self.grid.centre(1, at[1]), turned * self.grid.centre(0, at[0])];
        [0, 1].map(|axis| {
            let stretched = (self.strain[axis] - self.before.strain[axis]) * self.place(at)[axis];
            let moved = self.record.shift[axis] - self.before.shift[axis] + turn[axis] - stretched;
            moved - (self.displacements[1 + axis][at] - self.before.tangential[axis][at])
        })
    }

    /// Largest number that enters a slip increment [length].
    fn largest_term_of_slip(&self) -> f64 {
        let [_, x, y] = self.displacements;
        let [half_x, half_y] = self.grid.size().map(|side| 0.5 * side);
        let fields = [x, y, &self.before.tangential[0], &self.before.tangential[1]].map(largest);
        let slips = [&self.fields.slip[0], &self.fields.slip[1]].map(largest);
        let turn = self.record.twist.abs().max(self.before.twist.abs()) * half_x.hypot(half_y);
        let shifts = [self.record.shift, self.before.shift].map(hypot);
        let strains =
            [self.strain, self.before.strain].map(|[x, y]| (x * half_x).abs().max((y * half_y).abs()));
        size(&[size(&fields), size(&slips), size(&shifts), size(&strains), turn])
    }

    /// Sums of the tractions: normal force, tangential forces, moment about z.
    fn resultants(&self) -> [f64; 4] {
        let Fields { p, q, .. } = self.fields;
        let mut moment = 0.0;
        for ((i, j), &x) in q[0].indexed_iter() {
            moment += q[1][[i, j]] * self.grid.centre(0, i) - x * self.grid.centre(1, j);
        }
        [p.sum(), q[0].sum(), q[1].sum(), moment].map(|sum| sum * self.grid.cell_area())
    }

    /// What each resultant is compared with: the normal force; all the friction there can be; its moment.
    fn units(&self) -> [f64; 4] {
        let mut arm = 0.0_f64;
        for ((i, j), &p) in self.fields.p.indexed_iter() {
            if p > 0.0 {
                arm = arm.max(self.grid.centre(0, i).abs()).max(self.grid.centre(1, j).abs());
            }
        }
        let [normal, ..] = self.resultants();
        let friction = self.bound().sum() * self.grid.cell_area();
        [normal, friction, friction, friction * arm]
    }

    fn controls(&self) -> [Control; 4] {
        let LoadStep { normal, tangential: [x, y], twist, .. } = self.load;
        [normal, x, y, twist]
    }

    fn equilibrium(&self) -> f64 {
        let (found, units) = (self.resultants(), self.units());
        let mut worst = 0.0;
        for (mode, control) in self.controls().into_iter().enumerate() {
            match control {
                // Bodies pulled apart carry nothing.
                Control::Force(asked) if mode == 0 && asked <= 0.0 => {
                    worst.raise(over(found[0].abs(), found[0].abs()));
                }
                Control::Force(asked) => worst.raise(over(found[mode] - asked, units[mode])),
                Control::Motion(_) | Control::FarEnd(_) => {}
            }
        }
        let tilted = self.tilt_moments();
        for (axis, control) in self.load.tilt.into_iter().enumerate() {
            if let Control::Force(asked) = control {
                let (found, arm) = tilted[axis];
                worst.raise(over(found - asked, arm));
            }
        }
        worst
    }

    /// First moments of the pressure, and the normal force times the radius of gyration of the pressure.
    fn tilt_moments(&self) -> [(f64, f64); 2] {
        [0, 1].map(|axis| {
            let (mut force, mut first, mut second) = (0.0, 0.0, 0.0);
            for ((i, j), p) in self.fields.p.indexed_iter() {
                let place = self.place([i, j])[axis];
                force += p;
                first += p * place;
                second += p * place * place;
            }
            let radius = if force > 0.0 { (second / force).sqrt() } else { 0.0 };
            let area = self.grid.cell_area();
            (first * area, radius.max(0.5 * self.grid.spacing()[axis]) * force * area)
        })
    }

    fn motion(&self) -> f64 {
        let (now, then) = (self.record, self.before);
        let pairs = [
            (now.approach, then.approach),
            (now.shift[0], then.shift[0]),
            (now.shift[1], then.shift[1]),
            (now.twist, then.twist),
        ];
        let mut worst = 0.0;
        let tilts = [0, 1].map(|axis| (now.tilt[axis], then.tilt[axis]));
        let controls = self.controls().into_iter().chain(self.load.tilt);
        for (control, (found, from)) in controls.zip(pairs.into_iter().chain(tilts)) {
            if let Control::Motion(asked) = control {
                worst.raise(over(found - asked, size(&[asked, from])));
            }
        }
        worst
    }

    fn columns(&self) -> f64 {
        let Fields { p, q, zone, .. } = self.fields;
        let record = self.record;
        let (found, units) = (self.resultants(), self.units());
        let [x, y] = record.tangential_force;
        let mut worst = 0.0;
        for (mode, said) in [record.normal_force, x, y].into_iter().enumerate() {
            worst.raise(over(said - found[mode], units[mode]));
        }
        for (axis, (found, arm)) in self.tilt_moments().into_iter().enumerate() {
            worst.raise(over(record.tilt_moment[axis] - found, arm));
        }
        worst.raise(if record.bulk_stress == self.load.bulk_stress { 0.0 } else { 1.0 });
        let peak = largest(p);
        worst.raise(over(record.max_pressure - peak, peak));
        let shear = q[0].iter().zip(&q[1]).fold(0.0_f64, |most, (x, y)| most.max(x.hypot(*y)));
        worst.raise(over(record.max_shear - shear, shear));
        let count = |wanted: Zone| zone.iter().filter(|&&zone| zone == wanted).count();
        let (stick, slip) = (count(Zone::Stick), count(Zone::Slip));
        let loaded = p.iter().filter(|p| **p > 0.0).count();
        let open = zone.iter().zip(p).all(|(zone, p)| (*zone == Zone::Open) == (*p == 0.0));
        let regime = match (loaded, stick) {
            (0, _) => Regime::Apart,
            _ if self.bound().sum() == 0.0 => Regime::Frictionless,
            (_, 0) => Regime::GrossSlip,
            _ if slip == 0 => Regime::FullStick,
            _ => Regime::PartialSlip,
        };
        let facts = [
            open,
            record.contact_cells == loaded,
            record.stick_cells == stick,
            record.regime == regime,
            (record.contact_area > 0.0) == (loaded > 0),
        ];
        worst.raise(if facts.contains(&false) { 1.0 } else { 0.0 });
        let share = stick as f64 / loaded.max(1) as f64;
        worst.raise(over(record.stick_area - share * record.contact_area, record.contact_area));
        worst
    }
}

/// Nearest point of a disc.
fn project(q: [f64; 2], bound: f64) -> [f64; 2] {
    let length = hypot(q);
    if length <= bound { q } else { q.map(|q| q * (bound / length)) }
}
