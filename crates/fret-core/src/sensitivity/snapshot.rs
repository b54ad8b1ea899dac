//! Increments and parts of them as a run left them, for later: where bodies touch, and no more.

use std::sync::Arc;

use ndarray::Array2;

use super::fields::{Fields, zeros};
use crate::history::StepRecord;
use crate::model::{AccumulatedSlip, ContactState, Zone};
use crate::solver::Region;

/// Bytes a cell in contact: its number, three tractions, its zone.
const CELL: usize = 4 + 3 * 8 + 1;

/// An increment, or a part of one, as the run left it: its record, and the state in front of the mirrors where there is pressure or shear.
pub(super) struct Snapshot {
    pub record: StepRecord,
    /// Share of the way of the increment at its end: 1 of a whole one, and of the last part of one.
    pub share: f64,
    /// Whether it was solved by the rule of end points.
    pub by_end_points: bool,
    shape: [usize; 2],
    cells: Vec<u32>,
    tractions: [Vec<f64>; 3],
    zones: Vec<Zone>,
    approach: f64,
    shift: [f64; 2],
    twist: f64,
    tilt: [f64; 2],
    bulk_stress: [[f64; 2]; 2],
    /// Accumulated slip of its cells along x and y [length], where it is asked for.
    pub slip: Option<[Vec<f64>; 2]>,
    /// Depth worn off both bodies together, after what happens to the surfaces where a cycle or a stage ends [length].
    pub worn: Option<Arc<Array2<f64>>>,
    /// Thickness of the debris, the same, where some of it stays [length].
    pub debris: Option<Arc<Array2<f64>>>,
    /// What slip has done to the surfaces, the same, where friction follows that.
    pub slipped: Option<Arc<AccumulatedSlip>>,
    /// Cycles of the block that ends with it, whose wear is taken off then; of a stage without cycles one, and none where nothing ends.
    pub block: usize,
}

impl Snapshot {
    /// That of a state at a share of the way of an increment, with its slip or without; `last`: the one before.
    pub fn of(
        (record, share): (&StepRecord, f64),
        (state, with_slip): (&ContactState, bool),
        last: Option<&Self>,
    ) -> Self {
        let fields = [&state.pressure, &state.shear[0], &state.shear[1]];
        let (rows, columns) = state.zone.dim();
        let fields = fields.map(|field| field.as_standard_layout());
        let flat = fields.each_ref().map(|field| field.as_slice().unwrap_or_default());
        let zones = state.zone.as_standard_layout();
        let zones = zones.as_slice().unwrap_or_default();
        let touches =
            |cell: &usize| zones[*cell] != Zone::Open || flat.iter().any(|field| field[*cell] != 0.0);
        let slip = state.slip.each_ref().map(|field| field.as_standard_layout());
        let slip = slip.each_ref().map(|field| field.as_slice().unwrap_or_default());
        let slipped = |cell: &usize| with_slip && slip.iter().any(|field| field[*cell] != 0.0);
        let touched: Vec<usize> = (0..rows * columns).filter(|cell| touches(cell) || slipped(cell)).collect();
        Self {
            record: record.clone(),
            share,
            by_end_points: record.work.end_point_increments > 0,
            shape: [rows, columns],
            cells: touched.iter().map(|cell| *cell as u32).collect(),
            tractions: flat.map(|field| touched.iter().map(|cell| field[*cell]).collect()),
            zones: touched.iter().map(|cell| zones[*cell]).collect(),
            approach: state.approach,
            shift: state.shift,
            twist: state.twist,
            tilt: state.tilt,
            bulk_stress: state.bulk_stress,
            slip: with_slip.then(|| slip.map(|field| touched.iter().map(|cell| field[*cell]).collect())),
            worn: shared(state.worn_depth.as_ref(), last.and_then(|last| last.worn.as_ref())),
            debris: shared(state.debris.as_ref(), last.and_then(|last| last.debris.as_ref())),
            slipped: shared(state.accumulated.as_ref(), last.and_then(|last| last.slipped.as_ref())),
            block: 0,
        }
    }

