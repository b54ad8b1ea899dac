//! The path of slip inside an increment: which part of it the increment's equations do not see, to second order in the increments.
//!
//! The friction law holds at the end of the increment, by the slip rate there. The end-point rule (backward Euler) takes for it the
//! change of displacement over the whole increment, and errs to first order in four ways: slip turns on its way; cells that come into
//! contact count a way that they went before they touched; cells that come to rest have slipped before that; cells that begin to slip
//! turn from where the shear that held them points. Here the law takes
//!
//! ```text
//! s_end = v - t max(v . t - k |v| |t|, 0),    v = s - a
//! ```
//!
//! with `s` the change of displacement in the increment, and `t` and `a` known before the increment is solved.
//!
//! *Turn:* the direction of a slip increment is that of the slip rate in its middle, to second order. Extrapolated linearly from the middle
//! of the last increment over the middle of this one to its end, the direction turns on by `rho / (1 + rho)` of the angle between the two
//! increments, rho the ratio of this one to the last. With the unit direction `l` of the last slip increment, `c = rho / (1 + 2 rho)` and
//! `t = l sqrt(c / (1 - k))` the tangent of a small angle to l grows by `1 / (1 - c)`, which is that; beyond an angle of cosine `k`
//! nothing is turned. The rule is continuous and of degree one. *Entry and stop* are offsets `a`, *start* another l and c: see
//! `slip_history`. An offset along l turns too, and c is the smaller for it. The way of slip is longer than its increment: see
//! [`length_of_way`]. The rule is new; its derivation and its measured orders: `docs/theory/second-order.md`.

use super::super::contact_set::ContactSet;
use crate::fields::{Reals, Scalar, TangentialField, length, length_of};
use crate::model::{Integration, Zone};

/// Cosine k of the angle between slip increments (60 degrees) from which on the last one says nothing of this one: the angle from which on the
/// loads do not continue either. By trial: without it the discrete equations have several solutions much more often; 40 and 50
/// degrees err more and take more applications.
const FADED: f64 = 0.5;

/// A cell that comes into contact shows its rate of slip from the moment of touch on; less of the increment than this counts for so much.
const LEAST_LEFT: f64 = 0.25;

/// What is known of the paths before an increment is solved, over the cells of a region or packed over a contact. With empty fields it is
/// the end-point rule.
#[derive(Debug, Clone, Default)]
pub struct SlipPath {
    /// The vector t of every cell [-].
    pub turn: TangentialField,
    /// The offset a [length].
    pub ahead: TangentialField,
    /// When the edge of contact comes to cells that are open at the start, as a fraction of the increment; 0 where that is not known.
    pub touch: Vec<f64>,
}

impl SlipPath {
    /// That of the end-point rule.
    pub const END_POINT: Self = {
        Self {
            turn: TangentialField { x: Vec::new(), y: Vec::new() },
            ahead: TangentialField { x: Vec::new(), y: Vec::new() },
            touch: Vec::new(),
        }
    };

    /// Paths that go straight from the start of the increment to its end, in so many cells.
    #[cfg(test)]
    pub fn straight(cells: usize) -> Self {
        let zeros = || TangentialField::zeros(cells);
        Self { turn: zeros(), ahead: zeros(), touch: vec![0.0; cells] }
    }

    /// Whether it is another rule than that of the end point.
    pub fn turns(&self) -> bool {
        !self.turn.x.is_empty()
    }

    /// A cell goes on from its last slip increment, see [`path_that_goes_on`].
    #[cfg(test)]
    pub fn go_on(&mut self, cell: usize, last: [f64; 2], (ratio, stop, weight): (f64, f64, f64)) {
        if let Some([turn, ahead]) = path_that_goes_on(last, (ratio, stop, weight)) {
            self.turn.set(cell, turn);
            self.ahead.set(cell, ahead);
        }
    }

    /// A cell that may begin to slip, see [`turn_that_begins`].
    #[cfg(test)]
    pub fn begin(&mut self, cell: usize, shear: [f64; 2], (growth, weight): (f64, f64)) {
        if let Some(turn) = turn_that_begins(shear, (growth, weight)) {
            self.turn.set(cell, turn);
        }
    }

