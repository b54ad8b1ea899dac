//! The question made numerical, before any work: grid, sizes, what is computed and what is left out and why.

mod advance;
mod edge;
mod extent;
mod left_out;
mod loaded;
mod memory;
mod moving;
mod precision;
mod simplification;
mod sliding_extent;
mod symmetry;

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::case::{Case, CaseError, CaseRecord, Difference, GridSize};
use crate::history::Start;
use crate::kernel::{PairResponse, cells_too_coarse_for_incompressible_film};
use crate::machine::memory::{MemoryError, claim};
use crate::model::{Body, ContactState, Frame, SurfaceGrid, Symmetry};
pub use crate::solver::Coupling;
pub use advance::Advance;
pub(crate) use edge::way_from_the_edge;
use extent::{COARSE, Unexpected, automatic_size, expected_contact, reaches_beyond};
pub use extent::{ExpectedContact, over_body};
pub use left_out::LeftOut;
pub use memory::of_stress as memory_of_stress;
pub use moving::not_in_whole_cells;
use moving::{in_whole_cells, is_displaced, with_room_to_move};
pub use simplification::{LeaveOut, Simplification};
use sliding_extent::with_room_to_slide;

/// A case ready to be computed.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Plan<C = Case> {
    /// The question.
    pub case: C,
    /// The state its history starts from; `None`: bodies that have not touched yet.
    #[serde(skip)]
    pub start: Option<Arc<Start>>,
    /// The grid.
    pub grid: SurfaceGrid,
    /// Depth below the load of the point that approach and shift are relative to [length], in each body with an elastic base; of a
    /// line contact, and of one that is periodic along one axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub datum: Option<f64>,
    /// How pressure and shear act on each other.
    pub coupling: Coupling,
    /// The one axis (0: x, 1: y) along which shear acts, where the other part vanishes.
    pub along: Option<usize>,
    /// Whether the gap is that of surfaces that move against each other.
    #[serde(default, skip_serializing_if = "is_false")]
    pub moves: bool,
    /// Mirrors of scene and loads, in front of which the solver works.
    pub symmetry: Symmetry,
    /// Single precision does in linear problems and approximate inverses.
    pub single_precision: bool,
    /// The simplifications that may be made.
    pub leave_out: LeaveOut,
    /// What is left out.
    pub left_out: Vec<LeftOut>,
    /// The contact that is expected under the heaviest load; `None` where only the run can tell: on rough and on periodic surfaces, and
    /// where a body ends with the grid.
    pub expected: Option<ExpectedContact>,
    /// Increments of the whole history.
    pub increments: usize,
    /// Memory expected at the most [bytes], without the kept fields.
    pub memory_bytes: usize,
    /// Size of the kept fields [bytes]: on disk, or in memory where the history holds them.
    pub kept_bytes: usize,
}

/// A plan as a record of a run has it.
pub type PlanRecord = Plan<CaseRecord>;

