//! What the last two increments tell about the paths of slip in the next one.

use std::ops::Range;

use ndarray::Array2;

use super::ends::Ends;
use super::laws::slip_path::{SlipPath, path_that_goes_on, turn_that_begins};
use super::memory::{Before, Drift, SolverMemory};
use super::moving_edge::{Edge, SlipOfEdge, left_of_lag};
use super::pace::Pace;
use super::region::Region;
use crate::fields::{Scalar, TangentialField, in_portions, length_of};
use crate::model::{ContactState, Zone};

/// Slip that cells have still to go when they come to rest, over that of the last increment, summed over all moments of the increment at
/// which they may: where the rate of slip falls with the root of the time left, as beside a stick zone that grows. How it fades out, see
/// [`fall`], is by trial.
const STOP: f64 = 0.27;
/// The same where the normal load grows, and the rate of slip is taken to fall evenly: by trial, since there the edge grows with the stick zone.
const STOP_IN_GROWING: f64 = 1.0 / 6.0;
/// A cell that has just entered, of whose slip one rate is known, counts so much as one whose slip falls. By trial: more leaves less of the error
/// of the stick radius in coarse pressing, and more of that of the loops after it.
const ENTERED: f64 = 0.35;
/// A cell that begins to slip has turned on over its slip by this factor from where the shear that held it points at the start of the increment
/// to the end, over to the slip increment: on average over all moments at which it may begin, with a rate of slip that grows with the root of
/// the time since then, as beside a stick zone that shrinks.
const BEGUN: f64 = 1.277;
/// The edge of contact goes on to slip by this fraction of its last rate until it comes to a cell. By trial: Spence's contact, and normal and
/// tangential force that grow together; with more, edges that slip in the coarse increments of a first touch go on to do so.
const EDGE: f64 = 0.7;
/// Numbers of straight passes that take as long as the moment at which the edge comes to a cell.
const NUMBERS: usize = 50;
/// The direction of a slip increment, and of shear, is known where it is at least this fraction of the largest; below, the less the smaller.
const KNOWN: f64 = 0.01;

/// What is known of the last two increments in the cells of a region, in numbers of any kind.
pub struct Recent<'a, R> {
    /// The region.
    pub region: Region,
    /// What its cells did in the last increment.
    pub zones: Vec<Zone>,
    /// Drift of the last increment [length].
    pub drift: [Vec<R>; 2],
    /// Length of it over that of the one before, in the loads.
    pub ratio: R,
    /// Whether the moments of touch in it were known.
    pub knows_touch: bool,
    /// Drift of the increment before that [length], and the pressure that the last one started from.
    pub then: Option<([Vec<R>; 2], Vec<f64>)>,
    /// Shear at the start of the increment [pressure].
    pub shear: [Vec<R>; 2],
    /// Gap on the grid before the last increment, and after it [length].
    pub gaps: Option<[&'a Array2<R>; 2]>,
    /// What lies beyond the first and the last cells of the grid.
    pub ends: [Ends; 2],
}

/// The paths in the cells of a region: the vectors t, the offsets a and the moments of touch of [`SlipPath`].
pub struct Paths<R> {
    pub turn: [Vec<R>; 2],
    pub ahead: [Vec<R>; 2],
    pub touch: Vec<R>,
}

/// The paths in the cells of a region, in an increment of a `pace`; `None` where nothing is known.
///
/// `beyond` finds the drift of the last increment in the whole region, for cells outside the region of then.
pub fn slip_path(
    memory: &SolverMemory,
    state: &ContactState,
    (pace, region, ends): (Pace, Region, [Ends; 2]),
    beyond: impl FnOnce(&Before, &Drift) -> TangentialField,
) -> Option<SlipPath> {
    let last = memory.last.as_ref()?;
    let cells = state.pressure.dim().into();
    let parts = |TangentialField { x, y }: TangentialField| [x, y];
    let before = memory.before.as_ref();
    let then = before.and_then(|before| {
        let drift = before.drift.as_ref()?.on(cells, region);
        Some((parts(drift), region.gather(&before.tractions.pressure)))
    });
    let recent = Recent {
        region,
        zones: region.gather_map(&state.zone, |zone| *zone),
        drift: parts(last.drift.on(cells, region)),
        ratio: last.drift.ratio,
        knows_touch: last.drift.knows_touch,
        then,
        shear: [0, 1].map(|axis| region.gather(&state.shear[axis])),
        gaps: before.and_then(|before| Some([before.gap.as_ref()?, &last.gap])),
        ends,
    };
    let was_inside = |[i, j]: [usize; 2]| last.drift.region.is_some_and(|then| then.contains(i, j));
    let wide =
        || before.map_or_else(|| TangentialField::zeros(region.len()), |before| beyond(before, &last.drift));
    let Paths { turn: [x, y], ahead: [ahead_x, ahead_y], touch } =
        recent.paths(pace, &state.zone, was_inside, || parts(wide()));
    let (turn, ahead) = (TangentialField { x, y }, TangentialField { x: ahead_x, y: ahead_y });
    Some(SlipPath { turn, ahead, touch })
}

