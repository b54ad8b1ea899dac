//! What the cells of a contact do in an increment, and what its linearised equations ask for: right sides, from what changes besides the solution.

use super::case_number::OF_WEAR;
use super::cell::{Cell, MOTIONS, Prescribed, Shear};
use super::change::{Change, Tangential};
use super::fields::{Fields, zeros};
use super::friction_change::FrictionChange;
use super::loads::Load;
use super::rule::{PathChange, Rule};
use super::scene::{MOTION_OF, Scene};
use super::solved::{Solved, at};
use crate::fields::{Slopes, dot, length};
use crate::model::{Control, CoulombFriction, Zone};
use crate::solver::{ContactSet, FrictionLaw, end_of_chord};

/// The cells of a contact, and the rows of its motions.
pub(super) struct Contact<'a> {
    pub set: &'a ContactSet,
    pub cells: Vec<Cell>,
    /// Friction bound [pressure].
    pub bounds: Vec<f64>,
    /// Shear that follows the bound, by coefficient and strength, along x and y; packed.
    by_friction: [Tangential; 2],
    /// Derivative of the slip at the end of the increment, across the shear, by the turn.
    by_turn: Vec<[f64; 2]>,
    pub prescribed: [Prescribed; MOTIONS],
    amounts: [Amount; MOTIONS],
}

/// What the row of a motion asks for.
#[derive(Debug, Clone, Copy)]
enum Amount {
    /// The motion as it was.
    Kept,
    /// A factor of the load of a degree of freedom, less one of the compliance of a spring.
    OfLoad { freedom: usize, factor: f64, spring: Option<(usize, f64)> },
}

/// What changes besides the solution: the number that derivatives are taken by, as an increment sees it.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    /// Gap before deformation in the region [length].
    pub gap: Vec<f64>,
    /// Friction coefficient and shear strength.
    pub friction: FrictionChange,
    /// Compliances of the machine: normal, along x and y [length/force].
    pub rig: [f64; 3],
    /// Wear coefficient [1/pressure], width [length] and part inside [-] of the rim, fraction [-] and outflow length [length] of debris.
    pub wear: [f64; OF_WEAR],
    /// Wear coefficient [1/pressure] and thickness [length] of each layer, first those of the lower body; none where one coefficient holds.
    pub layers: Vec<[f64; 2]>,
    /// Strain by the bulk stresses of the increment, times the length.
    pub strain: [f64; 2],
    /// Displacements of the tractions by the change of the response [length].
    pub response: Fields,
}

impl Drive {
    /// Nothing, in the region of a scene.
    pub fn none(scene: &Scene<'_>) -> Self {
        let cells = scene.region.len();
        Self {
            gap: vec![0.0; cells],
            friction: FrictionChange::none(if scene.evolves() { cells } else { 0 }),
            rig: [0.0; 3],
            wear: [0.0; OF_WEAR],
            layers: vec![[0.0; 2]; scene.wearing_layers()],
            strain: [0.0; 2],
            response: zeros(cells),
        }
    }
}

/// What the equations ask for: displacements in the cells, packed, and the rows of the motions.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    pub displacements: Fields,
    pub amounts: [f64; MOTIONS],
}

