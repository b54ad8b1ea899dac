//! The derivatives of a history by one parameter, carried from increment to increment: all that a solved increment leaves behind for the
//! next one, in dual numbers.

use ndarray::Array2;

use super::cell::{Cell, MOTIONS, Prescribed, Shear};
use super::linearised::{Fields, zeros};
use super::loads::{AllReached, Load, Reached};
use super::scene::{Scene, Solved};
use crate::fields::{Dual, Scalar, length};
use crate::model::{Control, CoulombFriction, Integration, Zone};
use crate::solver::{FrictionLaw, Paths, Recent, Region, end_of_chord, pace_of};

/// A tangential field in dual numbers.
pub(super) type DualField = [Vec<Dual>; 2];

/// What is known of the last increment.
#[derive(Debug, Clone)]
pub(super) struct Last {
    /// Its drift [length].
    pub drift: DualField,
    /// Its length over that of the one before, in the loads.
    pub ratio: Dual,
    /// Whether the moments of touch in it were known.
    pub knows_touch: bool,
}

/// What is known of the increment before the last one.
#[derive(Debug, Clone)]
pub(super) struct Before {
    pub load: Load,
    /// Pressure that it ended with [pressure].
    pub pressure: Vec<f64>,
    /// Gap and drift that it ended with [length], where the last one went on from it.
    pub gap: Option<Array2<Dual>>,
    pub drift: Option<DualField>,
}

/// The derivatives of a history by one parameter, as far as it has come.
#[derive(Debug, Clone)]
pub(super) struct Track {
    pub pressure: Vec<Dual>,
    pub shear: DualField,
    /// Normal, along x and y [length].
    pub displacement: [Vec<Dual>; 3],
    /// Gap [length].
    pub gap: Array2<Dual>,
    pub zone: Array2<Zone>,
    /// Rotations times the length [length].
    pub motions: [Dual; MOTIONS],
    /// Dissipated, stored, external and unresolved energy of the whole contact.
    pub energies: [Dual; 4],
    pub reached: AllReached,
    pub last_load: Option<Load>,
    pub last: Option<Last>,
    pub before: Option<Before>,
}

/// What an increment depends on by one parameter, besides the state before.
pub(super) struct Drive {
    /// The load at its end, of the part in front of the mirrors.
    pub load: Load,
    /// Derivative of the gap before deformation [length].
    pub gap: Array2<f64>,
    /// Derivatives of friction coefficient and shear strength.
    pub friction: [f64; 2],
    /// Derivatives of the compliances of the machine, of the part in front of the mirrors [length/force].
    pub rig: [f64; 3],
    /// Displacements of the tractions by the derivative of the response [length].
    pub by_response: Fields,
}

/// What is known of an increment before its linear equations are solved.
pub(super) struct Known {
    /// The paths of slip; `None`: the end-point rule.
    pub paths: Option<Paths<Dual>>,
    /// Length of the increment over that of the last one, in the loads, and whether the edge is known.
    pub pace: Option<(Dual, bool)>,
    /// The last load, as this one prescribes it.
    pub last_load: Option<Load>,
    /// Slip less the offset in the cells of the contact, with the derivative that it has without a change of the solution [length].
    pub chords: Vec<[Dual; 2]>,
    /// Friction bound in the cells of the contact, with its derivative at the pressure as it is [pressure].
    pub bounds: Vec<Dual>,
    /// The cells of the contact.
    pub cells: Vec<Cell>,
}

/// A cell's two numbers.
pub(super) fn at(field: &DualField, cell: usize) -> [Dual; 2] {
    [field[0][cell], field[1][cell]]
}

fn constants(cells: usize) -> Vec<Dual> {
    vec![Dual::of(0.0); cells]
}

