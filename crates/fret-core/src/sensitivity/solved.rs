//! The increments of a history as they were solved, in its region, with what the rule of slip remembers of them: numbers alone.

use std::borrow::Cow;

use ndarray::Array2;

use super::cell::MOTIONS;
use super::change::{Reached, Tangential};
use super::linearised::{Fields, Operators, displacements, zeros};
use super::loads::{Load, Prescribed};
use super::rule::{Cells, Rule};
use super::scene::{Scene, Snapshot};
use crate::model::{ContactState, CoulombFriction, LoadStep, Zone};
use crate::plan::Plan;
use crate::solver::{ContactSet, rate_since_touch};

/// A cell's two numbers.
pub(super) fn at(field: &Tangential, cell: usize) -> [f64; 2] {
    [field[0][cell], field[1][cell]]
}

/// Tangential displacement by motions at a place.
pub(super) fn moved_by(motions: &[f64; MOTIONS], [x, y]: [f64; 2]) -> [f64; 2] {
    let [_, _, _, shift_x, shift_y, turned] = *motions;
    [shift_x - turned * y, shift_y + turned * x]
}

/// How deep motions bring a place.
pub(super) fn deep_by(motions: &[f64; MOTIONS], [x, y]: [f64; 2]) -> f64 {
    motions[0] + motions[1] * x + motions[2] * y
}

/// One increment in the region.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    pub tractions: Fields,
    pub displacements: Fields,
    pub gap: Array2<f64>,
    pub zone: Array2<Zone>,
    /// Rotations times the length [length].
    pub motions: [f64; MOTIONS],
    pub contact: ContactSet,
    /// Tangential displacement of the upper surface over the lower [length], and what the rule of slip takes for its change.
    pub slid: Tangential,
    pub drift: Tangential,
    /// Load at its start and at its end, of the part in front of the mirrors, in controls of the same kinds; `None` before the first one.
    pub from: Option<LoadStep>,
    pub load: Option<LoadStep>,
    /// Length over that of the increment before in the loads, where it went on from that.
    pace: Option<f64>,
    /// Whether the moments of touch in it were known.
    pub knows_touch: bool,
}

impl Solved {
    /// Bodies that have not touched yet.
    fn untouched(scene: &Scene<'_>) -> Self {
        let cells = scene.region.len();
        let tangential = || [vec![0.0; cells], vec![0.0; cells]];
        Self {
            tractions: zeros(cells),
            displacements: zeros(cells),
            gap: scene.undeformed.clone(),
            zone: Array2::from_elem(scene.region.shape, Zone::Open),
            motions: [0.0; MOTIONS],
            contact: ContactSet::of(cells, |_| false),
            slid: tangential(),
            drift: tangential(),
            from: None,
            load: None,
            pace: None,
            knows_touch: false,
        }
    }

    /// Rows and columns of the region.
    pub fn shape(&self) -> [usize; 2] {
        self.zone.dim().into()
    }

    /// What a cell did.
    pub fn zone_of(&self, cell: usize) -> Zone {
        let [_, columns] = self.shape();
        self.zone[[cell / columns, cell % columns]]
    }

    /// Shear of a cell [pressure].
    pub fn shear_at(&self, cell: usize) -> [f64; 2] {
        [self.tractions[1][cell], self.tractions[2][cell]]
    }

    /// Shear along x and y [pressure].
    pub fn shear(&self) -> [&[f64]; 2] {
        [&self.tractions[1], &self.tractions[2]]
    }

    /// Whether it went on from the one before.
    pub fn went_on(&self) -> bool {
        self.pace.is_some()
    }

    /// Its length over that of the one before, in the loads.
    pub fn ratio(&self) -> f64 {
        self.pace.unwrap_or(1.0)
    }

    /// Whether a load is the one that it ended with.
    pub fn stands(&self, load: &Load) -> bool {
        self.load.as_ref() == Some(&load.step)
    }

    /// Change of the tangential displacement of the upper surface over the lower in a cell since another increment [length].
    pub fn drift_since(&self, before: &Self, cell: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.slid[axis][cell] - before.slid[axis][cell])
    }

    /// Where each degree of freedom is.
    pub fn reached(&self, scene: &Scene<'_>) -> Reached {
        let [pressure, x, y] = &self.tractions;
        let forces = scene.resultants([pressure, x, y]);
        scene.reached(forces, &self.motions, scene.springs())
    }
}

