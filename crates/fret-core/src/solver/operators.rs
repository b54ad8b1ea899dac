//! The elastic operators of a region, with what solves linear problems there; and the method they serve.

use super::linear::preconditioner::Preconditioner;
use super::linear::solver::LinearSolver;
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

/// What an increment is solved with besides its operators.
pub struct Method<'a> {
    pub coupling: Coupling,
    pub settings: &'a SolverSettings,
    /// The response of a cell to another, for the exact Newton method.
    pub cells: &'a dyn Fn() -> Result<CellResponse, SolveError>,
}
