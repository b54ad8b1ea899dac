//! The energies of an increment, linearised: what friction dissipates, what is stored, the work put in, what went with worn surfaces, and what
//! remains. The formulas are those of the solver (`solver/state_after.rs`, `solver/energy.rs`).

use super::cell::MOTIONS;
use super::change::{
    Change, DISSIPATED, ENERGIES, EXTERNAL, OF_BULK, OF_CYCLE, OF_WEAR, STORED, Solution, UNRESOLVED,
};
use super::contact::bound_by_friction;
use super::friction_change::FrictionChange;
use super::rule::{PathChange, Rule, combination, product};
use super::scene::Scene;
use super::solved::{Solved, at, deep_by, moved_by};
use crate::fields::{Slopes, length_of};
use crate::model::{CoulombFriction, Zone};
use crate::solver::{FrictionLaw, dissipation, length_of_way, slip_until_open};

/// Friction bound, and its derivatives by pressure, coefficient and strength.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    pub value: f64,
    pub by: [f64; 3],
}

impl Bound {
    /// Of a law, which is also there for the cells of the region, in one of these cells under a pressure.
    pub fn of(
        (law, of_region): (&CoulombFriction, &FrictionLaw),
        (scene, cell): (&Scene<'_>, usize),
        pressure: f64,
    ) -> Self {
        let (value, slope) = of_region.at(cell, pressure);
        let [coefficient, strength] = bound_by_friction((law, scene.region.at(cell)), pressure);
        Self { value, by: [slope, coefficient, strength] }
    }
}

/// What a cell that slips dissipates, by its slip, its shear before and after, and its bounds before and after.
struct Slips {
    place: usize,
    cell: usize,
    /// Share of its drift and of its offset in its slip.
    shares: [f64; 2],
    by: [f64; 8],
    bounds: [Bound; 2],
}

/// What a cell that comes out of contact dissipates, by its drift, its shear and its bound before.
struct Opens {
    cell: usize,
    by: [f64; 5],
    bound: Bound,
}

/// The energies of an increment.
pub(super) struct Energies<'a> {
    scene: &'a Scene<'a>,
    now: &'a Solved,
    before: &'a Solved,
    slips: Vec<Slips>,
    opens: Vec<Opens>,
}

/// What the energies depend on: states before and after, the solution, paths, and friction.
pub(super) struct Inputs<'a> {
    pub before: &'a Change,
    pub next: &'a Change,
    pub solution: &'a Solution,
    pub paths: &'a PathChange,
    pub friction: &'a FrictionChange,
}

/// The same backwards.
pub(super) struct Outputs<'a> {
    pub before: &'a mut Change,
    pub next: &'a mut Change,
    pub solution: &'a mut Solution,
    pub paths: &'a mut PathChange,
    pub friction: &'a mut FrictionChange,
}