impl<R: Scalar + Send + Sync> Recent<'_, R> {
    /// The paths in the cells of the region, in an increment of a `pace`; `zones` are those of the whole grid.
    ///
    /// *Stop.* Cells that slipped; see [`STOP`], [`STOP_IN_GROWING`]. Nothing where slip does not fall, the whole of it where it falls to half,
    /// [`ENTERED`] of it where a cell has just entered, and nothing where the moment of its touch was not known. *Start.* Cells that stuck; see
    /// [`BEGUN`].
    /// *Entry.* Open cells; see [`Edge`].
    ///
    /// `was_inside`: where the drift of the last increment is known; `wide` finds it in the whole region, for cells where it is not.
    pub fn paths(
        &self,
        pace: Pace<R>,
        grid_zones: &Array2<Zone>,
        was_inside: impl Fn([usize; 2]) -> bool,
        wide: impl FnOnce() -> [Vec<R>; 2],
    ) -> Paths<R> {
        let Self { region, zones, drift, then, .. } = self;
        let region = *region;
        let zeros = || vec![R::of(0.0); region.len()];
        let mut paths = Paths { turn: [zeros(), zeros()], ahead: [zeros(), zeros()], touch: zeros() };
        let at = |field: &[Vec<R>; 2], cell: usize| [field[0][cell], field[1][cell]];
        let set = |field: &mut [Vec<R>; 2], cell: usize, [x, y]: [R; 2]| {
            (field[0][cell], field[1][cell]) = (x, y);
        };
        let slipping = (0..region.len()).filter(|&cell| zones[cell] == Zone::Slip);
        let largest = slipping.clone().map(|cell| length_of(at(drift, cell))).fold(R::of(0.0), larger);
        for cell in slipping {
            let then = match then {
                Some((_, pressure)) if pressure[cell] <= 0.0 && self.knows_touch => Then::Entered,
                Some((drift, pressure)) if pressure[cell] > 0.0 => Then::Slid(at(drift, cell)),
                _ => Then::Unknown,
            };
            if let Some([turn, ahead]) =
                path_after_slip(at(drift, cell), then, (pace.loads, self.ratio, largest), pace.grows)
            {
                set(&mut paths.turn, cell, turn);
                set(&mut paths.ahead, cell, ahead);
            }
        }
        let held = |cell: usize| at(&self.shear, cell);
        let largest_shear = (0..region.len()).map(|cell| length_of(held(cell))).fold(R::of(0.0), larger);
        for cell in (0..region.len()).filter(|&cell| zones[cell] == Zone::Stick) {
            if let Some(turn) = turn_after_stick(held(cell), largest_shear) {
                set(&mut paths.turn, cell, turn);
            }
        }
        let edge = self.gaps.zip(pace.edge);
        let edge = edge.map(|([before, now], ratio)| Edge { before, now, ratio, ends: self.ends });
        if let Some(edge) = edge {
            self.enter((pace, &edge), grid_zones, (was_inside, wide), &mut paths);
        }
        paths
    }

    /// The offsets of open cells, to which the edge comes.
    fn enter(
        &self,
        (pace, edge): (Pace<R>, &Edge<'_, R>),
        grid_zones: &Array2<Zone>,
        (was_inside, wide): (impl Fn([usize; 2]) -> bool, impl FnOnce() -> [Vec<R>; 2]),
        paths: &mut Paths<R>,
    ) {
        let Self { region, zones, drift, .. } = self;
        let [_, columns] = region.shape;
        let at = |cell: usize| [region.origin[0] + cell / columns, region.origin[1] + cell % columns];
        let entering_of = |cells: Range<usize>, _: [&mut [f64]; 0]| -> Vec<(usize, R)> {
            cells
                .filter(|&cell| zones[cell] == Zone::Open)
                .map(|cell| (cell, edge.moment_of_touch(at(cell))))
                .filter(|(_, moment)| moment.value() > 0.0)
                .collect()
        };
        let entering = in_portions((region.len(), NUMBERS), [], &entering_of).concat();
        let all_inside = entering.iter().all(|(cell, _)| was_inside(at(*cell)));
        let wide = if all_inside { None } else { Some(wide()) };
        let number = |[i, j]: [usize; 2]| (i - region.origin[0]) * columns + j - region.origin[1];
        let drift_at = |cell: usize| [drift[0][cell], drift[1][cell]];
        let slip_of = |at: [usize; 2]| {
            if grid_zones[at] == Zone::Slip { drift_at(number(at)) } else { [R::of(0.0); 2] }
        };
        let mut coming = SlipOfEdge::new(edge, grid_zones);
        let set = |field: &mut [Vec<R>; 2], cell: usize, [x, y]: [R; 2]| {
            (field[0][cell], field[1][cell]) = (x, y);
        };
        for (cell, moment) in entering {
            let touch = moment * pace.loads;
            let here = match &wide {
                Some([x, y]) if !was_inside(at(cell)) => [x[cell], y[cell]],
                _ => drift_at(cell),
            };
            let slid = coming.at(at(cell), &slip_of);
            set(&mut paths.ahead, cell, way_to_touch(touch, here, slid));
            paths.touch[cell] = moment;
        }
    }
}

