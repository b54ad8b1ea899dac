//! What the last two increments tell about the paths of slip in the next one.

use std::ops::Range;

use ndarray::Array2;

use super::laws::slip_path::{SlipPath, path_that_goes_on, turn_that_begins};
use super::memory::{Before, Drift, SolverMemory};
use super::pace::Pace;
use super::region::Region;
use crate::fields::{Scalar, TangentialField, in_portions, length_of};
use crate::model::{ContactState, Zone};

/// Slip that cells have still to go when they come to rest, over that of the last increment, summed over all moments of the increment at
/// which they may: where the rate of slip falls with the root of the time left, as beside a stick zone that grows. Where it falls evenly,
/// that is 0.17. How it fades out, see [`fall`], is by trial.
const STOP: f64 = 0.27;
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
    (pace, region): (Pace, Region),
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
    /// *Stop.* Cells that slipped; see [`STOP`]. Nothing where slip does not fall, the whole of it where it falls to half, [`ENTERED`]
    /// of it where a cell has just entered, and nothing where the moment of its touch was not known. *Start.* Cells that stuck; see [`BEGUN`].
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
        let slip = |cell: usize| length_of(at(drift, cell));
        let slipping = (0..region.len()).filter(|&cell| zones[cell] == Zone::Slip);
        let largest = slipping.clone().map(slip).fold(R::of(0.0), larger);
        for cell in slipping {
            let here = at(drift, cell);
            let fall = match then {
                Some((_, pressure)) if pressure[cell] <= 0.0 && self.knows_touch => R::of(ENTERED),
                Some((drift, pressure)) if pressure[cell] > 0.0 => fall(at(drift, cell), here, self.ratio),
                _ => R::of(0.0),
            };
            let weight = (slip(cell) / (largest * KNOWN)).min(R::of(1.0));
            if let Some([turn, ahead]) = path_that_goes_on(here, (pace.loads, fall * STOP, weight)) {
                set(&mut paths.turn, cell, turn);
                set(&mut paths.ahead, cell, ahead);
            }
        }
        let held = |cell: usize| at(&self.shear, cell);
        let largest_shear = (0..region.len()).map(|cell| length_of(held(cell))).fold(R::of(0.0), larger);
        for cell in (0..region.len()).filter(|&cell| zones[cell] == Zone::Stick) {
            let shear = held(cell);
            let weight = (length_of(shear) / (largest_shear * KNOWN)).min(R::of(1.0));
            if let Some(turn) = turn_that_begins(shear, (BEGUN, weight)) {
                set(&mut paths.turn, cell, turn);
            }
        }
        let edge = self.gaps.zip(pace.edge).map(|([before, now], ratio)| Edge { before, now, ratio });
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
        for (cell, moment) in entering {
            let touch = moment * pace.loads;
            let here = match &wide {
                Some([x, y]) if !was_inside(at(cell)) => [x[cell], y[cell]],
                _ => drift_at(cell),
            };
            let slid = coming.at(at(cell), &slip_of);
            let lag = left_of_lag(touch);
            for axis in 0..2 {
                paths.ahead[axis][cell] = touch * EDGE * slid[axis] + lag * (here[axis] - slid[axis]);
            }
            paths.touch[cell] = moment;
        }
    }
}

/// The larger of two numbers, the first where they are the same.
fn larger<R: Scalar>(one: R, other: R) -> R {
    if other.value() > one.value() { other } else { one }
}

/// The edge of contact, on its way outward from a state to the next one and on.
///
/// A gap grows with the power 3/2 of the distance to the edge of contact: that distance, and with it the moment of touch, is extrapolated
/// linearly in the normal load from the gaps of the last two states. Up to that moment the cell goes on with the slip of the edge that
/// comes, see [`EDGE`], and with what it lags behind that, see [`left_of_lag`].
struct Edge<'a, R> {
    /// Gap before the last increment, and after it [length].
    before: &'a Array2<R>,
    now: &'a Array2<R>,
    /// Length of the next increment over the last, in the normal load.
    ratio: R,
}

impl<R: Scalar> Edge<'_, R> {
    /// The fraction of the next increment at which it comes to an open cell, 1 at the most; 0 where it does not come nearer.
    fn moment_of_touch(&self, at: [usize; 2]) -> R {
        if self.before[at].value() <= self.now[at].value() {
            return R::of(0.0);
        }
        let [before, now] = [self.before[at], self.now[at]].map(distance);
        (now / ((before - now) * self.ratio)).min(R::of(1.0))
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

/// Distance of an open cell from the edge of contact, up to a factor.
fn distance<R: Scalar>(gap: R) -> R {
    let root = gap.max(R::of(0.0)).cube_root();
    root * root
}

/// The slip of the edge that comes to an open cell: that of cells in contact, carried outward along the gradient of the distance (extension of
/// velocities, Adalsteinsson & Sethian 1999). An open cell has the mean of its neighbours that are nearer to the contact, each weighted by
/// how much nearer it is, so that no choice between equal neighbours is left to rounding; zero where there are none.
struct SlipOfEdge<'a, R> {
    edge: &'a Edge<'a, R>,
    zones: &'a Array2<Zone>,
    /// Distances of open cells from the edge that were found, up to a factor.
    distances: Array2<R>,
    /// Slip that was found.
    found: Array2<Option<[R; 2]>>,
    /// Cells that wait for others nearer to the contact.
    waiting: Vec<[usize; 2]>,
}

