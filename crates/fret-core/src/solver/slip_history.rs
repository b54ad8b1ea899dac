//! What the last two increments tell about the paths of slip in the next one.

use ndarray::Array2;

use super::laws::slip_path::SlipPath;
use super::memory::{Before, Drift, SolverMemory};
use super::region::Region;
use crate::fields::{TangentialField, length};
use crate::model::{ContactState, Zone};

/// Slip that cells have still to go when they come to rest, over that of the last increment, summed over all moments of the increment at
/// which they may: where the rate of slip falls with the root of the time left, as beside a stick zone that grows. Where it falls evenly,
/// that is 0.17. How it fades out, see [`fall`], is by trial.
const STOP: f64 = 0.27;
/// A cell that has just entered, whose slip is known from the moment of touch on only, counts so much as one whose slip falls.
const ENTERED: f64 = 0.5;
/// A cell that begins to slip has turned on over its slip by this factor from where the shear that held it points at the start of the increment
/// to the end, over to the slip increment: on average over all moments at which it may begin, with a rate of slip that grows with the root of
/// the time since then, as beside a stick zone that shrinks.
const BEGUN: f64 = 1.277;
/// The edge of contact goes on to slip by this fraction of its last rate until it comes to a cell. By trial: Spence's contact, and normal and
/// tangential force that grow together; with more, edges that slip in the coarse increments of a first touch go on to do so.
const EDGE: f64 = 0.7;
/// The direction of a slip increment, and of shear, is known where it is at least this fraction of the largest; below, the less the smaller.
const KNOWN: f64 = 0.01;

/// The paths in the cells of a region, in an increment that is `ratio` times as long as the last; `None` where nothing is known.
///
/// *Entry.* A gap grows with the power 3/2 of the distance to the edge of contact: that distance, and with it the moment of touch, is
/// extrapolated linearly from the gaps of the last two states. Up to that moment the cell goes on with the slip of the edge that comes, see
/// [`EDGE`], and with what it lags behind that, see [`left_of_lag`]. An edge that moves by less than half a cell in an increment says
/// nothing about moments; from a whole cell on it is believed.
///
/// *Start.* Cells that stick; see [`BEGUN`]. *Stop.* See [`STOP`]; nothing where slip does not fall, the whole of it where it falls to half,
/// half of it where a cell has just entered.
///
/// `beyond` finds the drift of the last increment in the whole region, for cells outside the region of then.
pub fn slip_path(
    memory: &SolverMemory,
    state: &ContactState,
    (ratio, region): (f64, Region),
    beyond: impl FnOnce(&Before, &Drift) -> TangentialField,
) -> Option<SlipPath> {
    let last = memory.last.as_ref()?;
    let cells = state.pressure.dim().into();
    let drift = last.drift.on(cells, region);
    let mut path = SlipPath::straight(region.len());
    let before = memory.before.as_ref();
    let then = before.and_then(|before| {
        let drift = before.drift.as_ref()?.on(cells, region);
        Some((drift, region.gather(&before.tractions.pressure)))
    });
    let zones = region.gather_map(&state.zone, |zone| *zone);
    let slip = |cell: usize| length(drift.at(cell));
    let slipping = (0..region.len()).filter(|&cell| zones[cell] == Zone::Slip);
    let largest = slipping.clone().map(slip).fold(0.0, f64::max);
    for cell in slipping {
        let here = drift.at(cell);
        let fall = match &then {
            Some((_, pressure)) if pressure[cell] <= 0.0 => ENTERED,
            Some((drift, _)) => fall(drift.at(cell), here, last.drift.ratio),
            None => 0.0,
        };
        let weight = (slip(cell) / (KNOWN * largest)).min(1.0);
        path.go_on(cell, here, (ratio, STOP * fall, weight));
    }
    let shear = [0, 1].map(|axis| region.gather(&state.shear[axis]));
    let held = |cell: usize| [shear[0][cell], shear[1][cell]];
    let largest_shear = (0..region.len()).map(|cell| length(held(cell))).fold(0.0, f64::max);
    for cell in (0..region.len()).filter(|&cell| zones[cell] == Zone::Stick) {
        let shear = held(cell);
        path.begin(cell, shear, (BEGUN, (length(shear) / (KNOWN * largest_shear)).min(1.0)));
    }
    if let Some((before, gap)) = before.and_then(|before| Some((before, before.gap.as_ref()?))) {
        let edge = Edge { before: gap, now: &last.gap, ratio };
        let [_, columns] = region.shape;
        let at = |cell: usize| [region.origin[0] + cell / columns, region.origin[1] + cell % columns];
        let entering: Vec<(usize, f64)> = (0..region.len())
            .filter(|&cell| zones[cell] == Zone::Open)
            .map(|cell| (cell, edge.moment_of_touch(at(cell)) * ratio))
            .filter(|(_, touch)| *touch > 0.0)
            .collect();
        let was_inside =
            |cell: usize| last.drift.region.is_some_and(|then| then.contains(at(cell)[0], at(cell)[1]));
        let all_inside = entering.iter().all(|(cell, _)| was_inside(*cell));
        let wide = if all_inside { None } else { Some(beyond(before, &last.drift)) };
        let number = |[i, j]: [usize; 2]| (i - region.origin[0]) * columns + j - region.origin[1];
        let mut beside = EdgeBeside::new(&edge, &state.zone);
        for (cell, touch) in entering {
            let here = wide.as_ref().filter(|_| !was_inside(cell)).unwrap_or(&drift).at(cell);
            let beside = beside.of(at(cell));
            let slides = state.zone[beside] == Zone::Slip;
            let slid = if slides { drift.at(number(beside)) } else { [0.0; 2] };
            let lag = left_of_lag(touch);
            path.ahead
                .set(cell, [0, 1].map(|axis| EDGE * touch * slid[axis] + lag * (here[axis] - slid[axis])));
        }
    }
    Some(path)
}