/// What is known of a cell that slipped in the last increment from the one before that.
#[derive(Debug, Clone, Copy)]
pub enum Then<R> {
    /// Nothing.
    Unknown,
    /// It was open then, and the moment of its touch was known.
    Entered,
    /// Its drift [length].
    Slid([R; 2]),
}

/// Vector t and offset a of a cell that slipped, `here` its last drift; `loads` and `ratio` are the lengths of the increment and of the last one,
/// each over that of the one before it, `largest` the largest slip of all cells, and `grows` tells of the normal load. `None` where it did not
/// move.
pub fn path_after_slip<R: Scalar>(
    here: [R; 2],
    then: Then<R>,
    (loads, ratio, largest): (R, R, R),
    grows: bool,
) -> Option<[[R; 2]; 2]> {
    let fall = match then {
        Then::Entered => R::of(ENTERED),
        Then::Slid(drift) => fall(drift, here, ratio),
        Then::Unknown => R::of(0.0),
    };
    let weight = (length_of(here) / (largest * KNOWN)).min(R::of(1.0));
    let stop = if grows { STOP_IN_GROWING } else { STOP };
    path_that_goes_on(here, (loads, fall * stop, weight))
}

/// Vector t of a cell that stuck under a shear; `largest` is the largest of all cells. `None` without shear.
pub fn turn_after_stick<R: Scalar>(shear: [R; 2], largest: R) -> Option<[R; 2]> {
    let weight = (length_of(shear) / (largest * KNOWN)).min(R::of(1.0));
    turn_that_begins(shear, (BEGUN, weight))
}

/// Offset a of an open cell: how far it goes until the edge comes to it, after `touch` times the last increment; `here` its last drift, `slid` the
/// slip of the edge.
pub fn way_to_touch<R: Scalar>(touch: R, here: [R; 2], slid: [R; 2]) -> [R; 2] {
    let lag = left_of_lag(touch);
    [0, 1].map(|axis| touch * EDGE * slid[axis] + lag * (here[axis] - slid[axis]))
}

/// The larger of two numbers, the first where they are the same.
fn larger<R: Scalar>(one: R, other: R) -> R {
    if other.value() > one.value() { other } else { one }
}

/// By how much slip fell over the last two increments: 0 where it did not, 1 where it fell to half or less. `ratio` of their lengths.
fn fall<R: Scalar>(then: [R; 2], now: [R; 2], ratio: R) -> R {
    let (zero, one) = (R::of(0.0), R::of(1.0));
    let square = now[0] * now[0] + now[1] * now[1];
    let along = then[0] * now[0] + then[1] * now[1];
    if square.value() > 0.0 { (along * ratio / square - 1.0).max(zero).min(one) } else { zero }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of slip whose rate falls with the root of the time left, or evenly, at all moments of an increment in the mean.
    #[test]
    fn what_is_left_of_slip_that_stops() {
        let share = |power: f64| {
            let moments = (0..10_000).map(|k| (f64::from(k) + 0.5) / 1e4);
            let left: f64 = moments.clone().map(|t: f64| t.powf(power)).sum();
            let last: f64 = moments.map(|t: f64| (1.0 + t).powf(power) - t.powf(power)).sum();
            left / last
        };
        assert!((share(1.5) - STOP).abs() < 5e-3 && (share(2.0) - STOP_IN_GROWING).abs() < 1e-6);
    }

    /// The direction turns evenly, from that of the shear at the start of the increment; slip begins at any moment of it and grows with the
    /// power 3/2 of the time since.
    #[test]
    fn slip_that_begins_turns_on() {
        let moments = (0..10_000).map(|k| (f64::from(k) + 0.5) / 1e4);
        let turned = moments.map(|start| {
            let slip = |power: f64| (1.0_f64 - start).powf(power) / power;
            // Integral of the time over that of the rate: where the slip increment points.
            let mean = start + slip(2.5) / slip(1.5);
            1.0 / mean
        });
        assert!((turned.sum::<f64>() / 1e4 - BEGUN).abs() < 1e-3);
    }

    #[test]
    fn slip_that_halves_falls_wholly() {
        assert_eq!(fall([1.0, 0.0], [1.0, 0.0], 1.0), 0.0);
        assert_eq!(fall([2.0, 0.0], [1.0, 0.0], 1.0), 1.0);
        assert_eq!(fall([9.0, 0.0], [1.0, 0.0], 1.0), 1.0);
        assert!((fall([1.5, 7.0], [1.0, 0.0], 1.0) - 0.5).abs() < 1e-15);
        // The same rate in an increment of half the length.
        assert_eq!(fall([2.0, 0.0], [1.0, 0.0], 0.5), 0.0);
        assert_eq!(fall([-2.0, 0.0], [1.0, 0.0], 1.0), 0.0);
        assert_eq!(fall([2.0, 0.0], [0.0, 0.0], 1.0), 0.0);
    }
}