impl<'a> Energies<'a> {
    pub fn new(
        scene: &'a Scene<'a>,
        [now, before]: [&'a Solved; 2],
        (law, rule): (&CoulombFriction, &Rule),
    ) -> Self {
        let of_region = FrictionLaw::in_region(law, scene.region);
        let bound = |cell: usize, pressure: f64| Bound::of((law, &of_region), (scene, cell), pressure);
        let mut found = Self { scene, now, before, slips: Vec::new(), opens: Vec::new() };
        for (place, cell) in now.contact.cells().enumerate() {
            let zones = [before.zone_of(cell), now.zone_of(cell)];
            let shares = shares_of_slip(zones, rule.pace.is_some());
            if shares == [0.0; 2] {
                continue;
            }
            let bounds = [bound(cell, before.tractions[0][cell]), bound(cell, now.tractions[0][cell])];
            let (drift, ahead) = (now.drift_since(before, cell), at(&rule.ahead, place));
            let slip = [0, 1].map(|axis| shares[0] * drift[axis] + shares[1] * ahead[axis]);
            let ([before_x, before_y], [after_x, after_y]) = (before.shear_at(cell), now.shear_at(cell));
            let inputs =
                [slip[0], slip[1], before_x, before_y, after_x, after_y, bounds[0].value, bounds[1].value];
            let [x, y, before_x, before_y, after_x, after_y, first, last] = Slopes::<8>::of_each(inputs);
            let shear = [[before_x, before_y], [after_x, after_y]];
            let way = length_of_way(scene.plan.case.integration, [x, y], zones, shear);
            let by = dissipation([first, last], way).by;
            found.slips.push(Slips { place, cell, shares, by, bounds });
        }
        for cell in 0..scene.region.len() {
            let (pressure, shear) = (before.tractions[0][cell], before.shear_at(cell));
            if now.tractions[0][cell] > 0.0 || pressure == 0.0 || shear == [0.0; 2] {
                continue;
            }
            let (bound, drift) = (bound(cell, pressure), now.drift_since(before, cell));
            let inputs = [drift[0], drift[1], shear[0], shear[1], bound.value];
            let [x, y, shear_x, shear_y, held] = Slopes::<5>::of_each(inputs);
            let slip = slip_until_open([x, y], [shear_x, shear_y], held);
            let by = dissipation([held, Slopes { value: 0.0, by: [0.0; 5] }], length_of(slip)).by;
            found.opens.push(Opens { cell, by, bound });
        }
        found
    }

    /// Cells with pressure before or after.
    fn pressed(&self) -> impl Iterator<Item = usize> + '_ {
        let [before, now] = [self.before, self.now].map(|solved| &solved.tractions[0]);
        (0..self.scene.region.len()).filter(|&cell| before[cell] != 0.0 || now[cell] != 0.0)
    }

    /// Mean tractions and drift of a cell, its gap before, under the surfaces of now, and by how much that closes.
    fn means(&self, cell: usize) -> ([f64; 3], [f64; 2], [f64; 2]) {
        let Self { now, before, .. } = self;
        let tractions =
            [0, 1, 2].map(|part| 0.5 * (before.tractions[part][cell] + now.tractions[part][cell]));
        let [_, columns] = now.shape();
        let place = [cell / columns, cell % columns];
        let gap = before.gap[place] + (now.undeformed[place] - before.undeformed[place]);
        (tractions, now.drift_since(before, cell), [gap, gap - now.gap[place]])
    }

    fn motions(&self) -> [f64; MOTIONS] {
        std::array::from_fn(|motion| self.now.motions[motion] - self.before.motions[motion])
    }

    /// By how much more the lower surface is strained in the increment, times the length.
    fn strain(&self) -> [f64; 2] {
        std::array::from_fn(|axis| self.now.strain[axis] - self.before.strain[axis])
    }

