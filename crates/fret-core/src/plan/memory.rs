//! How much memory a run takes: the one place of these numbers. `benches/expected_cost.py` sets them beside what runs took.

use crate::case::Case;
use crate::model::{SurfaceGrid, Symmetry};
use crate::solver::Coupling;

/// Bytes of the process itself.
const PROCESS: usize = 15 << 20;
/// Bytes a cell while a case is planned: the gap, a friction map, and copies of both for the mirrors.
pub const PLANNING: usize = 48;

/// Bytes a cell of `[the whole grid, what the solver holds in front of the mirrors]`.
///
/// The whole: the state before and after, the gap, the influence coefficients, what a checkpoint is written from. In front of the mirrors: the
/// transformed kernels of each operator in double and single precision, their work space, and the fields of the iterations.
fn bytes_per_cell(coupling: Coupling, periodic: bool) -> [usize; 2] {
    let _ = periodic;
    match coupling {
        Coupling::Frictionless => [8 * 17, 8 * 40],
        Coupling::Uncoupled => [8 * 32, 8 * 88],
        Coupling::Coupled => [8 * 50, 8 * 112],
    }
}

/// Memory of a run at the most [bytes], without kept fields: of the process, of the fields of the whole grid, of the operators and
/// fields of the solver in front of the mirrors.
pub fn of_run(case: &Case, grid: &SurfaceGrid, coupling: Coupling, symmetry: Symmetry) -> usize {
    let [whole, in_front] = bytes_per_cell(coupling, case.periodic);
    PROCESS + grid.len() * (whole + in_front / symmetry.copies())
}

/// Bytes of all fields that a case keeps: on disk, or in memory where the history holds them.
pub fn of_kept_fields(case: &Case, grid: &SurfaceGrid) -> usize {
    case.kept_increments().len() * grid.len() * case.output.fields.iter().map(|name| bytes_of(name)).sum::<usize>()
}

/// Bytes a cell of a field that can be kept.
fn bytes_of(name: &str) -> usize {
    match name {
        "shear" | "slip" => 16,
        "zone" => 1,
        _ => 8,
    }
}
