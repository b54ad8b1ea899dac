//! The rule of second order, linearised: how the paths of slip in an increment (`solver/slip_history.rs`) change with what came before it.

use super::change::{Change, Tangential, add};
use super::coming::SlipThatComes;
use super::loads::Load;
use super::scene::Scene;
use super::solved::{Solved, at};
use crate::fields::{Scalar, Slopes, length_of};
use crate::model::controls::FREEDOMS;
use crate::model::{Integration, Zone};
use crate::solver::{
    ContactSet, Edge, Ends, Pace, SlipOfEdge, Then, moment_of_touch, pace_of, path_after_slip,
    turn_after_stick, way_to_touch,
};

/// Derivatives by the changes of the loads in the last increment, and in this one.
type ByLoads = [[f64; FREEDOMS]; 2];

/// How the path of a cell in contact changes, where it does.
#[derive(Debug, Clone, PartialEq)]
enum Path {
    /// Turn and offset of a cell that slipped, by its last two drifts, ratio and length of the increments, and the largest slip.
    Slid([[f64; 7]; 4]),
    /// Turn of a cell that stuck, by its shear and the largest one.
    Held([[f64; 3]; 2]),
    /// Offset and moment of touch of a cell that was open, by its last two gaps, the lengths of the increment in the normal load and in all loads,
    /// its last drift, and the slip of the edge.
    Entered([[f64; 8]; 3]),
}

/// The largest of a field: where it is, and its direction.
type Largest = Option<(usize, [f64; 2])>;

/// The rule in one increment, in the cells of its contact.
#[derive(Debug, Clone)]
pub(super) struct Rule {
    pub pace: Option<Pace>,
    loads: ByLoads,
    edge: ByLoads,
    slip: Largest,
    shear: Largest,
    coming: SlipThatComes,
    /// Place in the contact, and cell.
    paths: Vec<(usize, usize, Path)>,
    /// Vectors t, offsets a and moments of touch, packed.
    pub turn: Tangential,
    pub ahead: Tangential,
    pub touch: Vec<f64>,
}

/// Changes of the lengths of an increment, of the largest slip and shear, of the paths, packed, and of the slip of the edge in the region.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PathChange {
    pub loads: f64,
    edge: f64,
    slip: f64,
    shear: f64,
    pub turn: Tangential,
    pub ahead: Tangential,
    pub touch: Vec<f64>,
}

impl PathChange {
    pub fn none(cells: usize) -> Self {
        let field = || [vec![0.0; cells], vec![0.0; cells]];
        let touch = vec![0.0; cells];
        Self { loads: 0.0, edge: 0.0, slip: 0.0, shear: 0.0, turn: field(), ahead: field(), touch }
    }
}

/// Which cells of the contact the rule is linearised in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cells {
    All,
    /// Those that have come into contact, whose drift the next increments do not see as it is.
    Entered,
}

/// Length of an increment over that of the last one with its derivatives; `None` where it does not go on from that.
fn pace(scene: &Scene<'_>, load: &Load, before: &Solved, end_point: bool) -> Option<(Pace, [ByLoads; 2])> {
    const BOTH: usize = 2 * FREEDOMS;
    let of_second_order = scene.is_frictional() && scene.plan.case.integration == Integration::SecondOrder;
    // Of surfaces that have worn since, no increment before is known.
    let (first, last) = (before.from.as_ref().filter(|_| !before.opens)?, load.from.as_ref()?);
    let friction_changes = load.begins && scene.plan.case.friction_changes_at(load.stage);
    if !of_second_order || end_point || friction_changes {
        return None;
    }
    let (older, newer) = (first.change_to(last)?, last.change_to(&load.step)?);
    let both: [Slopes<BOTH>; BOTH] =
        Slopes::of_each(std::array::from_fn(|k| if k < FREEDOMS { older[k] } else { newer[k - FREEDOMS] }));
    let parts = [0, FREEDOMS].map(|first| std::array::from_fn(|freedom| both[first + freedom]));
    let found = pace_of::<Slopes<BOTH>>(parts, &load.step)?;
    let by = |slopes: Option<Slopes<BOTH>>| {
        let by = slopes.map_or([0.0; BOTH], |slopes| slopes.by);
        [0, FREEDOMS].map(|first| std::array::from_fn(|freedom| by[first + freedom]))
    };
    let value =
        Pace { loads: found.loads.value, edge: found.edge.map(|edge| edge.value), grows: found.grows };
    Some((value, [by(Some(found.loads)), by(found.edge)]))
}

