//! What a solver remembers from one increment to the next, apart from the state it is handed.
//!
//! Operators and workspaces are no memory: they follow from the problem and from the region named here. A new field here is stored
//! with a run and comes back with it; whatever can change later bits has to stand here.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use super::last_cycle::LastCycle;
use super::region::Region;
use super::tractions::Displacements;
use crate::fields::{Outside, TangentialField, add_scaled, carried, copied, stored};
use crate::model::{ContactState, Control, LoadStep};

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
    /// The last cycle of surfaces that move.
    #[serde(default)]
    pub(super) last_cycle: LastCycle,
}

impl SolverMemory {
    /// Whether the next increment may go on from the slip of the last one.
    pub fn knows_slip(&self) -> bool {
        self.last.as_ref().is_some_and(|last| last.drift.region.is_some())
    }

    /// The same where the next increment does not go on from those before the last one.
    #[must_use]
    pub fn without_increments_before(self) -> Self {
        Self { before: None, ..self }
    }
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
        let Some(own) = self.region else { return TangentialField::zeros(region.len()) };
        let [x, y] = self.field.parts().map(|part| region.taken((own, part), cells));
        TangentialField { x, y }
    }

    /// The same with its fields carried over a grid.
    fn carried(&self, carried: impl Fn(Region, &[f64]) -> (Vec<f64>, Region)) -> Self {
        let Some(from) = self.region else { return self.clone() };
        let (x, to) = carried(from, &self.field.x);
        let (y, _) = carried(from, &self.field.y);
        Self { region: Some(to), field: TangentialField { x, y }, ..*self }
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
    pub fn carried(&self, cells: [f64; 2]) -> Self {
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
    /// edge; tractions are none there. Displacements and drifts are known there no more; where no contact is at the edge of the grid (`ends_inside`),
    /// those of the cells along it do not matter, and what the whole grid was known of it is known of after a step of one cell, too.
    pub(super) fn carried(&self, cells: [isize; 2], ends_inside: bool) -> Self {
        let by = cells.map(|cells| cells as f64);
        let whole = |field: &Array2<f64>| carried(field, by, Outside::Edge);
        let of_region = |from: Region, field: &[f64], grid: [usize; 2]| {
            if !field.is_empty()
                && ends_inside
                && from == Region::whole(grid)
                && cells.iter().all(|by| by.abs() <= 1)
            {
                (from.carried_over_edges(field, cells), from)
            } else {
                from.carried(field, cells, grid)
            }
        };
        let last = self.last.as_ref().map(|last| {
            let grid = last.gap.dim().into();
            let Displacements { normal, tangential } = &last.displacements;
            let [(normal, region), (x, _), (y, _)] =
                [normal, &tangential.x, &tangential.y].map(|field| of_region(last.region, field, grid));
            LastIncrement {
                region,
                displacements: Displacements { normal, tangential: TangentialField { x, y } },
                drift: last.drift.carried(|from, field| of_region(from, field, grid)),
                gap: whole(&last.gap),
                ..*last
            }
        });
        if last.as_ref().is_some_and(|last| last.region.len() == 0) {
            return Self { region: self.region, last_load: self.last_load, ..Self::default() };
        }
        let before = self.before.as_ref().map(|before| {
            let grid = before.tractions.pressure.dim().into();
            Before {
                tractions: before.tractions.carried(by),
                gap: before.gap.as_ref().map(whole),
                drift: before
                    .drift
                    .as_ref()
                    .map(|drift| drift.carried(|from, field| of_region(from, field, grid))),
                ..*before
            }
        });
        Self { last, before, last_cycle: self.last_cycle.clone(), ..*self }
    }

    /// All its fields that are linear in the tractions, the drifts and the gaps of the last states.
    fn fields(&mut self) -> Vec<&mut [f64]> {
        let mut fields: Vec<&mut [f64]> = Vec::new();
        if let Some(last) = &mut self.last {
            let Displacements { normal, tangential } = &mut last.displacements;
            fields.extend([normal.as_mut_slice(), &mut tangential.x, &mut tangential.y]);
            fields.extend([
                last.drift.field.x.as_mut_slice(),
                &mut last.drift.field.y,
                &mut last.drift.motion,
            ]);
            fields.extend(last.gap.as_slice_mut());
        }
        if let Some(before) = &mut self.before {
            fields.extend(before.tractions.pressure.as_slice_mut());
            fields.extend(before.tractions.shear.iter_mut().filter_map(|shear| shear.as_slice_mut()));
            fields.extend(before.gap.as_mut().and_then(|gap| gap.as_slice_mut()));
            if let Some(drift) = &mut before.drift {
                fields.extend([drift.field.x.as_mut_slice(), &mut drift.field.y, &mut drift.motion]);
            }
        }
        fields
    }

    /// Of which regions its fields are.
    fn regions(&self) -> [Option<Region>; 3] {
        let before = self.before.as_ref().and_then(|before| before.drift.as_ref());
        [
            self.last.as_ref().map(|last| last.region),
            self.last.as_ref().and_then(|last| last.drift.region),
            before.and_then(|drift| drift.region),
        ]
    }

    /// The mean of memories by weights whose sum is 1, with the loads of the last of them; `None` where they are not of the same regions.
    pub fn mean(memories: &[(&Self, f64)]) -> Option<Self> {
        let (last, _) = memories.last()?;
        let mut mean = (*last).clone();
        mean.fields().into_iter().for_each(|field| field.fill(0.0));
        for (memory, weight) in memories {
            let mut memory = (*memory).clone();
            if memory.regions() != mean.regions() {
                return None;
            }
            let (to, from) = (mean.fields(), memory.fields());
            if to.len() != from.len() {
                return None;
            }
            to.into_iter().zip(from).for_each(|(to, from)| add_scaled(to, *weight, from));
        }
        Some(mean)
    }

    /// Counts rolls, shifts and rotations from elsewhere: all loads that it knows of by so much more.
    pub fn count_motions_from(&mut self, more: ([f64; 2], [f64; 2], f64)) {
        let (roll, shift, twist) = more;
        let move_on = |control: &mut Control, by: f64| {
            if let Control::Motion(motion) = control {
                *motion += by;
            }
        };
        let loads = [
            self.last_load.as_mut(),
            self.last.as_mut().map(|last| &mut last.load),
            self.before.as_mut().map(|before| &mut before.load),
        ];
        for load in loads.into_iter().flatten() {
            for axis in 0..2 {
                load.roll[axis] += roll[axis];
                move_on(&mut load.tangential[axis], shift[axis]);
            }
            move_on(&mut load.twist, twist);
        }
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
            let along = [tangential.x.len(), tangential.y.len()];
            last.region.lies_within(cells)
                && normal.len() == len
                && (along == [len; 2] || along == [0; 2])
                && last.drift.fits(cells)
                && last.gap.dim() == cells.into()
        };
        let before_fits = |before: &Before| {
            before.tractions.fits(cells)
                && before.gap.as_ref().is_none_or(|gap| gap.dim() == cells.into())
                && before.drift.as_ref().is_none_or(|drift| drift.fits(cells))
        };
        self.region.is_none_or(|region| region.lies_within(cells))
            && self.last_cycle.fits(cells)
            && self.last.as_ref().is_none_or(last_fits)
            && self.before.as_ref().is_none_or(before_fits)
    }
}