/// The edge of contact, on its way outward from a state to the next one and on.
struct Edge<'a> {
    /// Gap before the last increment, and after it [length].
    before: &'a Array2<f64>,
    now: &'a Array2<f64>,
    /// Length of the next increment over the last.
    ratio: f64,
}

impl Edge<'_> {
    /// The share of the next increment at which it comes to an open cell, 1 at the most; 0 where it does not move, and the nearer to 0 the
    /// less of a cell it moves.
    fn moment_of_touch(&self, at: [usize; 2]) -> f64 {
        if self.before[at] <= self.now[at] {
            return 0.0;
        }
        // Up to a factor.
        let distance = |gap: f64| gap.max(0.0).cbrt().powi(2);
        let [before, now] = [self.before[at], self.now[at]].map(distance);
        let way = (before - now) * self.ratio;
        let steepest =
            self.neighbours(at).map(|next| (distance(self.now[next]) - now).abs()).fold(0.0, f64::max);
        let is_believed = (2.0 * way / steepest - 1.0).clamp(0.0, 1.0);
        is_believed * (now / way).min(1.0)
    }

    /// The neighbour with the least gap, if that is less than here.
    fn down(&self, at: [usize; 2]) -> Option<[usize; 2]> {
        let lowest = self.neighbours(at).min_by(|a, b| self.now[*a].total_cmp(&self.now[*b]));
        lowest.filter(|lowest| self.now[*lowest] < self.now[at])
    }

    fn neighbours(&self, [i, j]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
        let (nx, ny) = self.now.dim();
        let all = [
            (i > 0, i.wrapping_sub(1), j),
            (i + 1 < nx, i + 1, j),
            (j > 0, i, j.wrapping_sub(1)),
            (j + 1 < ny, i, j + 1),
        ];
        all.into_iter().filter(|(exists, ..)| *exists).map(|(_, i, j)| [i, j])
    }
}

/// The cell of the edge that comes to an open cell: the first in contact on the way from neighbour to neighbour down the gap. Where that way
/// ends before, the open cell at its end.
struct EdgeBeside<'a> {
    edge: &'a Edge<'a>,
    zones: &'a Array2<Zone>,
    /// What was found, of all cells on the ways so far.
    found: Array2<Option<[usize; 2]>>,
    way: Vec<[usize; 2]>,
}

impl<'a> EdgeBeside<'a> {
    fn new(edge: &'a Edge<'a>, zones: &'a Array2<Zone>) -> Self {
        Self { edge, zones, found: Array2::default(zones.dim()), way: Vec::new() }
    }

    fn of(&mut self, mut at: [usize; 2]) -> [usize; 2] {
        self.way.clear();
        let end = loop {
            if let Some(end) = self.found[at] {
                break end;
            }
            match self.edge.down(at).filter(|_| self.zones[at] == Zone::Open) {
                Some(next) => {
                    self.way.push(at);
                    at = next;
                }
                None => break at,
            }
        };
        for at in &self.way {
            self.found[*at] = Some(end);
        }
        end
    }
}

