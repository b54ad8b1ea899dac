//! The elastic operators of a region, with what solves linear problems there; and the method they serve.

use super::linear::preconditioner::Preconditioner;
use super::linear::solver::LinearSolver;
use super::outcome::Work;
use super::region::Region;
use super::settings::{Coupling, SolveError, SolverSettings};
use crate::compliance::{CellResponse, SpectralCompliance};

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
    /// Iterations of the exact Newton method so far.
    pub direct_solves: usize,
}

impl RegionOperators {
    /// Applications, passes of the preconditioner and direct solves so far.
    pub fn work(&self) -> [usize; 3] {
        [self.compliance.applications, self.preconditioner.passes, self.direct_solves]
    }

    /// The work since it was `before`; the region is this `fraction` of the whole grid.
    pub fn work_since(&self, before: [usize; 3], fraction: f64) -> Work {
        let now = self.work();
        let [convolutions, preconditioner_passes, direct_solves] = [0, 1, 2].map(|k| now[k] - before[k]);
        let full_grid_convolutions = convolutions as f64 * fraction;
        Work { convolutions, full_grid_convolutions, preconditioner_passes, direct_solves, ..Work::default() }
    }
}

/// What an increment is solved with besides its operators.
pub struct Method<'a> {
    pub coupling: Coupling,
    pub settings: &'a SolverSettings,
    /// The response of a cell to another, for the exact Newton method.
    pub cells: &'a dyn Fn() -> Result<CellResponse, SolveError>,
}
