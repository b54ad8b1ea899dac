//! The elastic operators of a region, with what solves linear problems there; and the method they serve.

use std::mem::take;

use super::linear::preconditioner::{CellWaves, Preconditioner};
use super::linear::solver::LinearSolver;
use super::normal_response::{NormalResponse, SparseResponse};
use super::outcome::Work;
use super::region::Region;
use super::settings::SolverSettings;
use crate::compliance::{
    OperatorSet, SharedWorkspace, SpectralCompliance, SurfaceCompliance, SurfaceResponse,
};
use fret_fft::ConvolutionError;

/// The operators of a region.
pub struct RegionOperators {
    /// Where the region lies.
    pub region: Region,
    /// The elastic response.
    pub compliance: SpectralCompliance,
    /// Its approximate inverse.
    pub preconditioner: Preconditioner,
    /// Solver of linearised problems.
    pub linear: LinearSolver,
    /// The response to pressure of some cells, where it was made.
    pub sparse: Option<SparseResponse>,
    /// How many cells of the whole contact each cell stands for, and whether the scene repeats.
    pub copies: usize,
    pub is_periodic: bool,
    /// Work on coarser grids since the work was taken last, their cells counted as those of the region.
    pub coarse_work: Work,
    /// Steps of Newton's method with iterates that need not be feasible since the work was taken last.
    pub augmented_steps: usize,
}

impl RegionOperators {
    /// The operators of a region, at work in a given memory. `waves` serves in free space.
    ///
    /// # Errors
    /// When a coefficient is missing or does not cover the region.
    pub fn new(
        response: &SurfaceResponse,
        waves: Option<CellWaves<'_>>,
        region: Region,
        operators: OperatorSet,
        workspace: &SharedWorkspace,
    ) -> Result<Self, ConvolutionError> {
        let compliance = SpectralCompliance::new(response, region.shape, operators)?;
        let preconditioner = Preconditioner::new(response, waves, region.shape, operators)?;
        Ok(Self {
            region,
            compliance: compliance.working_in(workspace),
            preconditioner: preconditioner.working_in(workspace),
            linear: LinearSolver::default(),
            sparse: None,
            copies: operators.symmetry.copies(),
            is_periodic: response.is_periodic(),
            coarse_work: Work::default(),
            augmented_steps: 0,
        })
    }

    /// The response of some cells, where there is one: behind mirrors there is none.
    pub fn sparse_response(&mut self) -> Option<SparseResponse> {
        let Self { compliance, preconditioner, copies: 1, is_periodic, .. } = self else { return None };
        SparseResponse::of(compliance, preconditioner, *is_periodic)
    }

    /// Keeps the response of some cells, and counts its work.
    pub fn keep_sparse(&mut self, mut response: Option<SparseResponse>) {
        if let Some(response) = &mut response {
            self.coarse_work += response.take_work();
        }
        self.sparse = response;
    }

    /// The work since it was taken last; the region counts as this `fraction` of the whole grid.
    pub fn take_work(&mut self, fraction: f64) -> Work {
        let convolutions = take(&mut self.compliance.applications);
        let mut work = take(&mut self.coarse_work);
        work.full_grid_convolutions *= fraction;
        work += Work {
            convolutions,
            full_grid_convolutions: convolutions as f64 * fraction,
            preconditioner_passes: take(&mut self.preconditioner.passes),
            augmented_steps: take(&mut self.augmented_steps),
            ..Work::default()
        };
        work
    }
}

impl NormalResponse for RegionOperators {
    fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.compliance.normal(pressure, displacement);
    }

    fn inverse(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.preconditioner.normal(displacement, pressure);
    }

    fn self_influence(&self) -> f64 {
        self.compliance.self_influence().normal
    }
}

/// What an increment is solved with besides the operators of its region.
pub struct Method<'a> {
    pub settings: &'a SolverSettings,
    /// The response that these operators were made of, and with what they were.
    pub response: &'a dyn Fn() -> &'a SurfaceResponse,
    pub waves: Option<CellWaves<'a>>,
    pub operators: OperatorSet,
}