impl Track {
    /// Bodies that have not touched yet; `gap`: the derivative of the gap before deformation.
    pub fn untouched(scene: &Scene<'_>, gap: &Array2<f64>) -> Self {
        let cells = scene.region.len();
        let field = || [constants(cells), constants(cells)];
        let dual = |((i, j), value): ((usize, usize), &f64)| Dual::new(*value, gap[[i, j]]);
        let gaps: Vec<Dual> = scene.undeformed.indexed_iter().map(dual).collect();
        let shape = scene.region.shape;
        Self {
            pressure: constants(cells),
            shear: field(),
            displacement: [constants(cells), constants(cells), constants(cells)],
            gap: Array2::from_shape_vec(shape, gaps)
                .unwrap_or_else(|_| Array2::from_elem(shape, Dual::of(0.0))),
            zone: Array2::from_elem(shape, Zone::Open),
            motions: [Dual::of(0.0); MOTIONS],
            energies: [Dual::of(0.0); 4],
            reached: [Reached::default(); 6],
            last_load: None,
            last: None,
            before: None,
        }
    }

    /// Whether no load changes in an increment.
    pub fn stands(&self, load: &Load) -> bool {
        self.last.is_some() && self.last_load.as_ref().is_some_and(|last| last.step == load.step)
    }

    /// Whether none would with another parameter either.
    pub fn pauses(&self, load: &Load) -> bool {
        self.stands(load) && self.last_load.as_ref().is_some_and(|last| last.change == load.change)
    }

    /// What is known of an increment before its equations are solved.
    pub fn known(&self, scene: &Scene<'_>, solved: &Solved<'_>, drive: &Drive) -> Known {
        let last_load = self.last_load.as_ref().map(|last| self.of_part(last, &drive.load, scene));
        let end_point = solved.record.work.end_point_increments > 0;
        let of_second_order =
            scene.is_frictional() && scene.plan.case.integration == Integration::SecondOrder;
        let pace = self.before.as_ref().zip(last_load.as_ref()).filter(|_| of_second_order && !end_point);
        let pace = pace.and_then(|(before, last)| {
            pace_of([before.load.change_to(last)?, last.change_to(&drive.load)?], &drive.load.step)
        });
        let paths = pace.and_then(|pace| {
            let last = self.last.as_ref()?;
            let before = self.before.as_ref();
            let drift = before.and_then(|before| before.drift.clone());
            let recent = Recent {
                region: Region::whole(scene.region.shape),
                zones: self.zone.iter().copied().collect(),
                drift: last.drift.clone(),
                ratio: last.ratio,
                knows_touch: last.knows_touch,
                then: drift.zip(before.map(|before| before.pressure.clone())),
                shear: self.shear.clone(),
                gaps: before.and_then(|before| Some([before.gap.as_ref()?, &self.gap])),
            };
            Some(recent.paths(pace, &self.zone, |_| true, || last.drift.clone()))
        });
        let pace = pace.map(|pace| (pace.loads, pace.edge.is_some()));
        let mut known =
            Known { paths, pace, last_load, chords: Vec::new(), bounds: Vec::new(), cells: Vec::new() };
        self.find_cells(scene, solved, drive, &mut known);
        known
    }

    /// The last load as the controls of this one would have prescribed it.
    fn of_part(&self, last: &Load, load: &Load, scene: &Scene<'_>) -> Load {
        let copies = scene.plan.symmetry.copies() as f64;
        let reached = self.reached.map(|reached| Reached { force: reached.force / copies, ..reached });
        last.of_kinds(&load.step, 0..3, &reached)
    }