/// The largest of a tangential field among some cells.
fn largest_of(field: [&[f64]; 2], cells: impl Iterator<Item = usize>) -> (f64, Largest) {
    let (mut most, mut found) = (0.0, None);
    for cell in cells {
        let here = [field[0][cell], field[1][cell]];
        let size = length_of(here);
        if size > most {
            (most, found) = (size, Some((cell, here.map(|part| part / size))));
        }
    }
    (most, found)
}

impl Rule {
    /// The rule in an increment of a `load` from `before`, which came from `former`, to a `contact` in which cells do what their zones say.
    pub fn new(
        scene: &Scene<'_>,
        (load, end_point): (&Load, bool),
        [before, former]: [&Solved; 2],
        (contact, zones): (&ContactSet, &[Zone]),
        wanted: Cells,
    ) -> Self {
        let (cells, none) = (contact.len(), ByLoads::default());
        let PathChange { turn, ahead, touch, .. } = PathChange::none(cells);
        let mut rule = Self {
            pace: None,
            loads: none,
            edge: none,
            slip: None,
            shear: None,
            coming: SlipThatComes::default(),
            paths: Vec::new(),
            turn,
            ahead,
            touch,
        };
        let Some((pace, [loads, edge])) = pace(scene, load, before, end_point) else { return rule };
        (rule.pace, rule.loads, rule.edge) = (Some(pace), loads, edge);
        if wanted == Cells::All {
            rule.go_on(pace, [before, former], (contact, zones));
        }
        if let (Some(ratio), true) = (pace.edge, before.went_on()) {
            rule.enter((pace.loads, ratio), [before, former], (contact, scene.ends()));
        }
        rule
    }

    /// Paths of cells that were in contact.
    fn go_on(
        &mut self,
        pace: Pace,
        [before, former]: [&Solved; 2],
        (contact, zones): (&ContactSet, &[Zone]),
    ) {
        let all = 0..before.zone.len();
        let slipped = all.clone().filter(|cell| before.zone_of(*cell) == Zone::Slip);
        let (largest_slip, slip) = largest_of(before.drift.each_ref().map(Vec::as_slice), slipped);
        let (largest_shear, shear) = largest_of(before.shear(), all);
        (self.slip, self.shear) = (slip, shear);
        for (place, cell) in contact.cells().enumerate() {
            match before.zone_of(cell) {
                Zone::Slip => {
                    let (here, drift) = (at(&before.drift, cell), at(&former.drift, cell));
                    let [x, y, then_x, then_y, ratio, loads, largest] = Slopes::<7>::of_each([
                        here[0],
                        here[1],
                        drift[0],
                        drift[1],
                        before.ratio(),
                        pace.loads,
                        largest_slip,
                    ]);
                    let pressure = former.tractions[0][cell];
                    let then = match before.went_on() {
                        true if pressure <= 0.0 && before.knows_touch => Then::Entered,
                        true if pressure > 0.0 => Then::Slid([then_x, then_y]),
                        _ => Then::Unknown,
                    };
                    if let Some([turn, ahead]) =
                        path_after_slip([x, y], then, (loads, ratio, largest), pace.grows)
                    {
                        self.set(place, [turn, ahead].map(|pair| pair.map(Scalar::value)));
                        let [turn, ahead] = [turn, ahead].map(|pair| pair.map(|part| part.by));
                        let by = [turn[0], turn[1], ahead[0], ahead[1]];
                        self.paths.push((place, cell, Path::Slid(by)));
                    }
                }
                Zone::Stick if zones[place] == Zone::Slip => {
                    let held = before.shear_at(cell);
                    let [x, y, largest] = Slopes::<3>::of_each([held[0], held[1], largest_shear]);
                    if let Some(turn) = turn_after_stick([x, y], largest) {
                        self.set(place, [turn.map(Scalar::value), [0.0; 2]]);
                        self.paths.push((place, cell, Path::Held(turn.map(|part| part.by))));
                    }
                }
                _ => {}
            }
        }
    }

