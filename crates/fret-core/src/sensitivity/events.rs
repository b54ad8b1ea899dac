//! Cells that are about to change their state: there the derivatives on either side differ.

use super::cell::Shear;
use super::contact::Contact;
use super::scene::Scene;
use super::solved::{Solved, deep_by};
use crate::fields::length;
use crate::model::Zone;

/// How near a cell is to a change, relative to the largest pressure, bound or displacement of the contact.
const NEAR: f64 = 1e-6;

/// The increment with most cells that are about to change their state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NearEvents {
    /// Its number, from 0.
    pub increment: usize,
    /// How many such cells the whole contact has.
    pub cells: usize,
    /// How many are in contact.
    pub contact: usize,
}

/// Cells of an increment within a millionth of opening, touching, slipping or coming to rest. `own`: influence of a cell on itself, normal and
/// tangential [length/pressure].
pub(super) fn near_events(
    (scene, solved, increment): (&Scene<'_>, &Solved, usize),
    contact: &Contact<'_>,
    own: [f64; 2],
) -> NearEvents {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let pressure = largest(&mut solved.tractions[0].iter().copied());
    let bound = largest(&mut contact.bounds.iter().copied());
    let mut cells = 0;
    for (number, cell) in solved.contact.cells().enumerate() {
        let opens = solved.tractions[0][cell] < NEAR * pressure;
        let shear = [solved.tractions[1][cell], solved.tractions[2][cell]];
        let here = contact.bounds[number];
        let changes = match (solved.zone_of(cell), contact.cells[number].shear) {
            _ if bound <= 0.0 => false,
            (Zone::Stick, _) => length(shear) > 0.0 && here - length(shear) < NEAR * bound,
            (_, Shear::Turns { compliance, .. }) => compliance * here < NEAR * own[1] * bound,
            _ => false,
        };
        cells += usize::from(opens || changes);
    }
    let touches = |(cell, undeformed): &(usize, &f64)| {
        let deep = deep_by(&solved.motions, scene.places[*cell]);
        let gap = *undeformed + solved.displacements[0][*cell] - deep;
        solved.zone_of(*cell) == Zone::Open && gap < NEAR * own[0] * pressure
    };
    cells += scene.undeformed.iter().enumerate().filter(touches).count();
    let copies = scene.plan.symmetry.copies();
    NearEvents { increment, cells: copies * cells, contact: copies * solved.contact.len() }
}