    /// Chords, bounds and what the cells of the contact do.
    fn find_cells(&self, scene: &Scene<'_>, solved: &Solved<'_>, drive: &Drive, known: &mut Known) {
        let law = FrictionLaw::in_region(&solved.law, scene.region);
        let moved = std::array::from_fn(|motion| {
            Dual::new(solved.motions[motion] - self.motions[motion].value, -self.motions[motion].change)
        });
        for cell in solved.contact.cells() {
            let [i, j] = scene.region.at(cell);
            let pressure = solved.tractions[0][cell];
            let (bound, slope) = law.at(cell, pressure);
            let shear = [solved.tractions[1][cell], solved.tractions[2][cell]];
            let place = scene.places[cell];
            let displaced = [1, 2].map(|part| {
                Dual::new(
                    self.displacement[part][cell].value - solved.displacements[part][cell],
                    self.displacement[part][cell].change,
                )
            });
            let by_motions = moved_by(&moved, place);
            let drift = [0, 1].map(|axis| displaced[axis] + by_motions[axis]);
            let (chord, turn) = match &known.paths {
                None => (drift, None),
                Some(paths) => {
                    let ahead = at(&paths.ahead, cell);
                    ([drift[0] - ahead[0], drift[1] - ahead[1]], Some(at(&paths.turn, cell)))
                }
            };
            let by_friction = bound_change((&solved.law, [i, j]), pressure, drive.friction);
            known.chords.push(chord);
            known.bounds.push(Dual::new(bound, by_friction));
            let slips = solved.zone[index(scene, cell)] == Zone::Slip;
            known.cells.push(cell_of(scene, (slips, place), (shear, [bound, slope]), (chord, turn)));
        }
    }

    /// What is prescribed of the motions, and by which amount it changes.
    pub fn prescribed(
        &self,
        scene: &Scene<'_>,
        solved: &Solved<'_>,
        drive: &Drive,
    ) -> [(Prescribed, f64); MOTIONS] {
        let area = scene.grid.cell_area();
        let length = scene.length;
        let units = [1.0, length, length, 1.0, 1.0, length];
        let freedoms = [0, 4, 5, 1, 2, 3];
        let controls = drive.load.step.controls();
        let springs = [scene.rig.normal, 0.0, 0.0, scene.rig.tangential[0], scene.rig.tangential[1], 0.0];
        let of_springs = [drive.rig[0], 0.0, 0.0, drive.rig[1], drive.rig[2], 0.0];
        std::array::from_fn(|motion| {
            let change = drive.load.change[freedoms[motion]];
            let nothing_resists = motion >= 3 && (!scene.is_frictional() || is_across(scene, motion));
            match controls[freedoms[motion]] {
                Control::Force(_) if nothing_resists => (Prescribed::Motion, self.motions[motion].change),
                Control::Force(_) => (Prescribed::Resultant, change / (area * units[motion])),
                Control::FarEnd(_) if springs[motion] > 0.0 && !nothing_resists => {
                    let force = solved.resultant(motion) * area;
                    (Prescribed::FarEnd(springs[motion] * area), change - of_springs[motion] * force)
                }
                Control::Motion(_) | Control::FarEnd(_) => (Prescribed::Motion, change * units[motion]),
            }
        })
    }
}

/// Whether a motion is that across the one axis along which shear acts.
fn is_across(scene: &Scene<'_>, motion: usize) -> bool {
    scene.plan.along.is_some_and(|axis| motion != 3 + axis)
}

impl Known {
    /// What displacements ask for in the cells of the contact, without a change of the solution; packed [length].
    pub fn asked(&self, (scene, solved): (&Scene<'_>, &Solved<'_>), drive: &Drive) -> Fields {
        let mut asked = zeros(self.cells.len());
        for (number, cell) in solved.contact.cells().enumerate() {
            asked[0][number] = -drive.gap[index(scene, cell)];
            let chord = self.chords[number];
            let Cell { shear, .. } = self.cells[number];
            if let Shear::Turns { .. } = shear {
                let across = self.cells[number].across();
                let end = self.end_of(cell, chord);
                asked[1][number] = across[0] * end[0].change + across[1] * end[1].change;
            } else {
                asked[1][number] = chord[0].change;
                asked[2][number] = chord[1].change;
            }
        }
        asked
    }

