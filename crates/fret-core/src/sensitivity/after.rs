//! From the solution of an increment's linear equations to all that it leaves behind, and back.

use super::block::Block;
use super::case_number::OF_WEAR;
use super::cell::MOTIONS;
use super::cell_rows::sums_with;
use super::change::{Change, ENERGIES, Solution, add};
use super::collected::Collected;
use super::contact::Drive;
use super::energies::{Energies, Inputs, Outputs};
use super::rule::{PathChange, Rule, combination, product};
use super::scene::{MOTION_OF, Scene};
use super::slip::Slip;
use super::solved::{Solved, at, deep_by, moved_by};
use crate::fields::{Slopes, add_scaled, dot};
use crate::model::{CoulombFriction, Zone};
use crate::solver::{ContactSet, rate_since_touch};

/// A cell that has come into contact: what the rule of slip takes for its drift, by drift, offset and moment of touch.
struct Entered {
    place: usize,
    cell: usize,
    by: [[f64; 5]; 2],
}

/// What an increment leaves behind, linearised.
pub(super) struct After<'a> {
    scene: &'a Scene<'a>,
    contact: &'a ContactSet,
    /// Forces of the whole contact [force].
    forces: [f64; 6],
    entered: Vec<Entered>,
    energies: Energies<'a>,
    slip: Option<Slip>,
    wear: Option<Collected>,
    /// The distance that is slipped, where debris flows out by it.
    path: Option<Collected>,
    /// What friction follows, where it evolves.
    driver: Option<Collected>,
    goes_on: bool,
    /// The block of cycles that ends with it.
    block: Option<Block>,
}