/// What an open cell goes on to lag behind the edge until that comes to it, over how it lagged in the last increment: at the distance x from a
/// contact that moves as a whole the displacement lags by the root of x (Mindlin 1949), so that over the last way, from `1 + touch` steps
/// of the edge away to `touch`, and over what is left the lags go with the power 3/2.
fn left_of_lag(touch: f64) -> f64 {
    let left = touch.powf(1.5);
    left / ((1.0 + touch).powf(1.5) - left)
}

/// By how much slip fell over the last two increments: 0 where it did not, 1 where it fell to half or less. `ratio` of their lengths.
fn fall(then: [f64; 2], now: [f64; 2], ratio: f64) -> f64 {
    let square = now[0] * now[0] + now[1] * now[1];
    let along = then[0] * now[0] + then[1] * now[1];
    if square > 0.0 { (along * ratio / square - 1.0).clamp(0.0, 1.0) } else { 0.0 }
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
        assert!((share(1.5) - STOP).abs() < 5e-3 && (share(2.0) - 1.0 / 6.0).abs() < 1e-3);
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

    /// An edge that goes on by 3 cells an increment, seen from 0.9 cells outside: it comes after 0.3 of an increment, 0.6 of half a one;
    /// an edge that moves by 0.4 cells says nothing.
    #[test]
    fn the_edge_comes_at_its_speed() {
        let gap =
            |edge: f64| Array2::from_shape_fn((12, 1), |(i, _)| 7.0 * (i as f64 - edge).max(0.0).powf(1.5));
        let moment = |before: f64, now: f64, ratio: f64, cell: usize| {
            Edge { before: &gap(before), now: &gap(now), ratio }.moment_of_touch([cell, 0])
        };
        assert!((moment(2.1, 5.1, 1.0, 6) - 0.3).abs() < 1e-14);
        assert!((moment(2.1, 5.1, 0.5, 6) - 0.6).abs() < 1e-14);
        assert_eq!(moment(2.1, 5.1, 1.0, 9), 1.0);
        assert_eq!(moment(4.7, 5.1, 1.0, 6), 0.0);
        assert_eq!(moment(5.1, 4.1, 1.0, 6), 0.0);
    }

    /// A disc that sticks and grows with the square of the time, in even steps of its radius a: beside it the displacement of the surface is
    /// `(2/pi) asin(a/r)` of that of the disc (Mindlin 1949), so that a place at r has lagged behind by the integral of the rest.
    #[test]
    fn beside_a_growing_disc_that_sticks_the_way_to_touch_is_found() {
        let lag = |from: f64, to: f64, r: f64| {
            let sum = |k: u32| {
                let a = from + (to - from) * (f64::from(k) + 0.5) / 1e4;
                a * (1.0 - std::f64::consts::FRAC_2_PI * (a / r).asin())
            };
            (0..10_000).map(sum).sum::<f64>() * (to - from) / 1e4
        };
        for step in [0.1, 0.05] {
            for touch in [0.2, 0.5, 0.8, 1.0] {
                let r = 1.0 + touch * step;
                let [last, left] = [lag(1.0 - step, 1.0, r), lag(1.0, r, r)];
                // What a load that does not grow evenly adds is of the order of the step.
                assert!((left_of_lag(touch) / (left / last) - 1.0).abs() < 1.2 * step, "{step} {touch}");
            }
        }
    }

    #[test]
    fn the_edge_that_comes_is_down_the_gap() {
        let gap = |i: usize, j: usize| ((i as f64 - 4.0).hypot(j as f64 - 4.0) - 2.0).max(0.0).powf(1.5);
        let gap = Array2::from_shape_fn((9, 9), |(i, j)| gap(i, j));
        let zones = gap.map(|gap| if *gap > 0.0 { Zone::Open } else { Zone::Stick });
        let edge = Edge { before: &gap, now: &gap, ratio: 1.0 };
        let mut beside = EdgeBeside::new(&edge, &zones);
        // The second and the last lie on ways that were gone before, or are the edge.
        let from = [[0, 4], [1, 4], [4, 8], [7, 4], [6, 4]];
        assert_eq!(from.map(|at| beside.of(at)), [[2, 4], [2, 4], [4, 6], [6, 4], [6, 4]]);
        let corner = beside.of([8, 8]);
        assert!([[5, 5], [4, 6], [6, 4]].contains(&corner), "{corner:?}");
        // No contact anywhere: the lowest place of the gap, which is open.
        let open = zones.map(|_| Zone::Open);
        assert_eq!(gap[EdgeBeside::new(&edge, &open).of([0, 0])], 0.0);
    }
}
