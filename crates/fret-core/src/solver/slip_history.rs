//! What the last two increments tell about the paths of slip in the next one.

use ndarray::Array2;

use super::laws::slip_path::SlipPath;
use super::memory::{Before, Drift, SolverMemory};
use super::region::Region;
use crate::fields::TangentialField;
use crate::model::{ContactState, Zone};

/// A cell whose slip falls by half or more from increment to increment has, when it comes to rest, gone on by this fraction of its last
/// slip on average. By trial: Spence's contact and loops (`docs/theory/second-order.md`); 0.125 and 0.17 do nearly as well.
const STOP: f64 = 0.15;
/// What slows down before it touches goes on to touch by this fraction of what its last rate says. By trial: the displacement at touch in
/// Spence's contact.
const ENTRY: f64 = 0.85;
/// The direction of a slip increment is known where it is at least this fraction of the largest; below, the less the smaller.
const KNOWN: f64 = 0.01;

/// The paths in the cells of a region, in an increment that is `ratio` times as long as the last; `None` where nothing is known.
///
/// *Entry.* A gap grows with the power 3/2 of the distance to the edge of contact: that distance, and with it the moment of touch, is
/// extrapolated linearly from the gaps of the last two states. Up to that moment the cell goes on as in the last increment, see [`ENTRY`].
/// An edge that moves by less than half a cell in an increment says nothing about moments; from a whole cell on it is believed.
///
/// *Stop.* See [`STOP`]; nothing where slip does not fall, the whole of it where it falls to half, and where a cell has just entered.
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
    let slip = |cell: usize| drift.at(cell)[0].hypot(drift.at(cell)[1]);
    let slipping = (0..region.len()).filter(|&cell| zones[cell] == Zone::Slip);
    let largest = slipping.clone().map(slip).fold(0.0, f64::max);
    for cell in slipping {
        let here = drift.at(cell);
        let fall = match &then {
            Some((_, pressure)) if pressure[cell] <= 0.0 => 1.0,
            Some((drift, _)) => fall(drift.at(cell), here, last.drift.ratio),
            None => 0.0,
        };
        let weight = (slip(cell) / (KNOWN * largest)).min(1.0);
        path.go_on(cell, here, (ratio, STOP * fall, weight));
    }
    if let Some((before, gap)) = before.and_then(|before| Some((before, before.gap.as_ref()?))) {
        let edge = Edge { before: gap, now: &last.gap, ratio };
        let [_, columns] = region.shape;
        let at = |cell: usize| [region.origin[0] + cell / columns, region.origin[1] + cell % columns];
        let entering: Vec<(usize, f64)> = (0..region.len())
            .filter(|&cell| zones[cell] == Zone::Open)
            .map(|cell| (cell, ENTRY * edge.moment_of_touch(at(cell)) * ratio))
            .filter(|(_, share)| *share > 0.0)
            .collect();
        let was_inside =
            |cell: usize| last.drift.region.is_some_and(|then| then.contains(at(cell)[0], at(cell)[1]));
        let all_inside = entering.iter().all(|(cell, _)| was_inside(*cell));
        let wide = if all_inside { None } else { Some(beyond(before, &last.drift)) };
        for (cell, share) in entering {
            let here = wide.as_ref().filter(|_| !was_inside(cell)).unwrap_or(&drift).at(cell);
            path.ahead.set(cell, here.map(|part| share * part));
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

/// By how much slip fell over the last two increments: 0 where it did not, 1 where it fell to half or less. `ratio` of their lengths.
fn fall(then: [f64; 2], now: [f64; 2], ratio: f64) -> f64 {
    let square = now[0] * now[0] + now[1] * now[1];
    let along = then[0] * now[0] + then[1] * now[1];
    if square > 0.0 { (along * ratio / square - 1.0).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
