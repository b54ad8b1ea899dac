//! The region that the contact of an increment will stay in.

use ndarray::Array2;

use super::super::normal::coarse_grids::MARGIN;
use super::super::region::Region;
use super::super::{ContactSolver, Coupling};
use crate::model::{ContactState, LoadStep};
use fret_fft::good_length;

/// Cells kept free around a contact: this fraction of its width, and no less than [`LEAST_MARGIN`].
const MARGIN_FRACTION: usize = 12;
const LEAST_MARGIN: usize = 3;

impl ContactSolver<'_> {
    /// The region of an increment that starts from a pressure on coarser grids. What sheared the surfaces before lies inside: slip is
    /// counted from its displacements.
    pub(in super::super) fn region_around(&self, pressure: &Array2<f64>, state: &ContactState) -> Region {
        let cells = self.grid.cells();
        if !self.in_region || self.response.is_periodic() {
            return Region::whole(cells);
        }
        let loaded = |i: usize, j: usize| pressure[[i, j]] > 0.0 || state.pressure[[i, j]] > 0.0;
        let axes = self.symmetry.axes();
        let margin = if self.coupling == Coupling::Coupled {
            (self.width(&Region::around(cells, axes, 1, |n| n, loaded)) / MARGIN_FRACTION).max(MARGIN)
        } else {
            MARGIN
        };
        Region::around(cells, axes, margin, good_length, loaded)
    }

    /// The region of an increment: around the contact with room to go on growing, the last one while that fits.
    pub(in super::super) fn region_for(&self, state: &ContactState, load: &LoadStep) -> Region {
        let whole = Region::whole(self.grid.cells());
        let touched = state.pressure.iter().any(|p| *p > 0.0);
        if !self.in_region || !touched || self.response.is_periodic() {
            return whole;
        }
        let (cells, axes) = (self.grid.cells(), self.symmetry.axes());
        let around = |margin: usize, good: fn(usize) -> usize| {
            Region::around(cells, axes, margin, good, |i, j| state.pressure[[i, j]] > 0.0)
        };
        let growth = self.cells_of_growth(state, load) + self.travel;
        let least = around(growth + 1, |n| n);
        let margin = (self.width(&around(1, |n| n)) / MARGIN_FRACTION).max(LEAST_MARGIN);
        let wanted = around(margin.max(growth + 2), good_length);
        match self.memory.region {
            Some(now) if now.contains_all(&least) && now.len() as f64 <= 1.6 * wanted.len() as f64 => now,
            _ => wanted,
        }
    }

    /// The larger side of a region, with what lies behind the mirrors [cells].
    fn width(&self, region: &Region) -> usize {
        let [x, y] = self.symmetry.whole_of(region.shape);
        x.max(y)
    }

    /// Cells by which the contact will grow on one side when it goes on as in the last increment.
    fn cells_of_growth(&self, state: &ContactState, load: &LoadStep) -> usize {
        let (Some(before), Some(fraction)) = (&self.memory.before, self.continuation(load)) else {
            return 0;
        };
        let (cells, axes) = (self.grid.cells(), self.symmetry.axes());
        let extent = |pressure: &Array2<f64>| Region::extent(cells, axes, |i, j| pressure[[i, j]] > 0.0);
        let (Some(then), Some(now)) = (extent(&before.tractions.pressure), extent(&state.pressure)) else {
            return 0;
        };
        let grown = (0..2).map(|axis| {
            then[axis].start.saturating_sub(now[axis].start).max(now[axis].end.saturating_sub(then[axis].end))
        });
        (grown.max().unwrap_or(0) as f64 * fraction).ceil() as usize
    }
}