impl<'a, R: Scalar> SlipOfEdge<'a, R> {
    fn new(edge: &'a Edge<'a, R>, zones: &'a Array2<Zone>) -> Self {
        let distances = Array2::from_elem(zones.dim(), R::of(0.0));
        let found = Array2::from_elem(zones.dim(), None);
        Self { edge, zones, distances, found, waiting: Vec::new() }
    }

    /// At an open cell; `slip_of` a cell in contact [length].
    fn at(&mut self, at: [usize; 2], slip_of: &impl Fn([usize; 2]) -> [R; 2]) -> [R; 2] {
        let Self { edge, zones, distances, found, waiting } = self;
        let mut height = |at: [usize; 2]| {
            let known = &mut distances[at];
            if known.value() == 0.0 && zones[at] == Zone::Open {
                *known = distance(edge.now[at]);
            }
            *known
        };
        waiting.push(at);
        while let Some(&here) = waiting.last() {
            let ours = height(here);
            let nearer = edge.neighbours(here).map(|next| (next, ours - height(next)));
            let (mut slid, mut weights, known) = ([R::of(0.0); 2], R::of(0.0), waiting.len());
            for (next, weight) in nearer.filter(|(_, weight)| weight.value() > 0.0) {
                let there = if zones[next] == Zone::Open { found[next] } else { Some(slip_of(next)) };
                match there {
                    Some(there) => {
                        weights = weights + weight;
                        slid = [0, 1].map(|axis| slid[axis] + weight * there[axis]);
                    }
                    None => waiting.push(next),
                }
            }
            if waiting.len() == known {
                let mean = if weights.value() > 0.0 { slid.map(|part| part / weights) } else { slid };
                found[here] = Some(mean);
                waiting.pop();
            }
        }
        found[at].unwrap_or([R::of(0.0); 2])
    }
}

/// What an open cell goes on to lag behind the edge until that comes to it, over how it lagged in the last increment: at the distance x from a
/// contact that moves as a whole the displacement lags by the root of x (Mindlin 1949), so that over the last way, from `1 + touch` steps
/// of the edge away to `touch`, and over what is left the lags go with the power 3/2.
fn left_of_lag<R: Scalar>(touch: R) -> R {
    let left = touch.power(1.5);
    left / ((touch + 1.0).power(1.5) - left)
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

    /// An edge that goes on by 3 cells an increment, seen from 0.9 cells outside: it comes after 0.3 of an increment, 0.6 of half a one. One
    /// that goes on by 0.4 cells, seen from 0.3 and from 0.9: after 0.75 of it, and not in it.
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
        assert!((moment(5.3, 5.7, 1.0, 6) - 0.75).abs() < 1e-13);
        assert_eq!(moment(4.7, 5.1, 1.0, 6), 1.0);
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

    /// Around a disc whose edge slips as the cosine and the sine of the angle: the slip outside is that in the same
    /// direction, and the same image in mirrors and across the diagonal. Cells without contact down the gap have none.
    #[test]
    fn the_slip_of_the_edge_is_carried_outward() {
        const CELLS: usize = 60;
        let centre = 29.5;
        let from = |[i, j]: [usize; 2]| [i as f64 - centre, j as f64 - centre];
        let gap = Array2::from_shape_fn((CELLS, CELLS), |(i, j)| {
            let [x, y] = from([i, j]);
            (x.hypot(y) - 15.0).max(0.0).powf(1.5)
        });
        let zones = gap.map(|gap| if *gap > 0.0 { Zone::Open } else { Zone::Slip });
        let edge = Edge { before: &gap, now: &gap, ratio: 1.0 };
        let radial = |at: [usize; 2]| {
            let [x, y] = from(at);
            [x / x.hypot(y), y / x.hypot(y)]
        };
        let mut coming = SlipOfEdge::new(&edge, &zones);
        for at in [[50, 29], [45, 45], [55, 40], [10, 20], [45, 30]] {
            let (found, expected) = (coming.at(at, &radial), radial(at));
            // Smoothed over the neighbours on the way, and by the steps of the disc.
            assert!((0..2).all(|axis| (found[axis] - expected[axis]).abs() < 0.05), "{at:?} {found:?}");
            let [i, j] = at;
            let (mirrored, turned) = (coming.at([CELLS - 1 - i, j], &radial), coming.at([j, i], &radial));
            assert!((found[0] + mirrored[0]).abs() < 1e-14 && (found[1] - mirrored[1]).abs() < 1e-14);
            assert!((found[0] - turned[1]).abs() < 1e-14 && (found[1] - turned[0]).abs() < 1e-14);
        }
        let open = zones.map(|_| Zone::Open);
        assert_eq!(SlipOfEdge::new(&edge, &open).at([0, 0], &radial), [0.0; 2]);
    }
}
