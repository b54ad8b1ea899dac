//! A history once more, from the states that its run left: what each increment, or part of one, prescribed, and what was solved.

use super::fields::{Fields, zeros};
use super::loads::{Load, Prescribed};
use super::operators::Operators;
use super::rule::{Cells, Rule};
use super::scene::Scene;
use super::snapshot::Snapshot;
use super::solved::{Solved, at, deep_by, moved_by};
use crate::model::{ContactState, Zone};
use crate::solver::{ContactSet, rate_since_touch};

/// Goes through a history again, increment by increment.
pub(super) struct Replay<'a> {
    scene: &'a Scene<'a>,
    pub prescribed: Prescribed<'a>,
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

    /// The next increment, after `before`, which came from `former`, both `None` where there is none but the start, and the `last` one as the run left
    /// it. Its displacements are found, where they are not known.
    pub fn next(
        &mut self,
        (snapshot, last): (&Snapshot, Option<&Snapshot>),
        past: [Option<&Solved>; 2],
        operators: (&mut Operators, Option<&Fields>),
    ) -> Next {
        let scene = self.scene;
        let [before, former] = past.map(|solved| solved.unwrap_or(&self.start));
        let state = last.map(Snapshot::motions);
        let state = state.as_ref().unwrap_or(&self.untouched);
        let reached = before.reached(scene);
        let place = (snapshot.record.stage, snapshot.share);
        let load = self.prescribed.next(place, (state, &reached), before.load.as_ref());
        let solved = (!before.stands(&load))
            .then(|| solved((scene, last), snapshot, (&load, [before, former]), operators));
        Next { load, solved }
    }
}

/// An increment in the region, from what the run left of it.
fn solved(
    (scene, last): (&Scene<'_>, Option<&Snapshot>),
    snapshot: &Snapshot,
    (load, [before, former]): (&Load, [&Solved; 2]),
    (operators, found): (&mut Operators, Option<&Fields>),
) -> Solved {
    let region = scene.region;
    let (tractions, zone) = snapshot.in_region(region);
    let moved = if let Some(found) = found {
        found.clone()
    } else if tractions[0].iter().any(|p| *p > 0.0) {
        operators.displacements(&tractions)
    } else {
        zeros(region.len())
    };
    let motions = scene.motions(&snapshot.motions());
    let contact = ContactSet::loaded(&tractions[0]);
    let rule =
        Rule::new(scene, (load, snapshot.by_end_points), [before, former], (&contact, &[]), Cells::Entered);
    let mut undeformed = scene.undeformed.clone();
    if let Some(depth) = last.and_then(|last| last.worn.as_ref()) {
        undeformed.iter_mut().zip(region.gather(depth)).for_each(|(gap, worn)| *gap += worn);
    }
    if let Some(thickness) = last.and_then(|last| last.debris.as_ref()) {
        undeformed.iter_mut().zip(region.gather(thickness)).for_each(|(gap, debris)| *gap -= debris);
    }
    let mut solved = Solved {
        gap: undeformed.clone(),
        undeformed,
        worn: snapshot.worn_in(region),
        debris: snapshot.debris_in(region),
        area: scene.area(),
        block: snapshot.block,
        opens: snapshot.has_worn(last),
        slipped: snapshot.slipped.clone(),
        zone,
        motions,
        strain: scene.strain.under(load.step.bulk_stress),
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
        let place = scene.place(cell);
        *gap = *gap + solved.displacements[0][cell] - deep_by(&motions, place);
        if scene.is_frictional() {
            let moved = moved_by(&motions, place);
            for axis in 0..2 {
                let displaced = solved.displacements[1 + axis][cell] + solved.strain[axis] * place[axis];
                solved.slid[axis][cell] = moved[axis] - displaced;
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
