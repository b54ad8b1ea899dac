//! The tractions of the last cycle, from which the increments of surfaces that move start: a cycle goes between the same loads as the one before
//! it, and wear changes little from one to the next.

use serde::{Deserialize, Serialize};

use super::region::Region;
use super::tractions::Tractions;
use crate::model::{ContactState, LoadStep, TangentialField};

/// Numbers that are kept for each cell of the grid at the most: a cycle of 16 increments whose contact covers a third of it; on grids with few
/// cells so many in all.
pub const NUMBERS: usize = 16;
const AT_LEAST: usize = 1 << 18;

/// Increments between two loads each, the oldest first.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LastCycle {
    increments: Vec<Passed>,
}

/// An increment from one load to another, with the tractions at its end in the region of the loaded cells alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Passed {
    loads: [LoadStep; 2],
    region: Region,
    tractions: Tractions,
}

impl Passed {
    /// Whether it goes between these loads.
    fn goes(&self, [from, to]: [&LoadStep; 2]) -> bool {
        self.loads[0] == *from && self.loads[1] == *to
    }
}

impl LastCycle {
    /// The tractions at the end of the last increment between these loads, in a region of a grid of `cells`.
    pub fn tractions(
        &self,
        loads: [&LoadStep; 2],
        (region, cells): (Region, [usize; 2]),
    ) -> Option<Tractions> {
        let passed = self.increments.iter().find(|passed| passed.goes(loads))?;
        let [pressure, x, y] =
            passed.tractions.parts().map(|part| region.taken((passed.region, part), cells));
        Some(Tractions { pressure, shear: TangentialField { x, y } })
    }

    /// Keeps the tractions of a state, with which an increment between these loads ended, in place of those of the last such one; those from
    /// longest ago are dropped where there is no room.
    pub fn keep(&mut self, loads: [&LoadStep; 2], state: &ContactState) {
        self.increments.retain(|passed| !passed.goes(loads));
        let cells: [usize; 2] = state.pressure.dim().into();
        let loaded = |i: usize, j: usize| state.pressure[[i, j]] > 0.0;
        let Some([x, y]) = Region::extent(cells, [false; 2], loaded) else { return };
        let region = Region { origin: [x.start, y.start], shape: [x.len(), y.len()] };
        let tractions = Tractions {
            pressure: region.gather(&state.pressure),
            shear: region.gather_tangential(&state.shear),
        };
        self.increments.push(Passed { loads: loads.map(|load| *load), region, tractions });
        let room = (NUMBERS * state.pressure.len()).max(AT_LEAST);
        let numbers = |passed: &Passed| 3 * passed.region.len();
        while self.increments.iter().map(numbers).sum::<usize>() > room {
            self.increments.remove(0);
        }
    }

    /// Whether this can be of a solver on a grid of `cells`.
    pub fn fits(&self, cells: [usize; 2]) -> bool {
        self.increments.iter().all(|Passed { region, tractions, .. }| {
            region.lies_within(cells) && tractions.parts().iter().all(|part| part.len() == region.len())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Control;

    fn load(normal: f64) -> LoadStep {
        LoadStep { normal: Control::Force(normal), ..LoadStep::FREE }
    }

    /// A state under one pressure in the cells of a region.
    fn state(pressure: f64, cells: [usize; 2], region: Region) -> ContactState {
        let mut state = ContactState::untouched(cells);
        region.place(&vec![pressure; region.len()], &mut state.pressure);
        state
    }

    /// The newest between the same loads is found, in the cells of any region; nothing before, nor on the way back.
    #[test]
    fn an_increment_is_found_by_the_loads_it_goes_between() {
        let (cells, left) = ([6, 4], Region { origin: [0, 0], shape: [3, 4] });
        let mut cycle = LastCycle::default();
        let (low, high) = (load(1.0), load(2.0));
        let (there, back) = ([&low, &high], [&high, &low]);
        assert!(cycle.tractions(there, (left, cells)).is_none());
        cycle.keep(there, &state(1.0, cells, left));
        cycle.keep(there, &state(3.0, cells, left));
        assert!(cycle.tractions(back, (left, cells)).is_none());
        assert_eq!(cycle.tractions(there, (left, cells)).unwrap().pressure, [3.0; 12]);
        let right = Region { origin: [2, 0], shape: [4, 4] };
        let found = cycle.tractions(there, (right, cells)).unwrap();
        assert_eq!(found.pressure[..4], [3.0; 4]);
        assert_eq!(found.pressure[4..], [0.0; 12]);
        assert_eq!(found.shear.x, [0.0; 16]);
        assert!(cycle.fits(cells) && !cycle.fits([2, 4]));
        // Bodies that have parted leave nothing to start from.
        cycle.keep(there, &ContactState::untouched(cells));
        assert!(cycle.tractions(there, (left, cells)).is_none());
    }

    /// No more is kept than there is room for, and what was passed last stays.
    #[test]
    fn what_is_kept_is_bounded() {
        let cells = [200, 200];
        let whole = Region::whole(cells);
        let mut cycle = LastCycle::default();
        for step in 0..20 {
            let [from, to] = [step, step + 1].map(|step| load(f64::from(step)));
            cycle.keep([&from, &to], &state(1.0, cells, whole));
        }
        assert_eq!(cycle.increments.len(), NUMBERS / 3);
        assert!(cycle.tractions([&load(19.0), &load(20.0)], (whole, cells)).is_some());
        // A line contact keeps a cycle of a hundred increments.
        let (cells, mut cycle) = ([200, 1], LastCycle::default());
        for step in 0..100 {
            cycle.keep([&load(f64::from(step)), &load(0.5)], &state(1.0, cells, Region::whole(cells)));
        }
        assert_eq!(cycle.increments.len(), 100);
    }
}