impl<'a> Contact<'a> {
    /// The contact of an increment `now` under a law of friction.
    pub fn new(
        scene: &Scene<'_>,
        (now, before): (&'a Solved, &Solved),
        (load, law, rule): (&Load, &CoulombFriction, &Rule),
    ) -> Self {
        let of_region = FrictionLaw::in_region(law, scene.region);
        let cells = now.contact.len();
        let (prescribed, amounts) = rows(scene, now, load);
        let mut contact = Self {
            set: &now.contact,
            cells: Vec::with_capacity(cells),
            bounds: Vec::with_capacity(cells),
            by_friction: [(); 2].map(|()| [vec![0.0; cells], vec![0.0; cells]]),
            by_turn: Vec::with_capacity(cells),
            prescribed,
            amounts,
        };
        for (place, cell) in now.contact.cells().enumerate() {
            let pressure = now.tractions[0][cell];
            let (bound, slope) = of_region.at(cell, pressure);
            let (drift, ahead) = (now.drift_since(before, cell), at(&rule.ahead, place));
            let chord = [0, 1].map(|axis| drift[axis] - ahead[axis]);
            let turn = rule.pace.is_some().then(|| at(&rule.turn, place));
            let slips = now.zone_of(cell) == Zone::Slip;
            let (found, by_turn) = cell_of(
                scene,
                (slips, scene.place(cell)),
                (now.shear_at(cell), [bound, slope]),
                (chord, turn),
            );
            let by_number = bound_by_friction((law, scene.region.at(cell)), pressure);
            for (by, number) in contact.by_friction.iter_mut().zip(by_number) {
                for (by, along) in by.iter_mut().zip(found.along) {
                    by[place] = number * along;
                }
            }
            contact.cells.push(found);
            contact.bounds.push(bound);
            contact.by_turn.push(by_turn);
        }
        contact
    }

    /// What displacements and motions are asked for, without the change of the solution.
    pub fn asked(&self, before: &Change, next: &Change, (paths, drive): (&PathChange, &Drive)) -> Asked {
        let mut asked = zeros(self.cells.len());
        for ((place, cell), does) in self.set.cells().enumerate().zip(&self.cells) {
            asked[0][place] = -drive.gap[cell] - before.opened(cell);
            let (slid, ahead) = (at(&before.slid, cell), at(&paths.ahead, place));
            let strained = |axis: usize| next.strain[axis] * does.place[axis];
            let [x, y] = [0, 1].map(|axis| -slid[axis] - ahead[axis] - strained(axis));
            if let Some(row) = does.row() {
                let (by, turn) = (self.by_turn[place], at(&paths.turn, place));
                asked[1][place] = row[0] * x + row[1] * y + by[0] * turn[0] + by[1] * turn[1];
            } else {
                (asked[1][place], asked[2][place]) = (x, y);
            }
        }
        let amounts = std::array::from_fn(|motion| match self.amounts[motion] {
            Amount::Kept => before.motions[motion],
            Amount::OfLoad { freedom, factor, spring } => {
                let of_spring = spring.map_or(0.0, |(number, by)| by * drive.rig[number]);
                factor * next.load[freedom] - of_spring
            }
        });
        Asked { displacements: asked, amounts }
    }

    /// Backwards: adds to `before`, the loads and the strain of `next`, to the paths and to the number.
    pub fn asked_transposed(
        &self,
        of: &Asked,
        [before, next]: [&mut Change; 2],
        (paths, drive): (&mut PathChange, &mut Drive),
    ) {
        let [normal, x, y] = self.seen(&of.displacements);
        for (place, cell) in self.set.cells().enumerate() {
            drive.gap[cell] -= normal[place];
            before.add_opened(cell, -normal[place]);
            for (axis, along) in [&x, &y].into_iter().enumerate() {
                before.slid[axis][cell] -= along[place];
                next.strain[axis] -= along[place] * self.cells[place].place[axis];
                paths.ahead[axis][place] -= along[place];
                paths.turn[axis][place] += self.by_turn[place][axis] * of.displacements[1][place];
            }
        }
        for (motion, of) in of.amounts.into_iter().enumerate() {
            match self.amounts[motion] {
                Amount::Kept => before.motions[motion] += of,
                Amount::OfLoad { freedom, factor, spring } => {
                    next.load[freedom] += factor * of;
                    if let Some((number, by)) = spring {
                        drive.rig[number] -= by * of;
                    }
                }
            }
        }
    }

    /// What the rows of the cells make of displacements in them, packed: displacements, in slip those across the shear.
    pub fn rows(&self, [normal, x, y]: &Fields) -> Fields {
        let mut found = [normal.clone(), x.clone(), y.clone()];
        for (place, cell) in self.cells.iter().enumerate() {
            if let Some(row) = cell.row() {
                (found[1][place], found[2][place]) = (row[0] * x[place] + row[1] * y[place], 0.0);
            }
        }
        found
    }

    /// The transpose of [`rows`](Self::rows).
    pub fn seen(&self, [normal, first, second]: &Fields) -> Fields {
        let mut found = [normal.clone(), first.clone(), second.clone()];
        for (place, cell) in self.cells.iter().enumerate() {
            if let Some(row) = cell.row() {
                (found[1][place], found[2][place]) = (row[0] * first[place], row[1] * first[place]);
            }
        }
        found
    }

    /// Shear that follows a change of the friction bound, whatever else changes, on all cells of a region of so many.
    pub fn given(&self, friction: &FrictionChange, region: usize) -> Tangential {
        let mut given = [vec![0.0; region], vec![0.0; region]];
        let [coefficient, strength] = &self.by_friction;
        for (place, cell) in self.set.cells().enumerate() {
            let [by_coefficient, by_strength] = friction.at(cell);
            for axis in 0..2 {
                given[axis][cell] =
                    coefficient[axis][place] * by_coefficient + strength[axis][place] * by_strength;
            }
        }
        given
    }

    /// Backwards: of coefficient and strength everywhere, from those of the tractions in the cells of the contact, packed.
    pub fn given_transposed(&self, [_, x, y]: &Fields) -> [f64; 2] {
        self.by_friction.each_ref().map(|[along_x, along_y]| dot(along_x, x) + dot(along_y, y))
    }

    /// The same cell by cell: adds to those of friction.
    pub fn given_transposed_in_cells(&self, [_, x, y]: &Fields, friction: &mut FrictionChange) {
        for (place, cell) in self.set.cells().enumerate() {
            let of = |[along_x, along_y]: &Tangential| along_x[place] * x[place] + along_y[place] * y[place];
            friction.add(cell, self.by_friction.each_ref().map(of));
        }
    }
}

/// What is prescribed of the motions, and what their rows ask for.
fn rows(scene: &Scene<'_>, now: &Solved, load: &Load) -> ([Prescribed; MOTIONS], [Amount; MOTIONS]) {
    let area = scene.grid.cell_area();
    let copies = scene.plan.symmetry.copies() as f64;
    let springs = [scene.rig.normal, scene.rig.tangential[0], scene.rig.tangential[1], 0.0, 0.0, 0.0];
    let controls = load.step.controls();
    let units = scene.units();
    let mut prescribed = [Prescribed::Motion; MOTIONS];
    let mut amounts = [Amount::Kept; MOTIONS];
    for freedom in 0..MOTIONS {
        let (motion, unit, give) = (MOTION_OF[freedom], units[freedom], springs[freedom]);
        let nothing_resists = motion >= 3 && (!scene.is_frictional() || is_across(scene, motion));
        let of_load = |factor: f64| Amount::OfLoad { freedom, factor, spring: None };
        (prescribed[motion], amounts[motion]) = match controls[freedom] {
            Control::Force(_) if nothing_resists => (Prescribed::Motion, Amount::Kept),
            Control::Force(_) => (Prescribed::Resultant, of_load(1.0 / (area * unit))),
            Control::FarEnd(_) if give > 0.0 && !nothing_resists => {
                let force = now.tractions[freedom].iter().sum::<f64>() * area * copies;
                let spring = Some((freedom, force));
                (Prescribed::FarEnd(give * area), Amount::OfLoad { freedom, factor: 1.0, spring })
            }
            Control::Motion(_) | Control::FarEnd(_) => (Prescribed::Motion, of_load(unit)),
        };
    }
    (prescribed, amounts)
}

/// Whether a motion is that across the one axis along which shear acts.
fn is_across(scene: &Scene<'_>, motion: usize) -> bool {
    scene.plan.along.is_some_and(|axis| motion != 3 + axis)
}

/// What a cell in contact does, and how the slip at its end changes across the shear with the turn.
fn cell_of(
    scene: &Scene<'_>,
    (slips, place): (bool, [f64; 2]),
    (shear, [bound, slope]): ([f64; 2], [f64; 2]),
    (chord, turn): ([f64; 2], Option<[f64; 2]>),
) -> (Cell, [f64; 2]) {
    let held = match scene.plan.along {
        None => Shear::Held,
        Some(axis) => Shear::HeldAlong(axis),
    };
    let still = Cell { shear: held, along: [0.0; 2], slope: 0.0, place };
    if !scene.is_frictional() {
        return (Cell { shear: Shear::Follows, ..still }, [0.0; 2]);
    }
    if !slips {
        return (still, [0.0; 2]);
    }
    let turned = turn.unwrap_or_default();
    let [x, y, turn_x, turn_y] = Slopes::<4>::of_each([chord[0], chord[1], turned[0], turned[1]]);
    let end = if turn.is_some() { end_of_chord([x, y], [turn_x, turn_y]) } else { [x, y] };
    let slip = end.map(|part| part.value);
    let direction = if length(shear) > 0.0 { shear } else { slip };
    let size = length(direction);
    if !(size > 0.0) {
        return (Cell { shear: Shear::Follows, ..still }, [0.0; 2]);
    }
    let along = direction.map(|part| part / size);
    let across = [-along[1], along[0]];
    let cell = Cell { shear: Shear::Follows, along, slope, place };
    if scene.plan.along.is_some() || !(bound > 0.0) {
        return (cell, [0.0; 2]);
    }
    let by = |input: usize| across[0] * end[0].by[input] + across[1] * end[1].by[input];
    let compliance = ((slip[0] * along[0] + slip[1] * along[1]) / bound).max(0.0);
    let row = [by(0), by(1)];
    (Cell { shear: Shear::Turns { row, compliance }, ..cell }, [by(2), by(3)])
}

/// Derivatives of the friction bound at a pressure by coefficient and strength.
pub(super) fn bound_by_friction((law, [i, j]): (&CoulombFriction, [usize; 2]), pressure: f64) -> [f64; 2] {
    let coulomb = law.coefficient().at(i, j) * pressure;
    match law.max_shear().map(|strength| strength.at(i, j)) {
        Some(strength) if coulomb > strength => [0.0, 1.0],
        _ => [pressure, 0.0],
    }
}
