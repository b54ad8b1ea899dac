//! What a solver remembers from one increment to the next, apart from the state it is handed.
//!
//! Operators and workspaces are no memory: they follow from the problem and from the region named here. A new field here is stored
//! with a run and comes back with it; whatever can change later bits has to stand here.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::region::Region;
use super::tractions::Displacements;
use crate::fields::{Outside, TangentialField, carried, copied, stored};
use crate::model::{ContactState, LoadStep};

/// All that later increments depend on besides the last state.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SolverMemory {
    /// The region of the last operators.
    pub(super) region: Option<Region>,
    /// What the last increment ended with.
    pub(super) last: Option<LastIncrement>,
    /// What was there before the last increment, for the extrapolation.
    pub(super) before: Option<Before>,
    /// The load that led to the last state.
    pub(super) last_load: Option<LoadStep>,
}

/// The state before the last one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Before {
    /// The load that led to it.
    pub load: LoadStep,
    pub tractions: GridTractions,
    /// Its area of contact [length^2].
    pub contact_area: f64,
    /// Its gap on the grid [length], where the increment from there went on from the one before it.
    #[serde(with = "stored")]
    pub gap: Option<Array2<f64>>,
    /// The drift that led to it, likewise.
    pub drift: Option<Drift>,
}

/// Change of the tangential displacement of the upper body over the lower in an increment: slip, in contact. Of cells that came into contact
/// in it, that of a whole increment at their rate from the moment of touch on.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Drift {
    /// Where it is known; zero elsewhere.
    pub region: Option<Region>,
    /// Of its cells [length].
    pub field: TangentialField,
    /// Shift along x and y [length] and twist [rad] of the increment.
    pub motion: [f64; 3],
    /// Strain of the lower surface less that of the upper one, of the increment [-].
    pub strain: [f64; 2],
    /// Length of the increment over that of the one before it, in the loads [-]; 1 where it does not go on from that.
    pub ratio: f64,
    /// Whether the moments of touch in it were known.
    pub knows_touch: bool,
}

impl Drift {
    /// In the cells of a region of a grid.
    pub fn on(&self, cells: [usize; 2], region: Region) -> TangentialField {
        match self.region {
            None => TangentialField::zeros(region.len()),
            Some(own) if own == region => self.field.clone(),
            Some(own) => {
                let [x, y] = self.field.parts().map(|part| {
                    let mut field = Array2::zeros(cells);
                    own.place(part, &mut field);
                    region.gather(&field)
                });
                TangentialField { x, y }
            }
        }
    }

    /// Carries it over a grid by whole cells along each axis.
    fn carry(&mut self, cells: [isize; 2], grid: [usize; 2]) {
        if let Some(from) = self.region {
            for field in [&mut self.field.x, &mut self.field.y] {
                self.region = Some(from.carry(field, cells, grid));
            }
        }
    }

    fn fits(&self, cells: [usize; 2]) -> bool {
        let len = self.region.map_or(0, |region| region.len());
        self.region.is_none_or(|region| region.lies_within(cells))
            && [self.field.x.len(), self.field.y.len()] == [len; 2]
    }
}

/// Tractions of a state on the whole grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct GridTractions {
    #[serde(with = "stored")]
    pub pressure: Array2<f64>,
    #[serde(with = "stored")]
    pub shear: [Array2<f64>; 2],
}

impl GridTractions {
    /// Those of a state.
    pub fn of(state: &ContactState) -> Self {
        Self { pressure: copied(&state.pressure), shear: [0, 1].map(|axis| copied(&state.shear[axis])) }
    }

    /// Those of a contact that has travelled so many cells along each axis.
    pub fn carried(self, cells: [f64; 2]) -> Self {
        let moved = |field: &Array2<f64>| carried(field, cells, Outside::Zero);
        Self { pressure: moved(&self.pressure), shear: self.shear.each_ref().map(moved) }
    }

    fn fits(&self, cells: [usize; 2]) -> bool {
        [&self.pressure, &self.shear[0], &self.shear[1]].iter().all(|field| field.dim() == cells.into())
    }
}

/// Displacements of the last state in its region, and its gap on the whole grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct LastIncrement {
    pub region: Region,
    pub displacements: Displacements,
    pub drift: Drift,
    #[serde(with = "stored")]
    pub gap: Array2<f64>,
    pub contact_area: f64,
    pub load: LoadStep,
}

impl SolverMemory {
    /// The same of a contact whose bodies have been carried over a grid by whole cells along each axis. What comes onto the grid is as it is at its
    /// edge; tractions are none there.
    pub(super) fn carried(mut self, cells: [isize; 2]) -> Self {
        let by = cells.map(|cells| cells as f64);
        let whole = |field: &Array2<f64>| carried(field, by, Outside::Edge);
        if let Some(last) = &mut self.last {
            let from = last.region;
            last.gap = whole(&last.gap);
            let grid = last.gap.dim().into();
            last.drift.carry(cells, grid);
            let Displacements { normal, tangential } = &mut last.displacements;
            for field in [normal, &mut tangential.x, &mut tangential.y] {
                last.region = from.carry(field, cells, grid);
            }
            if last.region.len() == 0 {
                return Self { region: self.region, last_load: self.last_load, ..Self::default() };
            }
        }
        if let Some(before) = &mut self.before {
            let grid = before.tractions.pressure.dim().into();
            before.tractions = before.tractions.clone().carried(by);
            if let Some(gap) = &mut before.gap {
                *gap = whole(gap);
            }
            if let Some(drift) = &mut before.drift {
                drift.carry(cells, grid);
            }
        }
        self
    }

    /// That of a solver whose first state is known, with the load that led to it, and nothing else.
    pub(crate) fn starting_at(load: LoadStep) -> Self {
        Self { last_load: Some(load), ..Self::default() }
    }

    /// Whether this can be the memory of a solver on a grid of `cells`: sizes agree and regions lie inside.
    pub fn fits(&self, cells: [usize; 2]) -> bool {
        let last_fits = |last: &LastIncrement| {
            let len = last.region.len();
            let Displacements { normal, tangential } = &last.displacements;
            last.region.lies_within(cells)
                && [normal.len(), tangential.x.len(), tangential.y.len()] == [len; 3]
                && last.drift.fits(cells)
                && last.gap.dim() == cells.into()
        };
        let before_fits = |before: &Before| {
            before.tractions.fits(cells)
                && before.gap.as_ref().is_none_or(|gap| gap.dim() == cells.into())
                && before.drift.as_ref().is_none_or(|drift| drift.fits(cells))
        };
        self.region.is_none_or(|region| region.lies_within(cells))
            && self.last.as_ref().is_none_or(last_fits)
            && self.before.as_ref().is_none_or(before_fits)
    }
}
