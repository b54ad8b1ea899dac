//! What lies outside the box: the gap of the whole grid, whether surfaces overlap or touch at its edge, the area of contact.

use ndarray::{Array2, ArrayView2};

use super::region::Region;
use super::scene::Solved;
use super::{ContactSolver, Coupling};
use crate::compliance::{SpectralCompliance, SurfaceCompliance, Wanted};
use crate::edge;
use crate::history::Work;
use crate::model::{BEYOND_THE_BODY, ContactState};

impl ContactSolver<'_> {
    /// Gap on the whole grid from tractions in a box.
    pub(super) fn gap_everywhere(
        &mut self,
        region: Region,
        solved: &Solved,
        state: &ContactState,
        work: &mut Work,
    ) -> Array2<f64> {
        let cells = self.grid.cells();
        let whole = Region::whole(cells);
        let mut gap = Array2::zeros(cells);
        if region == whole {
            whole.scatter(&solved.gap, &mut gap);
            return gap;
        }
        gap.assign(&self.undeformed);
        gap -= state.approach;
        if self.outside.is_none() {
            let wanted = Wanted {
                normal: self.coupling != Coupling::Coupled,
                normal_from_all: self.coupling == Coupling::Coupled,
                along: self.along,
                symmetry: self.symmetry,
                ..Wanted::default()
            };
            self.outside = SpectralCompliance::new(&self.response, cells, wanted).ok();
        }
        if let Some(outside) = &mut self.outside {
            let mut normal = vec![0.0; whole.len()];
            let pressure = whole.gather(&state.pressure);
            if self.coupling == Coupling::Coupled {
                outside.normal_from_all(&pressure, &whole.gather_tangential(&state.shear), &mut normal);
            } else {
                outside.normal(&pressure, &mut normal);
            }
            work.convolutions += 1;
            work.full_grid_convolutions += 1.0 / self.symmetry.copies() as f64;
            for (gap, u) in gap.iter_mut().zip(&normal) {
                *gap += u;
            }
        }
        gap
    }

    /// Whether the surfaces would overlap somewhere outside the box.
    pub(super) fn overlaps_outside(&self, region: Region, gap: &Array2<f64>) -> bool {
        region != Region::whole(self.grid.cells())
            && gap.indexed_iter().any(|((i, j), gap)| *gap < 0.0 && !region.contains(i, j))
    }

    /// Contact area [length^2] from the edge between the cells of a box.
    pub(super) fn contact_area(&self, region: Region, solved: &Solved) -> f64 {
        let view = |field| ArrayView2::from_shape(region.shape, field);
        let (Ok(pressure), Ok(gap)) =
            (view(solved.tractions.pressure.as_slice()), view(solved.gap.as_slice()))
        else {
            return 0.0;
        };
        let [cells_x, cells_y] = self.symmetry.whole_of(self.grid.cells());
        let [dx, dy] = self.grid.spacing();
        let beyond = 0.5 * BEYOND_THE_BODY * (cells_x as f64 * dx).hypot(cells_y as f64 * dy);
        // At a mirror the edge goes on as it does at a side of the box: with the same value in the next cell.
        let cells = edge::contact_cells(&pressure, &gap, beyond) * self.symmetry.copies() as f64;
        cells * self.grid.cell_area()
    }
}

/// Whether there is pressure in an outermost row or column, apart from those at a mirror.
pub(super) fn touches_edge(pressure: &Array2<f64>, mirrored: [bool; 2]) -> bool {
    let (nx, ny) = pressure.dim();
    let any = |view: ndarray::ArrayView1<'_, f64>| view.iter().any(|p| *p > 0.0);
    // A line contact has no edge along its line.
    if ny == 1 {
        return pressure[[nx - 1, 0]] > 0.0 || !mirrored[0] && pressure[[0, 0]] > 0.0;
    }
    (!mirrored[0] && any(pressure.row(0)))
        || any(pressure.row(nx - 1))
        || (!mirrored[1] && any(pressure.column(0)))
        || any(pressure.column(ny - 1))
}