    /// Changes of the energies, by their places.
    pub fn forward(&self, of: &Inputs<'_>) -> [f64; ENERGIES] {
        let Inputs { before, next, solution, paths, friction } = of;
        let bound = |bound: &Bound, (cell, pressure): (usize, f64)| {
            let [coefficient, strength] = friction.at(cell);
            bound.by[0] * pressure + bound.by[1] * coefficient + bound.by[2] * strength
        };
        let drift = |cell: usize| [0, 1].map(|axis| next.slid[axis][cell] - before.slid[axis][cell]);
        let mut dissipated = 0.0;
        for slips in &self.slips {
            let Slips { place, cell, shares, by, bounds } = slips;
            let (drift, ahead) = (drift(*cell), at(&paths.ahead, *place));
            let [x, y] = [0, 1].map(|axis| shares[0] * drift[axis] + shares[1] * ahead[axis]);
            let ([before_x, before_y], [after_x, after_y]) =
                (at(&before.shear, *cell), at(&next.shear, *cell));
            let first = bound(&bounds[0], (*cell, before.pressure[*cell]));
            let last = bound(&bounds[1], (*cell, next.pressure[*cell]));
            dissipated += product(by, &[x, y, before_x, before_y, after_x, after_y, first, last]);
        }
        for Opens { cell, by, bound: of_cell } in &self.opens {
            let ([x, y], [shear_x, shear_y]) = (drift(*cell), at(&before.shear, *cell));
            let held = bound(of_cell, (*cell, before.pressure[*cell]));
            dissipated += product(by, &[x, y, shear_x, shear_y, held]);
        }
        let mut stored = 0.0;
        for cell in self.now.contact.cells() {
            for part in 0..3 {
                stored += solution.tractions[part][cell] * self.now.displacements[part][cell]
                    + self.now.tractions[part][cell] * solution.displacements[part][cell];
            }
        }
        let motions = self.motions();
        let change: [f64; MOTIONS] =
            std::array::from_fn(|motion| next.motions[motion] - before.motions[motion]);
        let (strain, by_strain) = (self.strain(), [0, 1].map(|axis| next.strain[axis] - before.strain[axis]));
        let [mut work, mut slipped, mut worn, mut by_bulk] = [0.0; 4];
        for cell in self.pressed() {
            let (tractions, slip, [gap, opened]) = self.means(cell);
            let place = self.scene.place(cell);
            let pressure = 0.5 * (before.pressure[cell] + next.pressure[cell]);
            if self.before.opens {
                worn += before.pressure[cell] * gap + self.before.tractions[0][cell] * before.gap[cell];
            }
            let shear = [0, 1].map(|axis| 0.5 * (before.shear[axis][cell] + next.shear[axis][cell]));
            let (moved, by_change) = (moved_by(&motions, place), moved_by(&change, place));
            let drift = drift(cell);
            work += pressure * deep_by(&motions, place) + tractions[0] * deep_by(&change, place);
            slipped += pressure * opened + tractions[0] * (before.gap[cell] - next.gap[cell]);
            for axis in 0..2 {
                work += shear[axis] * moved[axis] + tractions[1 + axis] * by_change[axis];
                slipped += shear[axis] * slip[axis] + tractions[1 + axis] * drift[axis];
                by_bulk -= place[axis] * (shear[axis] * strain[axis] + tractions[1 + axis] * by_strain[axis]);
            }
        }
        let mut changes = [0.0; ENERGIES];
        let unresolved = slipped - dissipated - worn;
        changes[DISSIPATED] = dissipated;
        changes[EXTERNAL] = work + by_bulk;
        changes[UNRESOLVED] = unresolved;
        changes[OF_WEAR] = worn;
        changes[OF_BULK] = by_bulk;
        for (place, change) in OF_CYCLE.into_iter().zip([dissipated, unresolved, by_bulk]) {
            changes[place] = change;
        }
        let area = self.scene.area();
        let mut energies = std::array::from_fn(|energy| before.energies[energy] + changes[energy] * area);
        energies[STORED] = stored * 0.5 * area;
        energies
    }