impl<C: Serialize> Plan<C> {
    /// The plan as it is written down.
    pub fn to_json(&self) -> Value {
        serde_json::to_value(self).unwrap_or_default() // a plan holds nothing that JSON has no form for
    }
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
        Self::starting_from(None, case, leave_out)
    }

    /// Plans a case whose history starts from a solved state, which it has been read with; from bodies apart without one.
    ///
    /// # Errors
    /// As [`Plan::new`]; when the state is one of another grid, other bodies or another profile.
    pub fn starting_from(
        start: Option<Arc<Start>>,
        case: Case,
        leave_out: LeaveOut,
    ) -> Result<Self, CaseError> {
        let state = start.as_deref().map(|start| &start.solved.state);
        let response = PairResponse::new(&case.bodies);
        let sheared = |state: &ContactState| state.shear.iter().flatten().any(|shear| *shear != 0.0);
        let frictionless = case.is_frictionless() && !state.is_some_and(sheared);
        let uncoupled = frictionless || response.is_uncoupled() && !becomes_dissimilar(&case);
        let coupling = if frictionless && leave_out.takes(Simplification::Tangential) {
            Coupling::Frictionless
        } else if uncoupled && leave_out.takes(Simplification::Coupling) {
            Coupling::Uncoupled
        } else {
            Coupling::Coupled
        };
        let expected = if !case.periodic.is_none() || !case.beyond.is_body() {
            Err(Unexpected::NoContact)
        } else {
            expected_contact(&case)
        };
        let size = match case.size {
            GridSize::Given(size) => size,
            GridSize::Auto => {
                if let Some(spacing) = start.as_deref().and_then(Start::spacing) {
                    [0, 1].map(|axis| spacing[axis] * case.cells[axis] as f64)
                } else {
                    let contact = expected.map_err(|why| without_size(&case, why))?;
                    let size = automatic_size(&case, &contact);
                    let size =
                        if coupling == Coupling::Coupled { with_room_to_slide(&case, size) } else { size };
                    with_room_to_move(&case, size)
                }
            }
        };
        let expected = expected.ok();
        can_be_meant(&case, expected.as_ref())?;
        let given = [size[0] / case.cells[0] as f64, size[1] / case.cells[1] as f64];
        let same = start.as_deref().filter(|start| start.has_spacing(given));
        let spacing = same.and_then(Start::spacing).unwrap_or(given);
        let grid =
            SurfaceGrid::new(case.cells, spacing).map_err(|error| case.refuse_size(error.to_string(), ""))?;
        let _planning = claim(memory::PLANNING * grid.len()).map_err(|error| {
            case.refuse_size(format!("grid.cells = {:?}: planning {error}", case.cells), "").for_memory()
        })?;
        if !has_a_body(&case, &grid) {
            let message =
                format!("grid.size = {size:?}: no cell centre lies on the body, which ends between them");
            return Err(case.refuse_size(message, "more cells, or a smaller grid"));
        }
        has_values(&case, &grid)?;
        if !case.periodic.is_both() && has_unseen_film(&case, &grid) {
            let message = format!(
                "grid.cells = {:?}: a nearly incompressible film on a stiff base is thinner than a fifth of a cell; it moves \
                 sideways between the cells' centres, where displacements are taken, which the grid cannot resolve",
                case.cells
            );
            return Err(case.refuse_size(
                message,
                "cells no longer than five thicknesses: more of them, or a smaller grid",
            ));
        }
        let is_given = matches!(case.size, GridSize::Given(_)) || start.is_some();
        if is_given && case.periodic.is_none() && case.beyond.is_body() && reaches_beyond(&case, size) {
            let message = format!(
                "grid.size = {size:?}: the contact under the heaviest load reaches the edge of the grid"
            );
            return Err(case.refuse_size(message, way_from_the_edge(&case)));
        }
        in_whole_cells(&case, &grid)?;
        let endless = case.endless_axis().filter(|_| case.bodies.has_elastic_base());
        let datum = endless.map(|along| case.datum.unwrap_or(size[1 - along]));
        let along = left_out::one_way(&case, &grid, &response, coupling, state)
            .filter(|_| leave_out.takes(Simplification::Transverse));
        let is_displaced = is_displaced(&case, &grid, state);
        // What each body has worn in its own frame is put together like surfaces that move.
        let moves = is_displaced || case.kinematics.is_finite() && case.wear.is_some();
        let symmetry = mirrors(&case, &grid, coupling, state, leave_out);
        let single_precision = leave_out.takes(Simplification::Precision)
            && precision::single_precision_does(&case, &grid, &response, coupling);
        let decided = (along, symmetry, single_precision, [moves, is_displaced]);
        let left_out = left_out::left_out(&case, &grid, coupling, decided, leave_out);
        let increments = case.increments();
        let plan = Self {
            memory_bytes: memory::of_run(&case, &grid, coupling, symmetry),
            kept_bytes: memory::of_kept_fields(&case, &grid),
            case,
            start,
            grid,
            datum,
            coupling,
            along,
            moves,
            symmetry,
            single_precision,
            leave_out,
            left_out,
            expected,
            increments,
        };
        plan.judge_start()?;
        Ok(plan)
    }

    /// Area of the whole contact that a cell in front of the mirrors stands for [length^2].
    pub fn area_of_cell(&self) -> f64 {
        self.grid.cell_area() * self.symmetry.copies() as f64
    }

    /// Refuses a state of another setting.
    fn judge_start(&self) -> Result<(), CaseError> {
        let Some(start) = &self.start else { return Ok(()) };
        let mut differences = start.differences(&self.to_json());
        differences.extend(self.marks_that_stay());
        if differences.is_empty() { Ok(()) } else { Err(self.case.refuse_start(&differences)) }
    }

    /// Marks of wear and yielding in the state to start from, which the frame of a contact that rolls would leave behind.
    fn marks_that_stay(&self) -> Option<Difference> {
        let state = &self.start.as_ref()?.solved.state;
        let is_marked = [&state.worn_depth, &state.upper_worn_depth, &state.debris, &state.plastic_depth]
            .iter()
            .any(|mark| mark.as_ref().is_some_and(|depth| depth.iter().any(|depth| *depth != 0.0)));
        let rolls_on = self.case.rolls() && self.case.kinematics.frame == Frame::Contact;
        (rolls_on && is_marked).then(|| Difference {
            key: "kinematics.frame".to_owned(),
            case: "\"contact\"".to_owned(),
            state: "surfaces that have worn or yielded, which \"bodies\" carries along".to_owned(),
        })
    }

    /// Finds anew what follows from the case and the grid, after these were changed: mirrors, increments, memory.
    ///
    /// # Errors
    /// When there is no memory to look for mirrors.
    pub(crate) fn follow(&mut self) -> Result<(), MemoryError> {
        let _planning = claim(memory::PLANNING * self.grid.len())?;
        let Self { case, grid, coupling, start, .. } = self;
        let state = start.as_deref().map(|start| &start.solved.state);
        self.symmetry = mirrors(case, grid, *coupling, state, self.leave_out);
        self.increments = case.increments();
        self.memory_bytes = memory::of_run(case, grid, *coupling, self.symmetry);
        self.kept_bytes = memory::of_kept_fields(case, grid);
        Ok(())
    }
}