/// Goes through a history again, increment by increment.
pub(super) struct Replay<'a> {
    scene: &'a Scene<'a>,
    prescribed: Prescribed<'a>,
    untouched: ContactState,
    pub start: Solved,
}

/// What comes after the last increments: what it prescribes, and what was solved; `None` where no load changes.
pub(super) struct Next {
    pub load: Load,
    pub solved: Option<Solved>,
}

impl<'a> Replay<'a> {
    pub fn new(scene: &'a Scene<'a>) -> Self {
        let untouched = ContactState::untouched(scene.grid.cells());
        Self { scene, prescribed: Prescribed::new(scene), untouched, start: Solved::untouched(scene) }
    }

    /// The next increment, after `before`, which came from `former`, both `None` where there is none but the start; `state`: the one before.
    pub fn next(
        &mut self,
        (snapshot, state): (&Snapshot, Option<&ContactState>),
        past: [Option<&Solved>; 2],
        operators: &mut Operators,
    ) -> Next {
        let scene = self.scene;
        let [before, former] = past.map(|solved| solved.unwrap_or(&self.start));
        let state = state.unwrap_or(&self.untouched);
        let reached = before.reached(scene);
        let load = self.prescribed.next(snapshot.record.stage, (state, &reached), before.load.as_ref());
        let solved = (!before.stands(&load))
            .then(|| Solved::new(scene, snapshot, (&load, [before, former]), operators));
        Next { load, solved }
    }
}

impl Solved {
    fn new(
        scene: &Scene<'_>,
        snapshot: &Snapshot,
        (load, [before, former]): (&Load, [&Self; 2]),
        operators: &mut Operators,
    ) -> Self {
        let Snapshot { record, state } = snapshot;
        let region = scene.region;
        let tractions = [&state.pressure, &state.shear[0], &state.shear[1]].map(|field| region.gather(field));
        let moved = if tractions[0].iter().any(|p| *p > 0.0) {
            displacements(&mut operators.compliance, operators.frictional, &tractions)
        } else {
            zeros(region.len())
        };
        let motions = scene.motions(state);
        let contact = ContactSet::loaded(&tractions[0]);
        let end_point = record.work.end_point_increments > 0;
        let rule = Rule::new(scene, (load, end_point), [before, former], (&contact, &[]), Cells::Entered);
        let mut solved = Self {
            gap: scene.undeformed.clone(),
            zone: zones(scene, state),
            motions,
            contact,
            slid: [vec![0.0; region.len()], vec![0.0; region.len()]],
            drift: [vec![0.0; region.len()], vec![0.0; region.len()]],
            from: load.from,
            load: Some(load.step),
            pace: rule.pace.map(|pace| pace.loads),
            knows_touch: before.went_on() && rule.pace.is_some_and(|pace| pace.edge.is_some()),
            displacements: moved,
            tractions,
        };
        for (cell, gap) in solved.gap.iter_mut().enumerate() {
            let place = scene.places[cell];
            *gap = *gap + solved.displacements[0][cell] - deep_by(&motions, place);
            if scene.is_frictional() {
                let moved = moved_by(&motions, place);
                for axis in 0..2 {
                    solved.slid[axis][cell] = moved[axis] - solved.displacements[1 + axis][cell];
                    solved.drift[axis][cell] = solved.slid[axis][cell] - before.slid[axis][cell];
                }
            }
        }
        if rule.pace.is_some() {
            for (place, cell) in solved.contact.cells().enumerate() {
                if before.zone_of(cell) == Zone::Open {
                    let ahead = at(&rule.ahead, place);
                    let [x, y] = rate_since_touch(at(&solved.drift, cell), ahead, rule.touch[place]);
                    (solved.drift[0][cell], solved.drift[1][cell]) = (x, y);
                }
            }
        }
        solved
    }
}

/// Zones in the region.
pub(super) fn zones(scene: &Scene<'_>, state: &ContactState) -> Array2<Zone> {
    let shape = scene.region.shape;
    let zones = scene.region.gather_map(&state.zone, |zone| *zone);
    Array2::from_shape_vec(shape, zones).unwrap_or_else(|_| Array2::default(shape))
}

/// The law of friction in force at a stage, on the part in front of the mirrors.
pub(super) fn law_of(plan: &Plan, stage: usize) -> Cow<'_, CoulombFriction> {
    let mut latest_first = plan.case.stages.iter().take(stage + 1).rev();
    let law = latest_first.find_map(|stage| stage.friction.as_ref()).unwrap_or(&plan.case.friction);
    plan.symmetry.part_of_friction(law)
}