    /// Backwards, from those of the energies.
    pub fn transposed(&self, of: [f64; ENERGIES], to: &mut Outputs<'_>) {
        let Outputs { before, next, solution, paths, friction } = to;
        let area = self.scene.area();
        for energy in (0..ENERGIES).filter(|energy| *energy != STORED) {
            before.energies[energy] += of[energy];
        }
        let of = of.map(|energy| energy * area);
        let [dissipated, unresolved, by_bulk] = OF_CYCLE.map(|place| of[place]);
        let (work, unresolved) = (of[EXTERNAL], of[UNRESOLVED] + unresolved);
        let dissipated = of[DISSIPATED] + dissipated - unresolved;
        let by_bulk = of[OF_BULK] + by_bulk + work;
        let worn = if self.before.opens { of[OF_WEAR] - unresolved } else { 0.0 };
        let stored = 0.5 * of[STORED];
        let mut by_bound = |bound: &Bound, amount: f64, (cell, pressure): (usize, &mut [f64])| {
            pressure[cell] += bound.by[0] * amount;
            friction.add(cell, [bound.by[1] * amount, bound.by[2] * amount]);
        };
        for slips in &self.slips {
            let Slips { place, cell, shares, by, bounds } = slips;
            let [x, y, before_x, before_y, after_x, after_y, first, last] =
                combination(&[*by], &[dissipated]);
            for (axis, slip) in [x, y].into_iter().enumerate() {
                next.slid[axis][*cell] += shares[0] * slip;
                before.slid[axis][*cell] -= shares[0] * slip;
                paths.ahead[axis][*place] += shares[1] * slip;
            }
            for (axis, (first, last)) in [(before_x, after_x), (before_y, after_y)].into_iter().enumerate() {
                before.shear[axis][*cell] += first;
                next.shear[axis][*cell] += last;
            }
            by_bound(&bounds[0], first, (*cell, &mut before.pressure));
            by_bound(&bounds[1], last, (*cell, &mut next.pressure));
        }
        for Opens { cell, by, bound } in &self.opens {
            let [x, y, shear_x, shear_y, held] = combination(&[*by], &[dissipated]);
            for (axis, (drift, shear)) in [(x, shear_x), (y, shear_y)].into_iter().enumerate() {
                next.slid[axis][*cell] += drift;
                before.slid[axis][*cell] -= drift;
                before.shear[axis][*cell] += shear;
            }
            by_bound(bound, held, (*cell, &mut before.pressure));
        }
        if stored != 0.0 {
            for cell in self.now.contact.cells() {
                for part in 0..3 {
                    solution.tractions[part][cell] += stored * self.now.displacements[part][cell];
                    solution.displacements[part][cell] += stored * self.now.tractions[part][cell];
                }
            }
        }
        if [work, unresolved, worn, by_bulk] == [0.0; 4] {
            return;
        }
        let (motions, strain) = (self.motions(), self.strain());
        let mut change = [0.0; MOTIONS];
        for cell in self.pressed() {
            let (tractions, slip, [gap, opened]) = self.means(cell);
            let place = self.scene.place(cell);
            let moved = moved_by(&motions, place);
            let pressure = 0.5 * (work * deep_by(&motions, place) + unresolved * opened);
            before.pressure[cell] += pressure + worn * gap;
            next.pressure[cell] += pressure;
            before.gap[cell] += unresolved * tractions[0] + worn * self.before.tractions[0][cell];
            next.gap[cell] -= unresolved * tractions[0];
            for axis in 0..2 {
                let stretched = by_bulk * place[axis];
                let shear = 0.5 * (work * moved[axis] + unresolved * slip[axis] - stretched * strain[axis]);
                before.shear[axis][cell] += shear;
                next.shear[axis][cell] += shear;
                let drift = unresolved * tractions[1 + axis];
                next.slid[axis][cell] += drift;
                before.slid[axis][cell] -= drift;
                next.strain[axis] -= stretched * tractions[1 + axis];
                before.strain[axis] += stretched * tractions[1 + axis];
            }
            let [x, y] = place;
            let [normal, along_x, along_y] = tractions.map(|part| work * part);
            let modes = [normal, normal * x, normal * y, along_x, along_y, along_y * x - along_x * y];
            for (change, mode) in change.iter_mut().zip(modes) {
                *change += mode;
            }
        }
        for motion in 0..MOTIONS {
            next.motions[motion] += change[motion];
            before.motions[motion] -= change[motion];
        }
    }
}

/// Shares of the drift and of the offset in what counts as slip of a cell in contact.
pub(super) fn shares_of_slip([was, is]: [Zone; 2], has_paths: bool) -> [f64; 2] {
    let drift = f64::from(u8::from(is == Zone::Slip));
    let offset = match was {
        Zone::Open if has_paths => -drift,
        Zone::Slip if has_paths => 1.0 - drift,
        _ => 0.0,
    };
    [drift, offset]
}
