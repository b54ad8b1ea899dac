//! How long an increment is beside the one before it, where it goes on in about the same direction.

use crate::fields::Scalar;
use crate::model::controls::{CONTROLS, ControlRow, FREEDOMS, NORMAL, TANGENTIAL};
use crate::model::{Control, LoadStep};

/// A change of the normal load below this share of it is none: tables of loads are rounded.
const ROUNDING: f64 = 1e-9;

/// Length of an increment over that of the last one, which it goes on from.
#[derive(Debug, Clone, Copy)]
pub struct Pace<R = f64> {
    /// In the loads.
    pub loads: R,
    /// In the normal load, which moves the edge of contact; `None` where that turns.
    pub edge: Option<R>,
    /// Whether the normal load grows in this increment.
    pub grows: bool,
}

/// Length of a load increment to `load` over that of the one before it, 3 at the most, when it goes on in about the same direction: less than 60
/// degrees off. The edge goes with the normal load; where that stays, with the others. Of the changes of all controls in both.
pub fn pace_of<R: Scalar>([older, newer]: [[R; FREEDOMS]; 2], load: &LoadStep) -> Option<Pace<R>> {
    let [old, both, new] = products(older, newer, are_alike(load));
    let goes_on = both.value() > 0.5 * (old.value() * new.value()).sqrt();
    let loads = goes_on.then(|| (new / old).sqrt().min(R::of(3.0)))?;
    let [then, now] = [older[NORMAL], newer[NORMAL]];
    let edge = match (then * now).value() {
        product if product > 0.0 => Some((now / then).min(R::of(3.0))),
        _ => (then.value() == 0.0 && now.value() == 0.0).then_some(loads),
    };
    let grows = now.value() > ROUNDING * load.normal.value().abs();
    Some(Pace { loads, edge, grows })
}

/// Whether the tangential controls along x and y are of one kind.
pub fn are_alike(load: &LoadStep) -> bool {
    matches!(
        load.tangential,
        [Control::Force(_), Control::Force(_)]
            | [Control::Motion(_), Control::Motion(_)]
            | [Control::FarEnd(_), Control::FarEnd(_)]
    )
}

/// Squares of the lengths of two increments and their product, each of every control by itself in units of the longer one. Loads along x
/// and y go together, tangential ones where `are_alike`.
pub fn products<R: Scalar>(older: [R; FREEDOMS], newer: [R; FREEDOMS], are_alike: bool) -> [R; 3] {
    let apart = |row: &ControlRow| row.freedom == TANGENTIAL && !are_alike;
    let (tangential, others): (Vec<_>, Vec<_>) = CONTROLS.iter().partition(|row| row.freedom == TANGENTIAL);
    let groups = tangential.into_iter().chain(others).flat_map(|row| {
        let freedoms = row.freedoms();
        if apart(row) { freedoms.map(|one| one..one + 1).collect() } else { vec![freedoms] }
    });
    let zero = R::of(0.0);
    let mut found = [zero; 3];
    for group in groups {
        let product =
            |a: &[R], b: &[R]| group.clone().map(|k| a[k] * b[k]).fold(zero, |sum, part| sum + part);
        let [old, both, new] = [product(&older, &older), product(&older, &newer), product(&newer, &newer)];
        let unit = old.max(new);
        if unit.value() > 0.0 {
            found = [found[0] + old / unit, found[1] + both / unit, found[2] + new / unit];
        }
    }
    found
}
