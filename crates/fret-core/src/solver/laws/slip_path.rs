//! The path of slip inside an increment: from the slip increment of a cell, its chord, to the direction of slip at its end.
//!
//! The friction law holds at the end of the increment: shear is opposed to the slip rate there. The end-point rule (backward Euler)
//! takes the chord for its direction and is of first order where slip turns. Directions of chords are those of the rates in their
//! middles, to second order; carried on linearly from the middle of the last chord over the middle of this one to its end, the
//! direction is turned on by `rho / (1 + rho)` of the angle between the chords, rho the ratio of this increment to the last. With
//! `l` the unit direction of the last chord and `c = rho / (1 + 2 rho)`
//!
//! ```text
//! s_end = s - c max(s . l, 0) l
//! ```
//!
//! has that direction to second order: the tangent of its angle to l is `1 / (1 - c)` times that of s. It is continuous and of degree
//! one (a cell that sticks stays where it is), and piecewise linear. This rule is new here; derivation and measured orders:
//! `docs/theory/second-order.md`.

use super::super::contact_set::ContactSet;
use crate::fields::{Reals, TangentialField};

/// What is known of the paths before an increment is solved, over the cells of a region or packed over a contact. Every field may be
/// empty, which is as good as zero: the end-point rule.
#[derive(Debug, Clone, Default)]
pub struct SlipPath {
    /// `sqrt(c) l` [-].
    pub turn: TangentialField,
}

impl SlipPath {
    /// Whether chords are turned on anywhere.
    pub fn turns(&self) -> bool {
        !self.turn.x.is_empty()
    }

    /// The path of the next slip increments, of `ratio` times the length in the load, after the last ones [length].
    pub fn after(last: &TangentialField, ratio: f64) -> Self {
        let root = (ratio / (1.0 + 2.0 * ratio)).sqrt();
        let mut turn = last.clone();
        for (x, y) in turn.x.iter_mut().zip(&mut turn.y) {
            let length = x.hypot(*y);
            let factor = if length > 0.0 { root / length } else { 0.0 };
            *x *= factor;
            *y *= factor;
        }
        Self { turn }
    }

    /// The slip at the end of the increment, up to a factor, of a cell.
    pub fn end_of(&self, cell: usize, slip: [f64; 2]) -> [f64; 2] {
        if !self.turns() {
            return slip;
        }
        let turn = self.turn.at(cell);
        let along = (slip[0] * turn[0] + slip[1] * turn[1]).max(0.0);
        [slip[0] - along * turn[0], slip[1] - along * turn[1]]
    }

    /// The same packed over a contact.
    pub fn packed(&self, contact: &ContactSet) -> Self {
        if self.turns() { Self { turn: contact.packed_tangential(&self.turn) } } else { Self::default() }
    }
}

/// `s - max(s . t, 0) t` with `t = sqrt(c) l`.
#[inline(always)]
pub fn end_of_chord<R: Reals>(slip: [R; 2], turn: [R; 2]) -> [R; 2] {
    let along = (slip[0] * turn[0] + slip[1] * turn[1]).max(slip[0].all(0.0));
    [slip[0] - along * turn[0], slip[1] - along * turn[1]]
}
