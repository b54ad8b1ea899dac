//! Cells that are about to change their state: there the derivatives on either side differ.

use super::cell::Shear;
use super::contact::Contact;
use super::scene::Scene;
use super::solved::Solved;
use crate::fields::length;
use crate::model::Zone;
use crate::solver::ContactSet;

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

/// Where cells are that are about to change their state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SideOfEvents {
    /// In the state that they have.
    Own,
    /// In the other one.
    Other,
}

/// Cells of an increment within a millionth of opening, touching, slipping or coming to rest, and what they would do then.
pub(super) fn cells_near_events(solved: &Solved, contact: &Contact<'_>, own: [f64; 2]) -> Vec<(usize, Zone)> {
    let [pressure, bound] =
        [&solved.tractions[0], &contact.bounds].map(|values| values.iter().copied().fold(0.0, f64::max));
    let other = |(number, cell): (usize, usize)| {
        if solved.tractions[0][cell] < NEAR * pressure {
            return Some((cell, Zone::Open));
        }
        let shear = length([solved.tractions[1][cell], solved.tractions[2][cell]]);
        let here = contact.bounds[number];
        match (solved.zone_of(cell), contact.cells[number].shear) {
            _ if bound <= 0.0 => None,
            (Zone::Stick, _) => (shear > 0.0 && here - shear < NEAR * bound).then_some((cell, Zone::Slip)),
            (_, Shear::Turns { compliance, .. }) => {
                (compliance * here < NEAR * own[1] * bound).then_some((cell, Zone::Stick))
            }
            _ => None,
        }
    };
    let mut cells: Vec<(usize, Zone)> = solved.contact.cells().enumerate().filter_map(other).collect();
    let touches = |(cell, gap): (usize, &f64)| {
        let near = *gap < NEAR * own[0] * pressure && solved.zone_of(cell) == Zone::Open;
        near.then_some((cell, Zone::Slip))
    };
    cells.extend(solved.gap.iter().enumerate().filter_map(touches));
    cells
}

impl NearEvents {
    /// Of so many cells in an increment; `None` where there are none.
    pub(super) fn of((scene, solved, increment): (&Scene<'_>, &Solved, usize), cells: usize) -> Option<Self> {
        let copies = scene.plan.symmetry.copies();
        let contact = copies * solved.contact.len();
        (cells > 0).then_some(Self { increment, cells: copies * cells, contact })
    }
}

/// The same increment with some cells in another state.
pub(super) fn with_cells(solved: &Solved, others: &[(usize, Zone)]) -> Solved {
    let mut other = solved.clone();
    let [_, columns] = solved.shape();
    for (cell, zone) in others {
        other.zone[[cell / columns, cell % columns]] = *zone;
    }
    let cells = solved.zone.len();
    let mut touches = vec![false; cells];
    solved.contact.cells().for_each(|cell| touches[cell] = true);
    for (cell, zone) in others {
        touches[*cell] = *zone != Zone::Open;
    }
    other.contact = ContactSet::of(cells, |cell| touches[cell]);
    other
}