    /// Offsets of cells that were open.
    fn enter(
        &mut self,
        (loads, ratio): (f64, f64),
        [before, former]: [&Solved; 2],
        (contact, ends): (&ContactSet, [Ends; 2]),
    ) {
        let edge = Edge { before: &former.gap, now: &before.gap, ratio, ends };
        let [_, columns] = before.shape();
        let place_of = |cell: usize| [cell / columns, cell % columns];
        let number = |[i, j]: [usize; 2]| i * columns + j;
        let slip_of = |place: [usize; 2]| {
            if before.zone[place] == Zone::Slip { at(&before.drift, number(place)) } else { [0.0; 2] }
        };
        let mut coming = SlipOfEdge::new(&edge, &before.zone);
        for (place, cell) in contact.cells().enumerate() {
            let grid = place_of(cell);
            if before.zone[grid] != Zone::Open || !(edge.moment_of_touch(grid) > 0.0) {
                continue;
            }
            let (here, slid) = (at(&before.drift, cell), coming.at(grid, &slip_of));
            let [then, now, ratio, loads, x, y, along_x, along_y] = Slopes::<8>::of_each([
                former.gap[grid],
                before.gap[grid],
                ratio,
                loads,
                here[0],
                here[1],
                slid[0],
                slid[1],
            ]);
            let moment = moment_of_touch([then, now], ratio);
            let ahead = way_to_touch(moment * loads, [x, y], [along_x, along_y]);
            self.set(place, [[0.0; 2], ahead.map(Scalar::value)]);
            self.touch[place] = moment.value;
            self.paths.push((place, cell, Path::Entered([ahead[0].by, ahead[1].by, moment.by])));
        }
        self.coming = SlipThatComes::new(&coming, before);
    }

    fn set(&mut self, place: usize, [turn, ahead]: [[f64; 2]; 2]) {
        for axis in 0..2 {
            self.turn[axis][place] = turn[axis];
            self.ahead[axis][place] = ahead[axis];
        }
    }

    /// Changes of the paths, with those of the loads in `next`.
    pub fn forward(&self, [before, former, next]: [&Change; 3]) -> PathChange {
        let mut found = PathChange::none(self.touch.len());
        if self.pace.is_none() {
            return found;
        }
        let by_loads = |by: &ByLoads| -> f64 {
            let of = |k: usize| {
                by[0][k] * (next.from[k] - before.from[k]) + by[1][k] * (next.load[k] - next.from[k])
            };
            (0..FREEDOMS).map(of).sum()
        };
        (found.loads, found.edge) = (by_loads(&self.loads), by_loads(&self.edge));
        let largest = |largest: Largest, field: &Tangential| {
            largest.map_or(0.0, |(cell, along)| along[0] * field[0][cell] + along[1] * field[1][cell])
        };
        (found.slip, found.shear) = (largest(self.slip, &before.drift), largest(self.shear, &before.shear));
        let slid = self.coming.forward(before);
        for &(place, cell, ref path) in &self.paths {
            match path {
                Path::Slid(by) => {
                    let ([x, y], [then_x, then_y]) = (at(&before.drift, cell), at(&former.drift, cell));
                    let inputs = [x, y, then_x, then_y, before.ratio, found.loads, found.slip];
                    let [turn_x, turn_y, ahead_x, ahead_y] = by.map(|row| product(&row, &inputs));
                    (found.turn[0][place], found.turn[1][place]) = (turn_x, turn_y);
                    (found.ahead[0][place], found.ahead[1][place]) = (ahead_x, ahead_y);
                }
                Path::Held(by) => {
                    let [x, y] = at(&before.shear, cell);
                    for axis in 0..2 {
                        found.turn[axis][place] = product(&by[axis], &[x, y, found.shear]);
                    }
                }
                Path::Entered(by) => {
                    let ([x, y], [along_x, along_y]) = (at(&before.drift, cell), slid[cell]);
                    let gaps = [former.gap[cell], before.gap[cell]];
                    let inputs = [gaps[0], gaps[1], found.edge, found.loads, x, y, along_x, along_y];
                    let [ahead_x, ahead_y, touch] = by.map(|row| product(&row, &inputs));
                    (found.ahead[0][place], found.ahead[1][place]) = (ahead_x, ahead_y);
                    found.touch[place] = touch;
                }
            }
        }
        found
    }

