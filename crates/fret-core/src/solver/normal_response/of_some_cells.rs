//! The response of some cells of a region, about: of near cells as it is, of those far away from a coarser grid; and an inverse of near cells alone.

use ndarray::ArrayView2;

use super::far::FarField;
use super::near::{NearSums, REACH};
use super::operator::NormalResponse;
use crate::compliance::{SharedWorkspace, SpectralCompliance, SurfaceCompliance};
use crate::solver::contact_set::ContactSet;
use crate::solver::linear::preconditioner::Preconditioner;
use crate::solver::outcome::Work;

/// The response of some cells of a region.
pub struct SparseResponse {
    near: NearSums,
    far: FarField,
    inverse: NearSums,
    self_influence: f64,
    workspace: SharedWorkspace,
    /// Work since it was taken last; the region counts as one cell.
    work: Work,
}

impl SparseResponse {
    /// Of a region whose displacements and their approximate inverse these are; `None` where there is none: on odd or short sides, of lengths that
    /// have no product in single precision, and where one axis alone repeats.
    pub fn of(
        compliance: &mut SpectralCompliance,
        preconditioner: &mut Preconditioner,
        periodic: bool,
    ) -> Option<Self> {
        let shape = compliance.shape();
        let may_be = |cells: usize| cells.is_multiple_of(2) && cells >= 8 * REACH;
        if !shape.into_iter().all(may_be) {
            return None;
        }
        let [rows, columns] = shape;
        let (mut pulse, mut found) = (vec![0.0; rows * columns], vec![0.0; rows * columns]);
        pulse[0] = 1.0;
        compliance.normal(&pulse, &mut found);
        let kernel = ArrayView2::from_shape(shape, &found).ok()?;
        // Along an axis that repeats alone the response rises again towards the end of the period.
        let rises = |end: [usize; 2], middle: [usize; 2]| !periodic && kernel[end] > kernel[middle];
        if rises([rows - 1, 0], [rows / 2, 0]) || rises([0, columns - 1], [0, columns / 2]) {
            return None;
        }
        let far = FarField::new(&kernel, periodic)?;
        let near = NearSums::new((shape, periodic), true, |parity, offset| {
            kernel[offset.map(isize::unsigned_abs)] - FarField::between(&kernel, parity, offset)
        });
        (pulse[0], pulse[rows / 2 * columns + columns / 2]) = (0.0, 1.0);
        preconditioner.normal(&pulse, &mut found);
        let kernel = ArrayView2::from_shape(shape, &found).ok()?;
        let inverse = NearSums::new((shape, periodic), false, |_, offset| {
            let at = [0, 1].map(|axis| (shape[axis] / 2).wrapping_add_signed(offset[axis]));
            let [x, y] = offset.map(|along| along as f64 / (REACH + 1) as f64);
            window(x.hypot(y)) * kernel[at]
        });
        let self_influence = compliance.self_influence().normal;
        let workspace = SharedWorkspace::default();
        Some(Self { near, far, inverse, self_influence, workspace, work: Work::default() })
    }

    /// The work since it was taken last; the region counts as one cell.
    pub fn take_work(&mut self) -> Work {
        std::mem::take(&mut self.work)
    }

    /// Makes ready for a set of cells.
    pub fn begin(&mut self, cells: &ContactSet) {
        self.near.begin(cells);
        self.far.begin(cells);
        self.inverse.begin(cells);
    }
}

impl NormalResponse for SparseResponse {
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.work.convolutions += 1;
        self.work.full_grid_convolutions += self.far.share();
        self.near.apply(pressure, displacement);
        self.far.add(pressure, displacement, &self.workspace);
    }

    fn inverse(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.work.preconditioner_passes += 1;
        self.inverse.apply(displacement, pressure);
    }

    fn self_influence(&self) -> f64 {
        self.self_influence
    }
}

/// Wendland's function of a distance (1995), 1 at 0, and 0 from 1 on. Its spectrum in the plane is positive: what is positive definite stays so
/// under it.
fn window(distance: f64) -> f64 {
    (1.0 - distance).max(0.0).powi(4) * (4.0 * distance + 1.0)
}
