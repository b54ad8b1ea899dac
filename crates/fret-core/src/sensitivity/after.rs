//! From the solution of an increment's linear equations to all that it leaves behind, in dual numbers: what cells slipped, what friction
//! dissipated, what is remembered. The formulas are those of the solver (`solver/state_after.rs`, `solver/energy.rs`, `solver/increment.rs`).

use super::cell::MOTIONS;
use super::linearised::Fields;
use super::loads::{Load, Reached};
use super::scene::{Scene, Solved};
use super::track::{Before, Drive, DualField, Known, Last, Track, at, bound_under, index, moved_by};
use crate::fields::{Dual, Scalar, length_of};
use crate::model::Zone;
use crate::solver::{dissipation, length_of_way, rate_since_touch, slip_until_open};

/// Changes that solve the linear equations of an increment, in the region.
pub(super) struct Changes {
    pub tractions: Fields,
    pub displacements: Fields,
    pub motions: [f64; MOTIONS],
}

/// Sums over the cells of an increment.
struct Sums {
    /// Dissipated by friction, stored; work of the motions; of the drift under the shear, of the gap under the pressure.
    dissipated: Dual,
    stored: Dual,
    work: Dual,
    slipped: Dual,
    opened: Dual,
}

fn dual_field(values: &[f64], changes: &[f64]) -> Vec<Dual> {
    values.iter().zip(changes).map(|(value, change)| Dual::new(*value, *change)).collect()
}

impl Track {
    /// Goes on to the end of an increment.
    pub fn finish(
        &mut self,
        (scene, solved): (&Scene<'_>, &Solved<'_>),
        (drive, known): (&Drive, Known),
        changes: &Changes,
    ) {
        let part = |values: &Fields, changes: &Fields, part: usize| dual_field(&values[part], &changes[part]);
        let pressure = part(&solved.tractions, &changes.tractions, 0);
        let shear = [1, 2].map(|axis| part(&solved.tractions, &changes.tractions, axis));
        let displacement = [0, 1, 2].map(|axis| part(&solved.displacements, &changes.displacements, axis));
        let motions: [Dual; MOTIONS] =
            std::array::from_fn(|motion| Dual::new(solved.motions[motion], changes.motions[motion]));
        let gap = scene.undeformed.indexed_iter().map(|((i, j), undeformed)| {
            let cell = i * scene.region.shape[1] + j;
            let [x, y] = scene.places[cell];
            let deep = motions[0] + motions[1] * x + motions[2] * y;
            Dual::new(*undeformed, drive.gap[[i, j]]) + displacement[0][cell] - deep
        });
        let gap = gap.collect::<Vec<_>>();
        let gap =
            ndarray::Array2::from_shape_vec(scene.region.shape, gap).unwrap_or_else(|_| self.gap.clone());
        let mut after =
            Self { pressure, shear, displacement, gap, zone: solved.zone.clone(), motions, ..self.clone() };
        let mut drift = self.drift(&after, scene);
        let sums = self.sums(&after, (scene, solved), (drive, &known, &drift));
        let area = scene.area();
        after.energies = [
            self.energies[0] + sums.dissipated * area,
            sums.stored * (0.5 * area),
            self.energies[2] + sums.work * area,
            self.energies[3] + (sums.slipped + sums.opened - sums.dissipated) * area,
        ];
        after.reached = after.reached_by((scene, drive));
        for cell in solved.contact.cells() {
            if let (Zone::Open, Some(paths)) = (self.zone[index(scene, cell)], &known.paths) {
                let rate = rate_since_touch(at(&drift, cell), at(&paths.ahead, cell), paths.touch[cell]);
                [drift[0][cell], drift[1][cell]] = rate;
            }
        }
        self.remember(&mut after, (drive.load, known), drift);
        *self = after;
    }

    /// Change of the tangential displacement of the upper body over the lower in every cell [length].
    fn drift(&self, after: &Self, scene: &Scene<'_>) -> DualField {
        let moved = std::array::from_fn(|motion| after.motions[motion] - self.motions[motion]);
        let cells = 0..scene.region.len();
        let drift = |cell: usize| {
            let by_motions = moved_by(&moved, scene.places[cell]);
            [0, 1].map(|axis| {
                self.displacement[1 + axis][cell] - after.displacement[1 + axis][cell] + by_motions[axis]
            })
        };
        if !scene.is_frictional() {
            return [(); 2].map(|()| vec![Dual::of(0.0); scene.region.len()]);
        }
        let [mut x, mut y] = [(); 2].map(|()| Vec::with_capacity(scene.region.len()));
        for [along_x, along_y] in cells.map(drift) {
            x.push(along_x);
            y.push(along_y);
        }
        [x, y]
    }