    /// Slip at the end of the increment, up to a factor, of a cell whose slip less the offset is given.
    pub fn end_of(&self, cell: usize, slip: [f64; 2]) -> [f64; 2] {
        if !self.turns() {
            return slip;
        }
        let turn = self.turn.at(cell);
        let straight = length(slip) * length(turn);
        let along = (slip[0] * turn[0] + slip[1] * turn[1] - FADED * straight).max(0.0);
        [slip[0] - along * turn[0], slip[1] - along * turn[1]]
    }

    /// Slip increment of a cell, from its slip less the offset: from the moment of touch on, where it `was_open`.
    pub fn counted(&self, cell: usize, slip: [f64; 2], was_open: bool) -> [f64; 2] {
        if was_open || !self.turns() {
            return slip;
        }
        let ahead = self.ahead.at(cell);
        [slip[0] + ahead[0], slip[1] + ahead[1]]
    }

    /// Slip of a cell that was open and has come into contact [length], as of a whole increment at its rate: its drift from the moment of touch
    /// on, over the fraction of the increment that this was.
    pub fn since_touch(&self, cell: usize, drift: [f64; 2]) -> [f64; 2] {
        if !self.turns() {
            return drift;
        }
        rate_since_touch(drift, self.ahead.at(cell), self.touch[cell])
    }

    /// The turn packed over a contact.
    pub fn packed(&self, contact: &ContactSet) -> Self {
        if !self.turns() {
            return Self::default();
        }
        Self { turn: contact.packed_tangential(&self.turn), ..Self::default() }
    }
}

/// Vector t and offset a of a cell that goes on from its last slip increment [length], in an increment `ratio` times as long, of which a share
/// `stop` lies before the moment at which it may come to rest. `weight`: how far its direction is known, 0 to 1. `None` where that is none.
pub fn path_that_goes_on<R: Scalar>(last: [R; 2], (ratio, stop, weight): (R, R, R)) -> Option<[[R; 2]; 2]> {
    let size = length_of(last);
    if !(size.value() > 0.0) {
        return None;
    }
    let one = R::of(1.0);
    let kept = (ratio + 1.0) / (ratio * 2.0 + 1.0);
    let root = (weight / (1.0 - FADED) * (one - kept / (one - stop)).max(R::of(0.0))).sqrt();
    Some([last.map(|part| part / size * root), last.map(|part| part * ratio * stop)])
}

/// Vector t of a cell that may begin to slip, held by this shear [pressure]: the angle from that to its slip increment grows by a factor to the
/// end. `weight`: how far that direction is known, 0 to 1. `None` without shear.
pub fn turn_that_begins<R: Scalar>(shear: [R; 2], (growth, weight): (f64, R)) -> Option<[R; 2]> {
    let size = length_of(shear);
    let root = || (weight / (1.0 - FADED) * (1.0 - 1.0 / growth)).sqrt();
    (size.value() > 0.0).then(|| shear.map(|part| part / size * root()))
}

/// Slip of a cell that has come into contact, as of a whole increment at its rate, see [`SlipPath::since_touch`].
pub fn rate_since_touch<R: Scalar>(drift: [R; 2], ahead: [R; 2], touch: R) -> [R; 2] {
    let fraction = (R::of(1.0) - touch).max(R::of(LEAST_LEFT));
    [0, 1].map(|axis| (drift[axis] - ahead[axis]) / fraction)
}

/// Length of the way of a slip increment, in a run of this integration. At both ends of an increment in which a cell slips the shear points
/// along the slip: the way is the arc of a circle between these directions, the slip increment its chord. Towards 60 degrees it fades into
/// the chord, as the turn does; of a cell that sticks at the start or the end, and with end points, it is the chord.
pub fn length_of_way<R: Scalar>(
    integration: Integration,
    slip: [R; 2],
    zones: [Zone; 2],
    shear: [[R; 2]; 2],
) -> R {
    let chord = length_of(slip);
    if integration == Integration::EndPoint || zones != [Zone::Slip; 2] {
        return chord;
    }
    let [before, after] = shear;
    let along = before[0] * after[0] + before[1] * after[1];
    let across = (before[0] * after[1] - before[1] * after[0]).size();
    let angle = across.angle_to(along);
    if angle.value() == 0.0 {
        return chord;
    }
    let known = ((angle.cosine() - FADED) / (1.0 - FADED)).max(R::of(0.0));
    let arc = angle * 0.5 / (angle * 0.5).sine();
    chord * (known * (arc - 1.0) + 1.0)
}

