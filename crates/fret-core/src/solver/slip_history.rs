//! What the last two increments tell about the paths of slip in the next one.

use super::laws::slip_path::SlipPath;
use super::memory::SolverMemory;
use super::region::Region;
use crate::model::{ContactState, Zone};

/// A cell whose slip falls by half or more from increment to increment has, when it comes to rest, gone on by this fraction of its last
/// slip on average. By trial: Spence's contact and loops (`docs/theory/second-order.md`); 0.125 and 0.17 do nearly as well.
const STOP: f64 = 0.15;

/// The paths in the cells of a region, in an increment that is `ratio` times as long as the last; `None` where nothing is known.
///
/// *Entry.* A gap grows with the power 3/2 of the distance to the edge of contact: that distance, and with it the moment of touch, is
/// carried on linearly from the gaps of the last two states. The displacement at touch is that of the parabola through the last two
/// states and the end of the increment: with touch at the share t of the increment, of equal steps, `w(1) - w(t)` is
/// `(1 - t) (1 + t/2) (s - k s_last)`, `k = t / (2 + t)`.
///
/// *Stop.* See [`STOP`]; nothing where slip does not fall, the whole of it where it falls to half, and where a cell has just entered.
pub fn slip_path(
    memory: &SolverMemory,
    state: &ContactState,
    ratio: f64,
    region: Region,
) -> Option<SlipPath> {
    let last = memory.last.as_ref()?;
    let cells = state.pressure.dim().into();
    let drift = last.drift.on(cells, region);
    let mut path = SlipPath::straight(region.len());
    let before = memory.before.as_ref();
    let drift_before = before.and_then(|before| before.drift.as_ref()).map(|drift| drift.on(cells, region));
    let pressure_before = before.map(|before| region.gather(&before.tractions.pressure));
    let gap_before = before.and_then(|before| before.gap.as_ref()).map(|gap| region.gather(gap));
    let gap = region.gather(&last.gap);
    for (cell, zone) in region.gather_map(&state.zone, |zone| *zone).into_iter().enumerate() {
        let here = drift.at(cell);
        match zone {
            Zone::Stick => {}
            Zone::Slip => {
                let entered = pressure_before.as_ref().is_some_and(|pressure| pressure[cell] <= 0.0);
                let fall = match &drift_before {
                    _ if entered => 1.0,
                    Some(then) => fall(then.at(cell), here, last.drift.ratio),
                    None => 0.0,
                };
                path.go_on(cell, here, (ratio, STOP * fall));
            }
            Zone::Open => {
                if let Some(before) = &gap_before
                    && before[cell] > gap[cell]
                {
                    let touch = moment_of_touch(before[cell], gap[cell].max(0.0), ratio);
                    let ahead = ratio * touch / (2.0 + touch);
                    path.ahead.set(cell, here.map(|part| ahead * part));
                    path.touching[cell] = (1.0 - touch) * (1.0 + 0.5 * touch);
                }
            }
        }
    }
    Some(path)
}

/// By how much slip fell over the last two increments: 0 where it did not, 1 where it fell to half or less. `ratio` of their lengths.
fn fall(then: [f64; 2], now: [f64; 2], ratio: f64) -> f64 {
    let square = now[0] * now[0] + now[1] * now[1];
    let along = then[0] * now[0] + then[1] * now[1];
    if square > 0.0 { (along * ratio / square - 1.0).clamp(0.0, 1.0) } else { 0.0 }
}

/// The share of an increment at which a gap closes that fell from `before` to `now` in the last one; 1 at the most.
fn moment_of_touch(before: f64, now: f64, ratio: f64) -> f64 {
    // Distance to the edge in units of what it went in the last increment.
    let [before, now] = [before, now].map(|gap| gap.cbrt().powi(2));
    (now / (before - now) / ratio).min(1.0)
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

    /// An edge that goes on by 0.3 an increment reaches a cell 0.09 outside after 0.3 of it, half as long an increment later.
    #[test]
    fn the_edge_comes_at_its_speed() {
        let gap = |distance: f64| 7.0 * distance.powf(1.5);
        assert!((moment_of_touch(gap(0.39), gap(0.09), 1.0) - 0.3).abs() < 1e-14);
        assert!((moment_of_touch(gap(0.39), gap(0.09), 0.5) - 0.6).abs() < 1e-14);
        assert_eq!(moment_of_touch(gap(0.8), gap(0.5), 1.0), 1.0);
        assert_eq!(moment_of_touch(gap(0.3), 0.0, 1.0), 0.0);
    }
}
