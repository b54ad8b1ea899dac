//! The question made numerical, before any work: grid, sizes, what is computed and what is left out and why.

mod digits;
mod extent;
mod left_out;
mod symmetry;

use serde::Serialize;

use crate::case::{Case, CaseError, GridSize, Stage};
use crate::kernel::{PairResponse, cells_too_coarse_for_incompressible_film};
use crate::model::{Body, SurfaceGrid, Symmetry};
pub use crate::solver::{Coupling, LeaveOut, Shortcut};
pub use extent::ExpectedContact;
use extent::{automatic_size, expected_contact, reaches_beyond};

/// Something the scene does not need.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// What is not computed.
    pub what: String,
    /// Why the answer is the same without it.
    pub why: String,
    /// What that saves.
    pub saves: String,
}

/// A case ready to be computed.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// The question.
    pub case: Case,
    /// The grid.
    pub grid: SurfaceGrid,
    /// How pressure and shear act on each other.
    pub coupling: Coupling,
    /// The one axis (0: x, 1: y) along which shear acts, where the other part vanishes.
    pub along: Option<usize>,
    /// Mirrors of scene and loads, in front of which the solver works.
    pub symmetry: Symmetry,
    /// Six digits do on frozen zones and in approximate inverses.
    pub six_digits: bool,
    /// The shortcuts that may be taken.
    pub leave_out: LeaveOut,
    /// What is left out.
    pub left_out: Vec<LeftOut>,
    /// The contact that is expected under the heaviest load; `None` where only the run can tell: on rough and on periodic surfaces.
    pub expected: Option<ExpectedContact>,
    /// Increments of the whole history.
    pub increments: usize,
    /// Memory expected at the most [bytes].
    pub memory_bytes: usize,
    /// Operator applications expected, by the experience of earlier runs; at the least, where increments are "auto".
    pub convolutions_expected: usize,
}

impl Plan {
    /// Plans a case.
    ///
    /// # Errors
    /// When the contact would not fit into the grid.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        Self::leaving_out(case, LeaveOut::ALL)
    }

    /// Plans a case that takes these shortcuts alone where the scene allows them: the answer is the same, the work is not.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn leaving_out(case: Case, leave_out: LeaveOut) -> Result<Self, CaseError> {
        let response = PairResponse::new(&case.bodies);
        let frictionless = case.is_frictionless();
        let uncoupled = frictionless || response.is_uncoupled();
        let coupling = if frictionless && leave_out.takes(Shortcut::Tangential) {
            Coupling::Frictionless
        } else if uncoupled && leave_out.takes(Shortcut::Coupling) {
            Coupling::Uncoupled
        } else {
            Coupling::Coupled
        };
        let expected = if case.periodic { None } else { expected_contact(&case) };
        let size = match case.size {
            GridSize::Given(size) => size,
            GridSize::Auto => expected.as_ref().map(automatic_size).ok_or_else(|| {
                let message = "grid.size = \"auto\": no contact was found under the heaviest load".to_owned();
                case.refuse_size(message, "give the side lengths")
            })?,
        };
        let spacing = [size[0] / case.cells[0] as f64, size[1] / case.cells[1] as f64];
        let grid =
            SurfaceGrid::new(case.cells, spacing).map_err(|error| case.refuse_size(error.to_string(), ""))?;
        if !has_a_body(&case, &grid) {
            let message =
                format!("grid.size = {size:?}: no cell centre lies on the body, which ends between them");
            return Err(case.refuse_size(message, "more cells, or a smaller grid"));
        }
        if !case.periodic && has_unseen_film(&case, &grid) {
            let message = format!(
                "grid.cells = {:?}: a nearly incompressible film on a stiff base is thinner than a fifth of a cell; it moves \
                 sideways between the cells' centres, where displacements are taken, and the grid does not see it",
                case.cells
            );
            return Err(case.refuse_size(
                message,
                "cells no longer than five thicknesses: more of them, or a smaller grid",
            ));
        }
        if matches!(case.size, GridSize::Given(_)) && !case.periodic && reaches_beyond(&case, size) {
            let message = format!(
                "grid.size = {size:?}: the contact under the heaviest load reaches the edge of the grid"
            );
            return Err(case.refuse_size(message, "enlarge it, or write size = \"auto\""));
        }
        let along = left_out::one_way(&case, &grid, &response, coupling)
            .filter(|_| leave_out.takes(Shortcut::Transverse));
        let symmetry = mirrors(&case, &grid, coupling, leave_out);
        let six_digits =
            leave_out.takes(Shortcut::Digits) && digits::six_digits_do(&case, &grid, &response, coupling);
        let left_out = left_out::left_out(&case, &grid, coupling, (along, symmetry, six_digits), leave_out);
        let increments = case.increments();
        // Where the division is left to the program: one solution of the whole and two of its halves at the least.
        let least = |stage: &Stage| if stage.history_tolerance.is_some() { 3_usize } else { 1 };
        let solutions: usize =
            case.stages.iter().map(|stage| least(stage).saturating_mul(stage.increments_in_all())).sum();
        let per_increment = match coupling {
            Coupling::Frictionless => 12,
            Coupling::Uncoupled | Coupling::Coupled => 20,
        };
        Ok(Self {
            memory_bytes: memory(&case, &grid, coupling, symmetry),
            convolutions_expected: solutions * per_increment,
            case,
            grid,
            coupling,
            along,
            symmetry,
            six_digits,
            leave_out,
            left_out,
            expected,
            increments,
        })
    }

    /// The mirrors of its case on its grid.
    pub(crate) fn mirrors(&self) -> Symmetry {
        mirrors(&self.case, &self.grid, self.coupling, self.leave_out)
    }
}

