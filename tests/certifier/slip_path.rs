//! The rule of second order as `docs/theory/second-order.md` states it, cell by cell: which slip the friction law of an increment is about,
//! and which of it counts.

use std::cell::OnceCell;

use fret_core::model::{Control, LoadStep, Zone};
use ndarray::Array2;

use super::measure::{dot, hypot};

/// What went before an increment: fields of the last two states, where they are known.
#[derive(Default)]
pub(super) struct Past {
    /// Along which axes the cells of one end are next to those of the other.
    pub(super) repeats: [bool; 2],
    /// Loads of the last increments, the newest last.
    pub(super) loads: Vec<LoadStep>,
    /// Change of the displacement of the upper surface over the lower in the last increment, and in that before.
    pub(super) drift: [Option<[Array2<f64>; 2]>; 2],
    /// Gap after the last increment, and before it.
    pub(super) gap: [Option<Array2<f64>>; 2],
    /// Pressure before the last increment.
    pub(super) pressure: Option<Array2<f64>>,
    pub(super) zone: Option<Array2<Zone>>,
    /// The slip of the edge in the last increment, carried outward to open cells; found when it is first wanted.
    pub(super) edge_slip: OnceCell<[Array2<f64>; 2]>,
    /// Shear traction after the last increment.
    pub(super) shear: Option<[Array2<f64>; 2]>,
    /// The largest change of displacement of cells that slipped in the last increment.
    pub(super) largest_slip: f64,
    /// Length of the last increment over that before.
    pub(super) ratio: f64,
    /// In the last increment the moments of touch were known.
    pub(super) knew_touch: bool,
    /// The gap has been changed since by wear: no increment goes on from there.
    pub(super) is_cut: bool,
}

/// The rule in one cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellPath {
    /// Offset of the slip.
    pub(super) ahead: [f64; 2],
    /// `sqrt(c) l`.
    turn: [f64; 2],
    /// The cell was open: its offset is no slip.
    is_open: bool,
    /// The moment at which it touches.
    touch: f64,
}

impl CellPath {
    pub(super) const STRAIGHT: Self = Self { ahead: [0.0; 2], turn: [0.0; 2], is_open: false, touch: 0.0 };

    /// The slip at the end of the increment, of a change of displacement.
    pub(super) fn end(&self, change: [f64; 2]) -> [f64; 2] {
        let rest = [change[0] - self.ahead[0], change[1] - self.ahead[1]];
        // Nothing from 60 degrees between the chords on.
        let along = (dot(rest, self.turn) - 0.5 * hypot(rest) * hypot(self.turn)).max(0.0);
        [rest[0] - along * self.turn[0], rest[1] - along * self.turn[1]]
    }

    /// The slip of a whole increment at the rate that a cell which has entered shows from its touch on.
    pub(super) fn rate(&self, change: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (change[axis] - self.ahead[axis]) / f64::max(1.0 - self.touch, 0.25))
    }

    /// The slip that counts, of a cell that slips or sticks at the end.
    pub(super) fn counted(&self, change: [f64; 2], zone: Zone) -> [f64; 2] {
        match (zone, self.is_open) {
            (Zone::Slip, true) => [0, 1].map(|axis| change[axis] - self.ahead[axis]),
            (Zone::Slip, false) => change,
            (_, true) => [0.0; 2],
            (_, false) => self.ahead,
        }
    }
}

/// How an increment goes on from the last.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// Its length over that of the last.
    ratio: f64,
    /// The same of the normal load, by which the edge of contact moves; `None` where that turns.
    pub(super) edge: Option<f64>,
    /// Whether the normal load grows.
    grows: bool,
}

