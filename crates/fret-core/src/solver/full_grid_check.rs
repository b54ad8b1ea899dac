//! What lies outside the region of an increment: the gap of the whole grid, whether surfaces overlap there or touch at its edge, the
//! area of contact.

use ndarray::Array2;

use super::contact_edge::{NEAR, contact_cells};
use super::ends::Ends;
use super::increment_problem::Solved;
use super::region::Region;
use super::{ContactSolver, Coupling, SolveError};
use crate::compliance::{OperatorSet, SpectralCompliance, SurfaceCompliance};
use crate::model::{BEYOND_THE_BODY, ContactState};

impl ContactSolver<'_> {
    /// Gap on the whole grid from tractions in a region; where that is all of it, taken out of the solution.
    pub(super) fn gap_everywhere(
        &mut self,
        region: Region,
        solved: &mut Solved,
        state: &ContactState,
    ) -> Result<Array2<f64>, SolveError> {
        let cells = self.grid.cells();
        let whole = Region::whole(cells);
        if region == whole
            && let Ok(gap) = Array2::from_shape_vec(cells, std::mem::take(&mut solved.solution.gap))
        {
            self.full_grid = None;
            return Ok(gap);
        }
        let mut gap = Array2::zeros(cells);
        let coupled = self.coupling == Coupling::Coupled;
        let give = if self.full_grid.is_none() { self.give_in(whole) } else { Vec::new() };
        let operator = match &mut self.full_grid {
            Some(operator) => operator,
            none => {
                let operators = OperatorSet {
                    normal: !coupled,
                    normal_from_all: coupled,
                    shear_axis: self.shear_axis,
                    symmetry: self.symmetry,
                    ..OperatorSet::default()
                };
                let mut operator = SpectralCompliance::new(self.response.get(), cells, operators)?;
                operator.set_give(give);
                none.insert(operator.working_in(&self.workspace))
            }
        };
        let flat = |field| whole.gathered(field);
        let (pressure, displacement) = (flat(&state.pressure), gap.as_slice_mut().unwrap_or_default());
        if coupled {
            let [x, y] = state.shear.each_ref().map(flat);
            operator.normal_from_all(&pressure, [&x, &y], displacement);
        } else {
            operator.normal(&pressure, displacement);
        }
        self.work.convolutions += 1;
        self.work.full_grid_convolutions += 1.0 / self.symmetry.copies() as f64;
        gap.zip_mut_with(&self.undeformed, |gap, undeformed| *gap += undeformed - state.approach);
        Ok(gap)
    }

    /// Whether the surfaces would overlap somewhere outside the region.
    pub(super) fn overlaps_outside(&self, region: Region, gap: &Array2<f64>) -> bool {
        region != Region::whole(self.grid.cells())
            && gap.indexed_iter().any(|((i, j), gap)| *gap < 0.0 && !region.contains(i, j))
    }

    /// Contact area [length^2] from the edge between the cells of a region, of the `pressure` and the `gap` of the grid.
    pub(super) fn contact_area(&self, region: Region, pressure: &Array2<f64>, gap: &Array2<f64>) -> f64 {
        // A region may end one cell beyond the contact; of an axis that repeats all is asked.
        let cells = self.grid.cells();
        let repeats = self.repeats();
        let region = region.widened([0, 1].map(|axis| if repeats[axis] { cells[axis] } else { NEAR }), cells);
        let [pressure, gap] = [pressure, gap].map(|field| region.view(field));
        let beyond = self.beyond_the_body();
        let of_grid = self.ends();
        let ends = [0, 1].map(|axis| if region.origin[axis] == 0 { of_grid[axis] } else { Ends::Open });
        let cells = contact_cells(&pressure, &gap, beyond, ends);
        let cells = cells * self.symmetry.copies() as f64;
        cells * self.grid.cell_area()
    }

    /// A gap that no body has: it lies between those of bodies and the one beyond their end [length].
    pub(super) fn beyond_the_body(&self) -> f64 {
        let [cells_x, cells_y] = self.symmetry.whole_of(self.grid.cells());
        let [dx, dy] = self.grid.spacing();
        0.5 * BEYOND_THE_BODY * (cells_x as f64 * dx).hypot(cells_y as f64 * dy)
    }

    /// What lies beyond the first and the last cells of the grid.
    pub(super) fn ends(&self) -> [Ends; 2] {
        let (mirrored, repeats) = (self.symmetry.axes(), self.repeats());
        [0, 1].map(|axis| Ends::of(mirrored[axis], repeats[axis]))
    }

    /// Whether the contact repeats along x and along y.
    fn repeats(&self) -> [bool; 2] {
        if self.response.is_periodic() { [true; 2] } else { self.periodic.axes() }
    }

    /// Whether there is pressure in an outermost row or column, apart from those at a mirror and those where the contact repeats.
    pub(super) fn touches_edge(&self, pressure: &Array2<f64>) -> bool {
        let mirrored = self.symmetry.axes();
        let repeats = self.repeats();
        let (nx, ny) = pressure.dim();
        let any = |view: ndarray::ArrayView1<'_, f64>| view.iter().any(|p| *p > 0.0);
        let across = || (!mirrored[0] && any(pressure.row(0))) || any(pressure.row(nx - 1));
        let along = || (!mirrored[1] && any(pressure.column(0))) || any(pressure.column(ny - 1));
        // a line contact has no edge along its line
        (!repeats[0] && across()) || (ny > 1 && !repeats[1] && along())
    }
}
