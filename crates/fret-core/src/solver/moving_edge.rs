//! The edge of contact on its way over open cells: when it comes to one, with which slip, and how that lags behind.

use ndarray::Array2;

use super::ends::Ends;
use crate::fields::Scalar;
use crate::model::Zone;

/// The edge of contact, on its way outward from a state to the next one and on.
///
/// A gap grows with the power 3/2 of the distance to the edge of contact: that distance, and with it the moment of touch, is extrapolated
/// linearly in the normal load from the gaps of the last two states. Up to that moment the cell goes on with the slip of the edge that
/// comes, see [`EDGE`], and with what it lags behind that, see [`left_of_lag`].
pub struct Edge<'a, R> {
    /// Gap before the last increment, and after it [length].
    pub before: &'a Array2<R>,
    pub now: &'a Array2<R>,
    /// Length of the next increment over the last, in the normal load.
    pub ratio: R,
    /// What lies beyond the first and the last cells of both axes.
    pub ends: [Ends; 2],
}

impl<R: Scalar> Edge<'_, R> {
    /// The fraction of the next increment at which it comes to an open cell, 1 at the most; 0 where it does not come nearer.
    pub fn moment_of_touch(&self, at: [usize; 2]) -> R {
        if self.before[at].value() <= self.now[at].value() {
            return R::of(0.0);
        }
        moment_of_touch([self.before[at], self.now[at]], self.ratio)
    }

    /// The four next cells; an outermost cell is its own neighbour where there is none.
    fn neighbours(&self, [i, j]: [usize; 2]) -> [[usize; 2]; 4] {
        let (nx, ny) = self.now.dim();
        let ([left, _, right], [below, _, above]) = (self.ends[0].around(i, nx), self.ends[1].around(j, ny));
        [[left, j], [right, j], [i, below], [i, above]]
    }
}

/// The fraction of an increment at which the edge comes to an open cell whose gap has become smaller, 1 at the most: from its gaps before the last
/// increment and after it, and the `ratio` of both increments in the normal load.
pub fn moment_of_touch<R: Scalar>(gaps: [R; 2], ratio: R) -> R {
    let [before, now] = gaps.map(distance);
    (now / ((before - now) * ratio)).min(R::of(1.0))
}

/// Distance of an open cell from the edge of contact, up to a factor.
pub fn distance<R: Scalar>(gap: R) -> R {
    let root = gap.max(R::of(0.0)).cube_root();
    root * root
}

/// The slip of the edge that comes to an open cell: that of cells in contact, carried outward along the gradient of the distance (extension of
/// velocities, Adalsteinsson & Sethian 1999). An open cell has the mean of its neighbours that are nearer to the contact, each weighted by
/// how much nearer it is, so that no choice between equal neighbours is left to rounding; zero where there are none.
pub struct SlipOfEdge<'a, R> {
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
    pub fn new(edge: &'a Edge<'a, R>, zones: &'a Array2<Zone>) -> Self {
        let distances = Array2::from_elem(zones.dim(), R::of(0.0));
        let found = Array2::from_elem(zones.dim(), None);
        Self { edge, zones, distances, found, waiting: Vec::new() }
    }

    /// At an open cell; `slip_of` a cell in contact [length].
    pub fn at(&mut self, at: [usize; 2], slip_of: &impl Fn([usize; 2]) -> [R; 2]) -> [R; 2] {
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
            for (next, weight) in nearer.into_iter().filter(|(_, weight)| weight.value() > 0.0) {
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

/// An open cell, its slip, and its neighbours that are nearer to the contact, each with its weight.
pub struct MeanOfNearer {
    pub cell: [usize; 2],
    pub slip: [f64; 2],
    pub nearer: Vec<([usize; 2], f64)>,
}

impl SlipOfEdge<'_, f64> {
    /// How the slip of all open cells was found that was, those nearest to the contact first.
    pub fn means(&self) -> Vec<MeanOfNearer> {
        let found = self.found.indexed_iter().filter_map(|((i, j), slip)| Some(([i, j], (*slip)?)));
        let of = |(cell, slip)| {
            let nearer = self.edge.neighbours(cell);
            let weight = |next: [usize; 2]| (next, self.distances[cell] - self.distances[next]);
            let nearer = nearer.into_iter().map(weight).filter(|(_, weight)| *weight > 0.0).collect();
            MeanOfNearer { cell, slip, nearer }
        };
        let mut means: Vec<MeanOfNearer> = found.map(of).collect();
        means.sort_by(|a, b| self.distances[a.cell].total_cmp(&self.distances[b.cell]));
        means
    }
}

/// What an open cell goes on to lag behind the edge until that comes to it, over how it lagged in the last increment: at the distance x from a
/// contact that moves as a whole the displacement lags by the root of x (Mindlin 1949), so that over the last way, from `1 + touch` steps
/// of the edge away to `touch`, and over what is left the lags go with the power 3/2.
pub fn left_of_lag<R: Scalar>(touch: R) -> R {
    let left = touch.power(1.5);
    left / ((touch + 1.0).power(1.5) - left)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge that goes on by 3 cells an increment, seen from 0.9 cells outside: it comes after 0.3 of an increment, 0.6 of half a one. One
    /// that goes on by 0.4 cells, seen from 0.3 and from 0.9: after 0.75 of it, and not in it.
    #[test]
    fn the_edge_comes_at_its_speed() {
        let gap =
            |edge: f64| Array2::from_shape_fn((12, 1), |(i, _)| 7.0 * (i as f64 - edge).max(0.0).powf(1.5));
        let moment = |before: f64, now: f64, ratio: f64, cell: usize| {
            Edge { before: &gap(before), now: &gap(now), ratio, ends: [Ends::Open; 2] }
                .moment_of_touch([cell, 0])
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
        let edge = Edge { before: &gap, now: &gap, ratio: 1.0, ends: [Ends::Open; 2] };
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