impl Past {
    /// Length of an increment to `load` over that of the last, where it goes on in the direction of the last: increments of the four
    /// loads, with an angle below 60 degrees between them; 3 at the most.
    pub(super) fn ratio_to(&self, load: &LoadStep) -> Option<f64> {
        let [.., first, second] = self.loads[..] else { return None };
        if self.is_cut {
            return None;
        }
        let numbers = |step: &LoadStep| {
            let LoadStep { normal, tangential: [x, y], twist, tilt: [tilt_x, tilt_y], .. } = *step;
            [normal, x, y, twist, tilt_x, tilt_y]
        };
        let change = |from: &LoadStep, to: &LoadStep| {
            let mut found = [0.0; 10];
            for (found, pair) in found.iter_mut().zip(numbers(from).into_iter().zip(numbers(to))) {
                *found = match pair {
                    (Control::Force(a), Control::Force(b)) | (Control::Motion(a), Control::Motion(b)) => {
                        b - a
                    }
                    // No force and no motion are the same.
                    (a, b) if a.value() == 0.0 && b.value() == 0.0 => 0.0,
                    _ => return None,
                };
            }
            for (k, found) in found[6..].iter_mut().enumerate() {
                *found = to.bulk_stress[k / 2][k % 2] - from.bulk_stress[k / 2][k % 2];
            }
            Some(found)
        };
        let (old, new) = (change(&first, &second)?, change(&second, load)?);
        // Of the normal load, the tangential ones and the twist each by itself.
        let alike = matches!(
            load.tangential,
            [Control::Force(_), Control::Force(_)] | [Control::Motion(_), Control::Motion(_)]
        );
        let tangential: &[&[usize]] = if alike { &[&[1, 2]] } else { &[&[1], &[2]] };
        let (mut both, mut old_square, mut new_square) = (0.0, 0.0, 0.0);
        for group in tangential.iter().chain(&[&[0][..], &[3], &[4, 5], &[6, 7], &[8, 9]]) {
            let sum = |a: &[f64; 10], b: &[f64; 10]| group.iter().map(|&k| a[k] * b[k]).sum::<f64>();
            let unit = f64::max(sum(&old, &old), sum(&new, &new));
            if unit > 0.0 {
                both += sum(&old, &new) / unit;
                old_square += sum(&old, &old) / unit;
                new_square += sum(&new, &new) / unit;
            }
        }
        (both > 0.5 * f64::sqrt(old_square * new_square))
            .then(|| f64::min(f64::sqrt(new_square / old_square), 3.0))
    }

    /// The pace of an increment `ratio` times as long as the last: the edge of contact is taken to move by the ratio of the last two changes of
    /// the normal load, and nothing is known where that turns.
    pub(super) fn pace(&self, load: &LoadStep, ratio: f64) -> Pace {
        let change = |from: &LoadStep, to: &LoadStep| to.normal.value() - from.normal.value();
        let (old, new) = match self.loads[..] {
            [.., first, second] => (change(&first, &second), change(&second, load)),
            _ => (0.0, 0.0),
        };
        let edge = match old * new {
            product if product > 0.0 => Some(f64::min(new / old, 3.0)),
            _ => (old == 0.0 && new == 0.0).then_some(ratio),
        };
        Pace { ratio, edge, grows: new > 1e-9 * load.normal.value().abs() }
    }