fn mirrors(case: &Case, grid: &SurfaceGrid, coupling: Coupling, leave_out: LeaveOut) -> Symmetry {
    if leave_out.takes(Shortcut::Mirror) { symmetry::symmetry(case, grid, coupling) } else { Symmetry::NONE }
}

/// Whether both bodies are there in any cell.
fn has_a_body(case: &Case, grid: &SurfaceGrid) -> bool {
    let centres = [0, 1].map(|axis| grid.centres(axis));
    let there = |x: f64| centres[1].iter().any(|y| case.profile.gap_of_shapes_at(x, *y).is_finite());
    centres[0].iter().any(|x| there(*x))
}

/// Whether a body has a film that the cells are too coarse for.
fn has_unseen_film(case: &Case, grid: &SurfaceGrid) -> bool {
    [case.bodies.upper(), case.bodies.lower()].into_iter().any(|body| match body {
        Body::Rigid => false,
        Body::Elastic(half_space) => cells_too_coarse_for_incompressible_film(half_space, grid.spacing()),
    })
}

/// Memory of a run at the most [bytes]: of the process, of the fields of the whole grid, of the operators and fields of the solver
/// in front of the mirrors, of the kept fields. All but the last bound what runs of 128 to 512 cells a side took on two threads
/// whose contact fills the grid, by a fifth at the most; a contact that leaves room takes less.
fn memory(case: &Case, grid: &SurfaceGrid, coupling: Coupling, symmetry: Symmetry) -> usize {
    const PROCESS: usize = 10 << 20;
    let [whole, in_front] = match coupling {
        Coupling::Frictionless => [17, 40],
        Coupling::Uncoupled => [32, 88],
        Coupling::Coupled => [50, 112],
    };
    let numbers_per_cell = whole + in_front / symmetry.copies();
    let bytes_of = |name: &String| match name.as_str() {
        "shear" | "slip" => 16,
        "zone" => 1,
        _ => 8,
    };
    let kept: usize = case.output.fields.iter().map(bytes_of).sum();
    PROCESS + grid.len() * (8 * numbers_per_cell + case.kept_increments().len() * kept)
}