/// The slip at the end of the increment, up to a factor, from the slip less the offset and the vector t.
#[inline(always)]
pub fn end_of_chord<R: Reals>(slip: [R; 2], turn: [R; 2]) -> [R; 2] {
    let lengths = (slip[0] * slip[0] + slip[1] * slip[1]) * (turn[0] * turn[0] + turn[1] * turn[1]);
    let along = (slip[0] * turn[0] + slip[1] * turn[1] - lengths.sqrt() * FADED).max(slip[0].all(0.0));
    [slip[0] - along * turn[0], slip[1] - along * turn[1]]
}

/// The vector whose product with a change of slip is that of `across` with the change of the slip at the end.
#[inline(always)]
pub fn row_of_chord<R: Reals>(slip: [R; 2], turn: [R; 2], across: [R; 2]) -> [R; 2] {
    let zero = slip[0].all(0.0);
    let square = slip[0] * slip[0] + slip[1] * slip[1];
    let lengths = (square * (turn[0] * turn[0] + turn[1] * turn[1])).sqrt() * FADED;
    let along = slip[0] * turn[0] + slip[1] * turn[1] - lengths;
    let turned = across[0] * turn[0] + across[1] * turn[1];
    let mut rows = across;
    for axis in 0..2 {
        let row = across[axis] - turned * (turn[axis] - slip[axis] * (lengths / square));
        rows[axis] = along.if_at_most(zero, across[axis], row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::{CellRule, each_cell};
    use crate::random::Random;

    /// Slip along a circle with even speed: slip increments of unequal angles. The end of the last one has the direction of the circle there up to
    /// the third order in the angles (the increment itself: first).
    #[test]
    fn chords_of_a_circle_end_along_it() {
        let point = |angle: f64| [angle.cos(), angle.sin()];
        for ratio in [0.5, 1.0, 2.0] {
            for stop in [0.0, 0.16] {
                let errors = [0.1, 0.05].map(|step: f64| {
                    let angles = [-step / ratio, 0.0, step].map(point);
                    let chord = |k: usize| [0, 1].map(|axis| angles[k + 1][axis] - angles[k][axis]);
                    let (last, this) = (chord(0), chord(1));
                    let mut path = SlipPath::straight(1);
                    path.go_on(0, last, (ratio, stop, 1.0));
                    let ahead = path.ahead.at(0);
                    let end = path.end_of(0, [this[0] - ahead[0], this[1] - ahead[1]]);
                    // Direction of the circle at the end, less that of the found vector.
                    (step + std::f64::consts::FRAC_PI_2 - end[1].atan2(end[0])).abs()
                });
                // Of third order: half the step leaves an eighth of the error, and a seventh with the orders above. The chord itself
                // errs by half the step, .05; what is left is less than a tenth of that.
                assert!(errors[1] < errors[0] / 7.0 && errors[0] < 0.005, "{ratio} {stop}: {errors:?}");
            }
        }
    }

    #[test]
    fn slip_that_turns_goes_along_an_arc() {
        let at = |degrees: f64| [3.0 * degrees.to_radians().cos(), 3.0 * degrees.to_radians().sin()];
        let way_of = |integration, zones, degrees| {
            length_of_way(integration, [0.3, -0.4], zones, [[7.0, 0.0], at(degrees)])
        };
        let slips = [Zone::Slip; 2];
        let way = |degrees: f64| way_of(Integration::SecondOrder, slips, degrees);
        // The 36th of a circle is 2 pi / 36 radii long, its chord 2 sin(5 degrees); of the difference less than a thirtieth is faded
        // away, 2 (1 - cos(10 degrees)).
        let arc = std::f64::consts::PI / 36.0 / 5f64.to_radians().sin();
        let faded = (way(10.0) / 0.5 - 1.0) / (arc - 1.0);
        assert!((faded - (2.0 * 10f64.to_radians().cos() - 1.0)).abs() < 1e-9, "{faded}");
        assert!((way(59.999) / 0.5 - 1.0).abs() < 1e-5 && way(-20.0) == way(20.0));
        assert_eq!([way(0.0), way(61.0), way(180.0)], [0.5; 3]);
        // Nothing of a cell that sticks at either end, nothing with end points, nothing without shear.
        for zones in [[Zone::Stick, Zone::Slip], [Zone::Slip, Zone::Stick], [Zone::Open, Zone::Slip]] {
            assert_eq!(way_of(Integration::SecondOrder, zones, 20.0), 0.5);
        }
        assert_eq!(way_of(Integration::EndPoint, slips, 20.0), 0.5);
        assert_eq!(length_of_way(Integration::SecondOrder, [0.3, -0.4], slips, [[0.0; 2], at(9.0)]), 0.5);
    }

    /// Slip a small angle off the shear that held the cell: the tangent grows by the factor, whatever the size of that shear; a direction
    /// that is not known turns nothing.
    #[test]
    fn slip_that_begins_turns_from_the_shear_before() {
        for (size, weight) in [(1.0, 1.0), (7.0, 1.0), (1.0, 0.0)] {
            let mut path = SlipPath::straight(2);
            path.begin(0, [0.6 * size, 0.8 * size], (1.25, weight));
            path.begin(1, [0.0; 2], (1.25, weight));
            assert_eq!(path.turn.at(1), [0.0; 2]);
            assert_eq!(path.ahead.at(0), [0.0; 2]);
            let off = 1e-5;
            let end = path.end_of(0, [0.6 - 0.8 * off, 0.8 + 0.6 * off]);
            let tangent = (0.6 * end[1] - 0.8 * end[0]) / (0.6 * end[0] + 0.8 * end[1]);
            let growth = if weight > 0.0 { 1.25 } else { 1.0 };
            assert!((tangent / off - growth).abs() < 1e-4, "{tangent}");
        }
    }

    struct Chord;

    impl CellRule<4, 2, 0> for Chord {
        #[inline(always)]
        fn at<R: Reals>(&self, [x, y, turn_x, turn_y]: [R; 4], end: &mut [R; 2]) -> [R; 0] {
            *end = end_of_chord([x, y], [turn_x, turn_y]);
            []
        }
    }

    /// A slip increment in the direction of the last one keeps it and loses the share c of its length; an oblique one turns on by
    /// `1 / (1 - c)` for a small angle; the tangent is that of the last direction, c and t of the formulas of this module's head.
    /// Whole registers of cells find the same as single cells.
    #[test]
    fn slip_turns_on_by_the_ratio_of_the_increments() {
        let mut random = Random::seeded(31);
        for _ in 0..200 {
            let (ratio, stop) = (random.log_uniform(0.1, 5.0), random.between(0.0, 0.05));
            let c = 1.0 - (1.0 + ratio) / ((1.0 + 2.0 * ratio) * (1.0 - stop));
            let (angle, length) = (random.between(0.0, 6.3), random.log_uniform(0.1, 3.0));
            let last = [0.7 * angle.cos(), 0.7 * angle.sin()];
            let mut path = SlipPath::straight(1);
            path.go_on(0, last, (ratio, stop, 1.0));
            assert!((path.ahead.x[0] - last[0] * ratio * stop).abs() < 1e-15);
            assert!((path.ahead.y[0] - last[1] * ratio * stop).abs() < 1e-15);
            let small = 1e-5;
            for (off, tolerance) in [(0.0, 1e-14), (small, 1e-10)] {
                let slip = [length * (angle + off).cos(), length * (angle + off).sin()];
                let end = path.end_of(0, slip);
                let [along, across] =
                    [end[0] * last[0] + end[1] * last[1], end[1] * last[0] - end[0] * last[1]]
                        .map(|part| part / 0.7);
                assert!((along / length - (1.0 - c)).abs() < 1e-9, "{along} {c}");
                assert!((across / along - off / (1.0 - c)).abs() < tolerance, "{across} {off}");
            }
            let slip = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
            let (mut x, mut y) = ([0.0], [0.0]);
            let turn = path.turn.at(0);
            each_cell(&Chord, [&[slip[0]], &[slip[1]], &[turn[0]], &[turn[1]]], [&mut x[..], &mut y]);
            let end = path.end_of(0, slip);
            assert!((x[0] - end[0]).abs() < 1e-15 && (y[0] - end[1]).abs() < 1e-15, "{slip:?}");
            // Half as sure of the direction: half the turn; a cell at rest had none.
            let mut half = SlipPath::straight(1);
            half.go_on(0, last, (ratio, stop, 0.5));
            let ahead =
                [0, 1].map(|axis| path.turn.at(0)[axis].powi(2) - 2.0 * half.turn.at(0)[axis].powi(2));
            assert!(ahead[0].abs() < 1e-15 && ahead[1].abs() < 1e-15);
            half.go_on(0, [0.0; 2], (ratio, stop, 1.0));
            assert!(half.turn.at(0)[0].is_finite());
        }
    }

    /// What is known of a path in a contact is known of its cells there; of no path nothing.
    #[test]
    fn paths_are_packed_with_their_contact() {
        let mut path = SlipPath::straight(3);
        path.go_on(2, [3.0, 4.0], (1.0, 0.0, 1.0));
        let packed = path.packed(&ContactSet::of(3, |cell| cell > 0));
        assert!(path.turns() && packed.turns() && packed.turn.at(0) == [0.0; 2]);
        assert_eq!(packed.turn.at(1), path.turn.at(2));
        let nothing = SlipPath::default();
        assert!(!nothing.turns() && !nothing.packed(&ContactSet::of(3, |_| true)).turns());
        assert_eq!(nothing.counted(7, [1.0, 2.0], false), [1.0, 2.0]);
    }

    /// Even slip of 2 in an increment, of which the cell saw what came after its touch: 0.6 of it, or next to nothing.
    #[test]
    fn a_cell_that_enters_shows_its_rate() {
        let mut path = SlipPath::straight(2);
        path.touch = vec![0.4, 0.95];
        path.ahead.set(0, [0.8, 0.1]);
        path.ahead.set(1, [1.9, 0.0]);
        let found = path.since_touch(0, [2.0, 0.1]);
        assert!((found[0] - 2.0).abs() < 1e-15 && found[1] == 0.0);
        assert!((path.since_touch(1, [2.0, 0.0])[0] - 0.4).abs() < 1e-14);
        assert_eq!(SlipPath::default().since_touch(7, [1.0, 2.0]), [1.0, 2.0]);
    }

    #[test]
    fn what_sticks_stays_and_what_turns_back_is_left_alone() {
        let mut path = SlipPath::straight(2);
        path.go_on(0, [3.0, 4.0], (1.0, 0.0, 1.0));
        assert_eq!(path.end_of(0, [0.0; 2]), [0.0; 2]);
        assert_eq!(path.end_of(0, [-1.0, 0.5]), [-1.0, 0.5]); // backwards
        assert_eq!(path.end_of(1, [1.0, 2.0]), [1.0, 2.0]); // nothing known
        let along = path.end_of(0, [3.0, 4.0]);
        assert!((along[0] - 2.0).abs() < 1e-15 && (along[1] - 8.0 / 3.0).abs() < 1e-15);
        assert_eq!(SlipPath::default().end_of(7, [1.0, 2.0]), [1.0, 2.0]);
        path.go_on(1, [2.0, -4.0], (0.5, 0.1, 0.0));
        let counted = path.counted(1, [1.0, 2.0], false);
        assert!((counted[0] - 1.1).abs() < 1e-15 && (counted[1] - 1.8).abs() < 1e-15);
        assert_eq!(path.counted(1, [1.0, 2.0], true), [1.0, 2.0]);
    }
}