impl<'a> After<'a> {
    pub fn new(
        scene: &'a Scene<'a>,
        [now, before]: [&'a Solved; 2],
        (law, rule): (&CoulombFriction, &Rule),
    ) -> Self {
        let mut entered = Vec::new();
        let goes_on = rule.pace.is_some();
        let enters = |cell: &usize| goes_on && before.zone_of(*cell) == Zone::Open;
        for (place, cell) in now.contact.cells().enumerate().filter(|(_, cell)| enters(cell)) {
            let (drift, ahead) = (now.drift_since(before, cell), at(&rule.ahead, place));
            let inputs = [drift[0], drift[1], ahead[0], ahead[1], rule.touch[place]];
            let [x, y, ahead_x, ahead_y, touch] = Slopes::<5>::of_each(inputs);
            let by = rate_since_touch([x, y], [ahead_x, ahead_y], touch).map(|part| part.by);
            entered.push(Entered { place, cell, by });
        }
        let [pressure, x, y] = &now.tractions;
        let forces = scene.resultants([pressure, x, y]);
        let energies = Energies::new(scene, [now, before], (law, rule));
        let (states, friction) = ([now, before], (law, rule));
        let wear = scene.plan.case.wear.as_ref();
        let wear = wear.map(|of| Collected::of_wear(of, scene, states, friction));
        let path = scene.has_debris().then(|| Collected::of_path(scene, states, friction));
        let evolution = scene.plan.case.friction_evolution.as_ref();
        let driver = evolution.and_then(|of| Collected::of_evolution(of, scene, states, friction));
        let slip = scene.tells_slip.then(|| Slip::new(scene, [now, before], (law, rule)));
        let contact = &now.contact;
        let block = (now.block > 0).then(|| Block::new(scene, [before, now], now.block));
        Self { scene, contact, forces, entered, energies, slip, wear, path, driver, goes_on, block }
    }

    /// Completes the changes of `next`, of which the loads are known.
    pub fn forward(
        &self,
        (solution, paths, drive): (&Solution, &PathChange, &Drive),
        before: &Change,
        next: &mut Change,
    ) {
        let Self { scene, .. } = self;
        let [pressure, x, y] = &solution.tractions;
        next.pressure.clone_from(pressure);
        next.shear = [x.clone(), y.clone()];
        next.motions = solution.motions;
        let [normal, along_x, along_y] = &solution.displacements;
        for cell in 0..scene.region.len() {
            let place = scene.place(cell);
            next.gap[cell] =
                drive.gap[cell] + before.opened(cell) + normal[cell] - deep_by(&solution.motions, place);
            if scene.is_frictional() {
                let [x, y] = moved_by(&solution.motions, place);
                next.slid[0][cell] = x - along_x[cell] - next.strain[0] * place[0];
                next.slid[1][cell] = y - along_y[cell] - next.strain[1] * place[1];
                for axis in 0..2 {
                    next.drift[axis][cell] = next.slid[axis][cell] - before.slid[axis][cell];
                }
            }
        }
        // What the equations ask for: they leave a little of it.
        self.contact.cells().for_each(|cell| next.gap[cell] = 0.0);
        let friction = &drive.friction;
        next.energies = self.energies.forward(&Inputs { before, next, solution, paths, friction });
        if let Some(slip) = &self.slip {
            next.slip = slip.forward(&Inputs { before, next, solution, paths, friction });
        }
        if let Some(wear) = &self.wear {
            let mut collected = before.collected.clone();
            wear.forward(&Inputs { before, next, solution, paths, friction }, drive.wear, &mut collected);
            next.collected = collected;
            next.worn.clone_from(&before.worn);
        }
        if let Some(slipped) = &self.path {
            let mut path = before.path.clone();
            slipped.forward(&Inputs { before, next, solution, paths, friction }, [0.0; OF_WEAR], &mut path);
            next.path = path;
            next.debris.clone_from(&before.debris);
        }
        if scene.evolves() {
            let mut slipping = before.slipping.clone();
            if let Some(driver) = &self.driver {
                let inputs = Inputs { before, next, solution, paths, friction };
                driver.forward(&inputs, [0.0; OF_WEAR], &mut slipping);
            }
            next.slipping = slipping;
            next.slipped.clone_from(&before.slipped);
        }
        if let Some(block) = &self.block {
            block.forward(next, &drive.wear, &drive.layers);
        }
        let forces = scene.resultants([pressure, x, y]);
        next.reached = scene.reached(forces, &solution.motions, scene.springs());
        for (freedom, by) in drive.rig.into_iter().enumerate() {
            next.reached[freedom][2] += by * self.forces[freedom];
        }
        for Entered { place, cell, by } in &self.entered {
            let (drift, ahead) = (at(&next.drift, *cell), at(&paths.ahead, *place));
            let inputs = [drift[0], drift[1], ahead[0], ahead[1], paths.touch[*place]];
            for axis in 0..2 {
                next.drift[axis][*cell] = product(&by[axis], &inputs);
            }
        }
        next.ratio = if self.goes_on { paths.loads } else { 0.0 };
    }

    /// Backwards: from those of `next`, of which the loads are left, to those of the solution.
    pub fn transposed(
        &self,
        next: &mut Change,
        before: &mut Change,
        (paths, drive): (&mut PathChange, &mut Drive),
    ) -> Solution {
        let Self { scene, .. } = self;
        let cells = scene.region.len();
        if self.goes_on {
            paths.loads += next.ratio;
        }
        for Entered { place, cell, by } in &self.entered {
            let found = combination(by, &at(&next.drift, *cell));
            let [x, y, ahead_x, ahead_y, touch] = found;
            (next.drift[0][*cell], next.drift[1][*cell]) = (x, y);
            add(&mut paths.ahead, *place, [ahead_x, ahead_y]);
            paths.touch[*place] += touch;
        }
        let mut forces = [0.0; 6];
        let (units, springs) = (scene.units(), scene.springs());
        for freedom in 0..6 {
            let [force, motion, far_end] = next.reached[freedom];
            let spring = springs.get(freedom).copied().unwrap_or(0.0);
            forces[freedom] = force + spring * far_end;
            next.motions[MOTION_OF[freedom]] += (motion + far_end) / units[freedom];
            if let Some(rig) = drive.rig.get_mut(freedom) {
                *rig += far_end * self.forces[freedom];
            }
        }
        let mut solution = Solution {
            tractions: super::fields::zeros(cells),
            displacements: super::fields::zeros(cells),
            motions: [0.0; MOTIONS],
        };
        if let Some(block) = &self.block {
            block.transposed(next, &mut drive.wear, &mut drive.layers);
        }
        if let Some(wear) = &self.wear {
            add_scaled(&mut before.worn, 1.0, &next.worn);
            let collected = std::mem::take(&mut next.collected);
            add_scaled(&mut before.collected, 1.0, &collected);
            let Drive { friction, wear: numbers, .. } = drive;
            let mut to = Outputs { before, next, solution: &mut solution, paths, friction };
            wear.transposed(&collected, &mut to, numbers);
        }
        if let Some(slipped) = &self.path {
            add_scaled(&mut before.debris, 1.0, &next.debris);
            let path = std::mem::take(&mut next.path);
            add_scaled(&mut before.path, 1.0, &path);
            let Drive { friction, .. } = drive;
            let mut to = Outputs { before, next, solution: &mut solution, paths, friction };
            slipped.transposed(&path, &mut to, &mut [0.0; OF_WEAR]);
        }
        if scene.evolves() {
            add_scaled(&mut before.slipped, 1.0, &next.slipped);
            let slipping = std::mem::take(&mut next.slipping);
            add_scaled(&mut before.slipping, 1.0, &slipping);
            if let Some(driver) = &self.driver {
                let Drive { friction, .. } = drive;
                let mut to = Outputs { before, next, solution: &mut solution, paths, friction };
                driver.transposed(&slipping, &mut to, &mut [0.0; OF_WEAR]);
            }
        }
        if let Some(slip) = &self.slip {
            let of = std::mem::take(&mut next.slip);
            let Drive { friction, .. } = drive;
            slip.transposed(&of, &mut Outputs { before, next, solution: &mut solution, paths, friction });
        }
        if next.energies != [0.0; ENERGIES] {
            let energies = next.energies;
            let Drive { friction, .. } = drive;
            let mut to = Outputs { before, next, solution: &mut solution, paths, friction };
            self.energies.transposed(energies, &mut to);
        }
        self.contact.cells().for_each(|cell| next.gap[cell] = 0.0);
        add_scaled(&mut drive.gap, 1.0, &next.gap);
        for (cell, of) in next.gap.iter().enumerate() {
            before.add_opened(cell, *of);
        }
        add_scaled(&mut solution.displacements[0], 1.0, &next.gap);
        let mut signs = [-1.0, -1.0, -1.0, 0.0, 0.0, 0.0];
        if scene.is_frictional() {
            signs[3..].fill(1.0);
            for axis in 0..2 {
                add_scaled(&mut before.slid[axis], -1.0, &next.drift[axis]);
                add_scaled(&mut next.slid[axis], 1.0, &next.drift[axis]);
                add_scaled(&mut solution.displacements[1 + axis], -1.0, &next.slid[axis]);
                next.strain[axis] -= dot(&scene.places[axis], &next.slid[axis]);
            }
        }
        let sums = sums_with(&scene.places, [&next.gap, &next.slid[0], &next.slid[1]]);
        for ((motion, sum), sign) in next.motions.iter_mut().zip(sums).zip(signs) {
            *motion += sign * sum;
        }
        if forces != [0.0; 6] {
            scene.add_resultants(forces, &mut solution.tractions);
        }
        solution.motions = next.motions;
        add_scaled(&mut solution.tractions[0], 1.0, &next.pressure);
        for axis in 0..2 {
            add_scaled(&mut solution.tractions[1 + axis], 1.0, &next.shear[axis]);
        }
        solution
    }
}