    /// Slip at the end of the increment in a cell of the contact, up to a factor, from the slip less the offset.
    pub fn end_of(&self, cell: usize, chord: [Dual; 2]) -> [Dual; 2] {
        match &self.paths {
            None => chord,
            Some(paths) => end_of_chord(chord, at(&paths.turn, cell)),
        }
    }
}

impl Solved<'_> {
    /// Sum of the tractions over the cells of the part that goes with a motion that a spring holds.
    fn resultant(&self, motion: usize) -> f64 {
        let [pressure, x, y] = &self.tractions;
        let sum = |field: &[f64]| field.iter().sum::<f64>();
        match motion {
            0 => sum(pressure),
            3 => sum(x),
            4 => sum(y),
            _ => 0.0,
        }
    }
}

/// Where a cell of the region stands in its fields.
pub(super) fn index(scene: &Scene<'_>, cell: usize) -> [usize; 2] {
    let [_, columns] = scene.region.shape;
    [cell / columns, cell % columns]
}

/// Tangential displacement by motions at a place.
pub(super) fn moved_by(motions: &[Dual; MOTIONS], [x, y]: [f64; 2]) -> [Dual; 2] {
    let [_, _, _, shift_x, shift_y, turned] = *motions;
    [shift_x - turned * y, shift_y + turned * x]
}

/// What a cell in contact does.
fn cell_of(
    scene: &Scene<'_>,
    (slips, place): (bool, [f64; 2]),
    (shear, [bound, slope]): ([f64; 2], [f64; 2]),
    (chord, turn): ([Dual; 2], Option<[Dual; 2]>),
) -> Cell {
    let held = match scene.plan.along {
        None => Shear::Held,
        Some(axis) => Shear::HeldAlong(axis),
    };
    let still = Cell { shear: held, along: [0.0; 2], slope: 0.0, place };
    if !scene.is_frictional() {
        return Cell { shear: Shear::Follows, ..still };
    }
    if !slips {
        return still;
    }
    let end = |chord: [Dual; 2]| match turn {
        None => chord,
        Some(turn) => end_of_chord(chord, turn.map(|part| Dual::of(part.value))),
    };
    let slip = end(chord).map(|part| part.value);
    let direction = if length(shear) > 0.0 { shear } else { slip };
    let size = length(direction);
    if !(size > 0.0) {
        return Cell { shear: Shear::Follows, ..still };
    }
    let along = direction.map(|part| part / size);
    let across = [-along[1], along[0]];
    let kind = if scene.plan.along.is_some() || !(bound > 0.0) {
        Shear::Follows
    } else {
        // Products of the row with a unit change of the chord along x and y.
        let row = [[1.0, 0.0], [0.0, 1.0]].map(|[x, y]| {
            let end = end([Dual::new(chord[0].value, x), Dual::new(chord[1].value, y)]);
            across[0] * end[0].change + across[1] * end[1].change
        });
        let compliance = ((slip[0] * along[0] + slip[1] * along[1]) / bound).max(0.0);
        Shear::Turns { row, compliance }
    };
    Cell { shear: kind, along, slope, place }
}

/// Derivative of the friction bound at a pressure by coefficient and strength.
fn bound_change((law, [i, j]): (&CoulombFriction, [usize; 2]), pressure: f64, by: [f64; 2]) -> f64 {
    let coulomb = law.coefficient().at(i, j) * pressure;
    match law.max_shear().map(|strength| strength.at(i, j)) {
        Some(strength) if coulomb > strength => by[1],
        _ => pressure * by[0],
    }
}

/// The friction bound of a cell under a pressure.
pub(super) fn bound_under(
    (law, [i, j]): (&CoulombFriction, [usize; 2]),
    pressure: Dual,
    by: [f64; 2],
) -> Dual {
    let coulomb = Dual::new(law.coefficient().at(i, j), by[0]) * pressure;
    match law.max_shear().map(|strength| strength.at(i, j)) {
        Some(strength) if coulomb.value > strength => Dual::new(strength, by[1]),
        _ => coulomb,
    }
}