/// Refuses an automatic size, since the contact is not known.
fn without_size(case: &Case, why: Unexpected) -> CaseError {
    let auto = "grid.size = \"auto\": ";
    let (message, help) = match why {
        Unexpected::NoContact => {
            (format!("{auto}no contact was found under the heaviest load"), "give the side lengths")
        }
        Unexpected::UnseenFilm => (
            format!(
                "{auto}a nearly incompressible film on a stiff base is thinner than a fifth of a cell of the {COARSE} x {COARSE} that \
                 the contact was looked for with; it moves sideways between the cells' centres, where displacements are taken, which \
                 such a grid cannot resolve"
            ),
            "give the side lengths, with cells no longer than five thicknesses",
        ),
        Unexpected::Datum(size) => (
            format!(
                "{auto}grid.datum = {:?} must lie between a thousandth and 1e12 of the size of the grid, which the contact makes about {size:.1e}",
                case.datum.unwrap_or(0.0)
            ),
            "without grid.datum the size of the grid serves",
        ),
        Unexpected::Unsolved => (
            format!("{auto}the contact under the heaviest load was not solved on a coarse grid"),
            "give the side lengths; check moduli, lengths and loads for extreme values",
        ),
    };
    case.refuse_size(message, help)
}

/// Refuses a contact wider than the body that makes it, of a case in units: a length, a modulus or a load in another unit than the declared
/// one. Without units it may be a contact in numbers without dimension, of which a warning tells.
fn can_be_meant(case: &Case, expected: Option<&ExpectedContact>) -> Result<(), CaseError> {
    let over_body = expected.map_or(0.0, |contact| over_body(case, contact.half_widths));
    let Some(units) = case.units.as_ref().filter(|_| over_body > 1.0) else { return Ok(()) };
    let message = format!(
        "contact radius over body radius: {over_body:.3}, a contact wider than its body: a number is in another unit than the declared ones"
    );
    let help = format!(
        "lengths of the profile in {}, forces in {}, moduli in {}; or loads that are meant",
        units.of("length"),
        units.of("force"),
        units.of("pressure")
    );
    Err(case.refuse_table("profile", message, help))
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !*value
}

fn mirrors(
    case: &Case,
    grid: &SurfaceGrid,
    coupling: Coupling,
    start: Option<&ContactState>,
    leave_out: LeaveOut,
) -> Symmetry {
    if leave_out.takes(Simplification::Mirror) {
        symmetry::symmetry(case, grid, coupling, start)
    } else {
        Symmetry::NONE
    }
}

/// Whether bodies that are similar now need not stay so, since their coatings wear thinner.
fn becomes_dissimilar(case: &Case) -> bool {
    let thins = case.wear.as_ref().is_some_and(|wear| wear.thinning_tolerance.is_some());
    let coated = |body: &Body| matches!(body, Body::Elastic(half_space) if !half_space.coatings().is_empty());
    thins && (coated(case.bodies.upper()) || coated(case.bodies.lower()))
}

/// Whether both bodies are there in any cell.
fn has_a_body(case: &Case, grid: &SurfaceGrid) -> bool {
    let centres = [0, 1].map(|axis| grid.centres(axis));
    let there = |x: f64| centres[1].iter().any(|y| case.profile.gap_of_shapes_at(x, *y).is_finite());
    centres[0].iter().any(|x| there(*x))
}

/// Refuses a formula that has no value at a cell.
fn has_values(case: &Case, grid: &SurfaceGrid) -> Result<(), CaseError> {
    let Some([x, y]) = case.profile.undefined_on(grid) else { return Ok(()) };
    let message = format!(
        "grid.cells = {:?}: the formula of the profile has no finite value at x = {x:?}, y = {y:?}",
        case.cells
    );
    Err(case.refuse_size(message, "other cells, or a formula with a value everywhere"))
}

/// Whether a body has a film that the cells are too coarse for.
fn has_unseen_film(case: &Case, grid: &SurfaceGrid) -> bool {
    [case.bodies.upper(), case.bodies.lower()].into_iter().any(|body| match body {
        Body::Rigid => false,
        Body::Elastic(half_space) => cells_too_coarse_for_incompressible_film(half_space, grid.spacing()),
    })
}