    fn sums(
        &self,
        after: &Self,
        (scene, solved): (&Scene<'_>, &Solved<'_>),
        (drive, known, drift): (&Drive, &Known, &DualField),
    ) -> Sums {
        let zero = Dual::of(0.0);
        let mut sums = Sums { dissipated: zero, stored: zero, work: zero, slipped: zero, opened: zero };
        let bound = |cell: usize, pressure: Dual| {
            bound_under((&solved.law, scene.region.at(cell)), pressure, drive.friction)
        };
        let integration = scene.plan.case.integration;
        for cell in solved.contact.cells() {
            let at_cell = index(scene, cell);
            let [before, now] = [self.zone[at_cell], solved.zone[at_cell]];
            let slip = self.counted(cell, known, (after, scene, drift));
            let shear = [at(&self.shear, cell), at(&after.shear, cell)];
            let way = length_of_way(integration, slip, [before, now], shear);
            let bounds = [bound(cell, self.pressure[cell]), bound(cell, after.pressure[cell])];
            sums.dissipated = sums.dissipated + dissipation(bounds, way);
            let [x, y] = shear[1];
            let moved = after.displacement.each_ref().map(|part| part[cell]);
            sums.stored = sums.stored + after.pressure[cell] * moved[0] + x * moved[1] + y * moved[2];
        }
        let motions: [Dual; MOTIONS] =
            std::array::from_fn(|motion| after.motions[motion] - self.motions[motion]);
        for cell in 0..scene.region.len() {
            let (was, is) = (self.pressure[cell], after.pressure[cell]);
            if was.value == 0.0 && is.value == 0.0 {
                continue;
            }
            let shear = at(&self.shear, cell);
            if is.value <= 0.0 && shear.iter().any(|part| part.value != 0.0) {
                let bound = bound(cell, was);
                let slip = slip_until_open(at(drift, cell), shear, bound);
                sums.dissipated = sums.dissipated + dissipation([bound, zero], length_of(slip));
            }
            let pressure = (was + is) * 0.5;
            let mean = [0, 1].map(|axis| (self.shear[axis][cell] + after.shear[axis][cell]) * 0.5);
            let [x, y] = scene.places[cell];
            let deep = motions[0] + motions[1] * x + motions[2] * y;
            let [to_x, to_y] = moved_by(&motions, [x, y]);
            sums.work = sums.work + pressure * deep + mean[0] * to_x + mean[1] * to_y;
            sums.slipped = sums.slipped + mean[0] * drift[0][cell] + mean[1] * drift[1][cell];
            let gaps = [&self.gap, &after.gap].map(|gap| gap[index(scene, cell)]);
            sums.opened = sums.opened + pressure * (gaps[0] - gaps[1]);
        }
        sums
    }

    /// Slip increment of a cell in contact: what counts as slip of its drift.
    fn counted(
        &self,
        cell: usize,
        known: &Known,
        (after, scene, drift): (&Self, &Scene<'_>, &DualField),
    ) -> [Dual; 2] {
        let none = [Dual::of(0.0); 2];
        let (was, is) = (self.zone[index(scene, cell)], after.zone[index(scene, cell)]);
        let drift = at(drift, cell);
        let Some(paths) = &known.paths else { return if is == Zone::Slip { drift } else { none } };
        let ahead = at(&paths.ahead, cell);
        let chord = if is == Zone::Slip { [0, 1].map(|axis| drift[axis] - ahead[axis]) } else { none };
        if was == Zone::Open { chord } else { [0, 1].map(|axis| chord[axis] + ahead[axis]) }
    }

    /// Where each degree of freedom is, of the whole contact.
    fn reached_by(&self, (scene, drive): (&Scene<'_>, &Drive)) -> [Reached; 6] {
        let area = Dual::of(scene.area());
        let sum = |of: &dyn Fn(usize) -> Dual| {
            (0..scene.region.len()).fold(Dual::of(0.0), |sum, cell| sum + of(cell)) * area
        };
        let [x, y] = [0, 1].map(|axis| sum(&|cell| self.shear[axis][cell]));
        let normal = sum(&|cell| self.pressure[cell]);
        let moment = sum(&|cell| {
            let [along, across] = scene.places[cell];
            (self.shear[1][cell] * along - self.shear[0][cell] * across) * scene.length
        });
        let tilts =
            [0, 1].map(|axis| sum(&|cell| self.pressure[cell] * (scene.places[cell][axis] * scene.length)));
        let symmetry = scene.plan.symmetry;
        let mirrored = symmetry.axes();
        let none = Dual::of(0.0);
        // A force that the symmetry forbids is none.
        let allowed =
            |axis: usize, force: Dual| if symmetry.shear_is_odd(axis) == [false; 2] { force } else { none };
        let copies = symmetry.copies() as f64;
        let rig = scene.plan.case.springs();
        // What is known of the machine is that of the part.
        let springs = [
            (rig.normal, drive.rig[0]),
            (rig.tangential[0], drive.rig[1]),
            (rig.tangential[1], drive.rig[2]),
        ];
        let springs = springs.map(|(compliance, change)| Dual::new(compliance, change / copies));
        let reached = |force: Dual, motion: Dual, spring: Dual| Reached {
            force,
            motion,
            far_end: motion + spring * force,
        };
        let [approach, tilt_x, tilt_y, shift_x, shift_y, twist] = self.motions;
        let [tilt_x, tilt_y, twist] = [tilt_x, tilt_y, twist].map(|motion| motion / scene.length);
        let tilts = [0, 1].map(|axis| if mirrored[axis] { none } else { tilts[axis] });
        [
            reached(normal, approach, springs[0]),
            reached(allowed(0, x), shift_x, springs[1]),
            reached(allowed(1, y), shift_y, springs[2]),
            reached(if symmetry.any() { none } else { moment }, twist, none),
            reached(tilts[0], tilt_x, none),
            reached(tilts[1], tilt_y, none),
        ]
    }

    /// What the next increment knows of this one.
    fn remember(&self, after: &mut Self, (load, known): (Load, Known), drift: DualField) {
        let Known { pace, last_load, .. } = known;
        let goes_on = self.last.as_ref().filter(|_| pace.is_some());
        after.before = last_load.map(|load| Before {
            load,
            pressure: self.pressure.iter().map(|pressure| pressure.value).collect(),
            gap: goes_on.map(|_| self.gap.clone()),
            drift: goes_on.map(|last| last.drift.clone()),
        });
        let gap_was_known = self.before.as_ref().is_some_and(|before| before.gap.is_some());
        after.last = Some(Last {
            drift,
            ratio: pace.map_or(Dual::of(1.0), |(loads, _)| loads),
            knows_touch: gap_was_known && pace.is_some_and(|(_, knows_edge)| knows_edge),
        });
        after.last_load = Some(load);
    }
}