    /// Whether the increment ends with it.
    pub fn ends_increment(&self) -> bool {
        self.share >= 1.0
    }

    /// Whether the surfaces have worn at its end, since another one.
    pub fn has_worn(&self, last: Option<&Self>) -> bool {
        let of_last = |of: fn(&Self) -> &Option<Arc<Array2<f64>>>| last.and_then(|last| of(last).as_ref());
        let pairs = [(&self.worn, of_last(|last| &last.worn)), (&self.debris, of_last(|last| &last.debris))];
        pairs.into_iter().any(|pair| match pair {
            (Some(now), Some(then)) => !Arc::ptr_eq(now, then),
            (Some(now), None) => now.iter().any(|depth| *depth != 0.0),
            (None, _) => false,
        })
    }

    /// Depth worn off in a region of the grid; nothing where nothing wears.
    pub fn worn_in(&self, region: Region) -> Vec<f64> {
        self.worn.as_ref().map_or_else(Vec::new, |depth| region.gather(depth))
    }

    /// Thickness of the debris there; nothing where none stays.
    pub fn debris_in(&self, region: Region) -> Vec<f64> {
        self.debris.as_ref().map_or_else(Vec::new, |thickness| region.gather(thickness))
    }

    /// Motions of the state, without cells.
    pub fn motions(&self) -> ContactState {
        self.of_shape([0, 0])
    }

    fn of_shape(&self, shape: [usize; 2]) -> ContactState {
        ContactState {
            approach: self.approach,
            shift: self.shift,
            twist: self.twist,
            tilt: self.tilt,
            bulk_stress: self.bulk_stress,
            ..ContactState::untouched(shape)
        }
    }

    /// Tractions and zones in a region of the grid.
    pub fn in_region(&self, region: Region) -> (Fields, Array2<Zone>) {
        let mut tractions = zeros(region.len());
        let mut zones = Array2::from_elem(region.shape, Zone::Open);
        let [rows, columns] = region.origin;
        for (number, cell) in self.cells.iter().enumerate() {
            let [i, j] = [*cell as usize / self.shape[1], *cell as usize % self.shape[1]];
            if region.contains(i, j) {
                let place = [i - rows, j - columns];
                for (field, values) in tractions.iter_mut().zip(&self.tractions) {
                    field[place[0] * region.shape[1] + place[1]] = values[number];
                }
                zones[place] = self.zones[number];
            }
        }
        (tractions, zones)
    }

    /// Tractions, zones, motions and, where it is asked for, slip of the state; nothing else.
    pub fn state(&self) -> ContactState {
        let mut state = self.of_shape(self.shape);
        let [shear_x, shear_y] = &mut state.shear;
        for (field, values) in [&mut state.pressure, shear_x, shear_y].into_iter().zip(&self.tractions) {
            self.spread(values, field);
        }
        for (field, values) in state.slip.iter_mut().zip(self.slip.iter().flatten()) {
            self.spread(values, field);
        }
        self.spread(&self.zones, &mut state.zone);
        state
    }

    fn spread<T: Copy>(&self, values: &[T], field: &mut Array2<T>) {
        for (cell, value) in self.cells.iter().zip(values) {
            let cell = *cell as usize;
            field[[cell / self.shape[1], cell % self.shape[1]]] = *value;
        }
    }

    /// Cells under pressure, `[i, j]`.
    pub fn pressed(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let columns = self.shape[1];
        let pressed = self.cells.iter().zip(&self.tractions[0]).filter(|(_, pressure)| **pressure > 0.0);
        pressed.map(move |(cell, _)| [*cell as usize / columns, *cell as usize % columns])
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        let slip = if self.slip.is_some() { 2 * size_of::<f64>() } else { 0 };
        size_of::<Self>() + self.cells.len() * (CELL + slip)
    }
}

/// The same thing as the one before where it has not changed.
fn shared<T: Clone + PartialEq>(now: Option<&T>, last: Option<&Arc<T>>) -> Option<Arc<T>> {
    let now = now?;
    let same = last.filter(|known| ***known == *now);
    Some(same.map_or_else(|| Arc::new(now.clone()), Arc::clone))
}