    /// Backwards: adds to `before`, `former`, and the loads of `next`.
    pub fn transposed(&self, mut of: PathChange, [before, former, next]: [&mut Change; 3]) {
        if self.pace.is_none() {
            return;
        }
        let mut slid = vec![[0.0; 2]; before.gap.len()];
        for &(place, cell, ref path) in &self.paths {
            let (turn, ahead) = (at(&of.turn, place), at(&of.ahead, place));
            match path {
                Path::Slid(by) => {
                    let found = combination(by, &[turn[0], turn[1], ahead[0], ahead[1]]);
                    let [x, y, then_x, then_y, ratio, loads, largest] = found;
                    add(&mut before.drift, cell, [x, y]);
                    add(&mut former.drift, cell, [then_x, then_y]);
                    before.ratio += ratio;
                    of.loads += loads;
                    of.slip += largest;
                }
                Path::Held(by) => {
                    let [x, y, largest] = combination(by, &turn);
                    add(&mut before.shear, cell, [x, y]);
                    of.shear += largest;
                }
                Path::Entered(by) => {
                    let found = combination(by, &[ahead[0], ahead[1], of.touch[place]]);
                    let [then, now, edge, loads, x, y, along_x, along_y] = found;
                    former.gap[cell] += then;
                    before.gap[cell] += now;
                    of.edge += edge;
                    of.loads += loads;
                    add(&mut before.drift, cell, [x, y]);
                    slid[cell][0] += along_x;
                    slid[cell][1] += along_y;
                }
            }
        }
        self.coming.transposed(slid, before);
        for (largest, amount, field) in
            [(self.slip, of.slip, &mut before.drift), (self.shear, of.shear, &mut before.shear)]
        {
            if let Some((cell, along)) = largest {
                add(field, cell, along.map(|part| amount * part));
            }
        }
        for (by, amount) in [(&self.loads, of.loads), (&self.edge, of.edge)] {
            for k in 0..FREEDOMS {
                before.from[k] -= amount * by[0][k];
                next.from[k] += amount * (by[0][k] - by[1][k]);
                next.load[k] += amount * by[1][k];
            }
        }
    }

    /// How many cells slipped, stuck, were open, of those whose paths change.
    #[cfg(test)]
    pub fn kinds(&self) -> [usize; 3] {
        let count = |is: fn(&Path) -> bool| self.paths.iter().filter(|(.., path)| is(path)).count();
        [
            count(|path| matches!(path, Path::Slid(_))),
            count(|path| matches!(path, Path::Held(_))),
            count(|path| matches!(path, Path::Entered(_))),
        ]
    }
}

/// Product of a row with changes.
pub(super) fn product<const N: usize>(row: &[f64; N], changes: &[f64; N]) -> f64 {
    row.iter().zip(changes).map(|(by, change)| by * change).sum()
}

/// Sum of rows, each times its amount.
pub(super) fn combination<const N: usize, const M: usize>(
    rows: &[[f64; N]; M],
    amounts: &[f64; M],
) -> [f64; N] {
    std::array::from_fn(|column| rows.iter().zip(amounts).map(|(row, amount)| row[column] * amount).sum())
}