    /// The rule of a cell.
    pub(super) fn path(&self, at: [usize; 2], Pace { ratio, edge, grows }: Pace) -> CellPath {
        let (Some(drift), Some(zone)) = (&self.drift[0], &self.zone) else { return CellPath::STRAIGHT };
        let last = [drift[0][at], drift[1][at]];
        match zone[at] {
            Zone::Stick => {
                let Some([x, y]) = &self.shear else { return CellPath::STRAIGHT };
                let shear = [x[at], y[at]];
                let size = hypot(shear);
                if size == 0.0 {
                    return CellPath::STRAIGHT;
                }
                let largest = x.iter().zip(y).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
                let known = f64::min(1.0, size / (0.01 * largest));
                let c = 1.0 - 1.0 / 1.277;
                CellPath {
                    turn: shear.map(|part| part / size * (known * c / (1.0 - 0.5)).sqrt()),
                    ..CellPath::STRAIGHT
                }
            }
            Zone::Slip => {
                let length = hypot(last);
                if length == 0.0 {
                    return CellPath::STRAIGHT;
                }
                let entered = self.pressure.as_ref().is_some_and(|pressure| pressure[at] == 0.0);
                let fall = match &self.drift[1] {
                    Some(_) if entered && self.knew_touch => 0.35,
                    Some(_) if entered => 0.0,
                    None => 0.0,
                    Some(then) => {
                        let rates = dot([then[0][at], then[1][at]], last) / length * self.ratio / length;
                        (rates - 1.0).clamp(0.0, 1.0)
                    }
                };
                let stop = fall * if grows { 1.0 / 6.0 } else { 0.27 };
                let known = f64::min(1.0, length / (0.01 * self.largest_slip));
                let c = 1.0 - (1.0 + ratio) / (1.0 + 2.0 * ratio) / (1.0 - stop);
                CellPath {
                    ahead: last.map(|part| part * ratio * stop),
                    turn: last.map(|part| part / length * (known * c.max(0.0) / (1.0 - 0.5)).sqrt()),
                    ..CellPath::STRAIGHT
                }
            }
            Zone::Open => {
                let open = CellPath { is_open: true, ..CellPath::STRAIGHT };
                let ([Some(gap), Some(gap_before)], Some(by_edge)) = (&self.gap, edge) else {
                    return open;
                };
                if gap_before[at] <= gap[at] {
                    return open;
                }
                let distance = |gap: f64| gap.max(0.0).powf(2.0 / 3.0);
                let now = distance(gap[at]);
                let touch = f64::min(1.0, now / ((distance(gap_before[at]) - now) * by_edge));
                let steps = touch * ratio;
                let slid = self.edge_slip.get_or_init(|| edge_slip((gap, zone), drift, self.repeats));
                let slid = [slid[0][at], slid[1][at]];
                let lag = steps.powf(1.5) / ((1.0 + steps).powf(1.5) - steps.powf(1.5));
                CellPath {
                    touch,
                    ahead: [0, 1].map(|axis| 0.7 * steps * slid[axis] + lag * (last[axis] - slid[axis])),
                    ..open
                }
            }
        }
    }
}

/// The slip of cells in contact, carried outward: cell by cell, from the least gap on, an open cell takes the mean of the neighbours that are
/// nearer to the contact, by how much nearer.
fn edge_slip(
    (gap, zone): (&Array2<f64>, &Array2<Zone>),
    drift: &[Array2<f64>; 2],
    repeats: [bool; 2],
) -> [Array2<f64>; 2] {
    let height = |at: [usize; 2]| match zone[at] {
        Zone::Open => gap[at].max(0.0).powf(2.0 / 3.0),
        _ => 0.0,
    };
    let mut open = Vec::new();
    let mut slid = [Array2::zeros(gap.dim()), Array2::zeros(gap.dim())];
    for ((i, j), zone) in zone.indexed_iter() {
        match zone {
            Zone::Open => open.push([i, j]),
            Zone::Slip => (0..2).for_each(|axis| slid[axis][[i, j]] = drift[axis][[i, j]]),
            Zone::Stick => {}
        }
    }
    open.sort_by(|a, b| height(*a).total_cmp(&height(*b)));
    for at in open {
        let (mut total, mut sums) = (0.0, [0.0; 2]);
        for (axis, step) in [(0, 1), (0, usize::MAX), (1, 1), (1, usize::MAX)] {
            let mut next = at;
            next[axis] = at[axis].wrapping_add(step);
            let cells = gap.shape()[axis];
            if repeats[axis] && next[axis] >= cells {
                next[axis] = if step == 1 { 0 } else { cells - 1 };
            }
            if gap.get(next).is_some() && height(next) < height(at) {
                let weight = height(at) - height(next);
                total += weight;
                (0..2).for_each(|axis| sums[axis] += weight * slid[axis][next]);
            }
        }
        if total > 0.0 {
            (0..2).for_each(|axis| slid[axis][at] = sums[axis] / total);
        }
    }
    slid
}
