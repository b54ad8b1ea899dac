//! Why a run ends without its answer.

use super::checkpoint::Place;
use crate::case::{Case, StageControl, WAY_TO_SLIDE};
use crate::document::apart;
use crate::machine::memory::MemoryError;
use crate::plan::way_from_the_edge;
use crate::solver::{Carried, SolveError};
use crate::units::Units;

/// Why a run ended without its answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The equations could not be satisfied to the tolerance.
    #[error(
        "increment {increment} ({stage}) not solved: residual {reached:.1e} after {iterations} iterations, required {tolerance:.1e}; {advice}"
    )]
    NotConverged {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Residual reached.
        reached: f64,
        /// Residual asked for.
        tolerance: f64,
        /// Iterations made.
        iterations: usize,
        /// What to try.
        advice: String,
    },
    /// The place of surfaces that move is not found.
    #[error(
        "increment {increment} ({stage}) not solved: after {rounds} rounds the upper surface still lies {apart:.1e} cells from where its shift and twist bring it; try more increments in this stage, or prescribe the motion in place of the force"
    )]
    PlaceNotFound {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// How far it lies from there [cells].
        apart: f64,
        /// Rounds made.
        rounds: usize,
    },
    /// A contact that rolls comes to no steady state.
    #[error(
        "increment {increment} ({stage}): not steady after {increments} increments: over a length of the contact the tractions still change by {change:.1e} of their size; try a larger solver.tolerance, or a roll of some lengths of the contact in place of \"steady\""
    )]
    NotSteady {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// By how much the tractions still change, of their size.
        change: f64,
        /// Increments made.
        increments: usize,
    },
    /// The contact reaches the edge of the grid.
    #[error("increment {increment} ({stage}): the contact reaches the edge of the grid; {advice}")]
    ContactAtEdge {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// What to try.
        advice: &'static str,
    },
    /// A tangential load above what friction carries, or as large.
    #[error(
        "increment {increment} ({stage}): tangential force {}{unit} {} {}{unit}: {}; {advice}",
        apart(*asked, *bound)[0], limit(*asked, *bound, *by), apart(*asked, *bound)[1], consequence(*asked, *bound)
    )]
    AboveSliding {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Force asked for.
        asked: f64,
        /// What friction carries: mu P, or less where the shear strength of the interface bounds it.
        bound: f64,
        /// What that is.
        by: Carried,
        /// A space and the unit of both; empty where the case declares no units.
        unit: String,
        /// What to try.
        advice: &'static str,
    },
    /// Tangential force and moment together above what friction carries.
    #[error(
        "increment {increment} ({stage}): friction carries at most {fraction:.4} of the prescribed tangential force and moment: no \
         equilibrium; prescribe shift and twist to slide"
    )]
    AboveFullSlip {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Fraction of them that friction carries, at the most.
        fraction: f64,
    },
    /// A normal force above what the surfaces bear at their hardness.
    #[error(
        "increment {increment} ({stage}): normal force {}{unit} is not below the hardness times the area of the grid, {}{unit}: no equilibrium; a \
         smaller force, or a larger period",
        apart(*asked, *bound)[0], apart(*asked, *bound)[1]
    )]
    AboveHardness {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Force asked for [force].
        asked: f64,
        /// What the whole grid carries at the hardness [force].
        bound: f64,
        /// A space and the unit of both; empty where the case declares no units.
        unit: String,
    },
    /// No tilt gives the prescribed moment of the pressure.
    #[error(
        "increment {increment} ({stage}): no tilt was found for the prescribed tilt_moment {}{unit}, {}{unit} was reached: the normal force may not be \
         able to act so far from the middle; prescribe the tilt, or a smaller moment",
        apart(*asked, *reached)[0], apart(*asked, *reached)[1]
    )]
    NoTilt {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Moment asked for [force x length].
        asked: f64,
        /// Moment reached [force x length].
        reached: f64,
        /// A space and the unit of both; empty where the case declares no units.
        unit: String,
    },
    /// Even small parts of an increment leave too large an error in its history.
    #[error(
        "increment {increment} ({stage}): {parts} parts leave an error of {reached:.1e} of the way the tractions go, asked for \
         {tolerance:.1e}; try a larger solver.history_tolerance, or ramp = \"cubic\" while the contact grows"
    )]
    HistoryUnresolved {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Error reached.
        reached: f64,
        /// Error asked for.
        tolerance: f64,
        /// Parts made.
        parts: usize,
    },
    /// A mean gap is prescribed that needs the surfaces to overlap.
    #[error(
        "increment {increment} ({stage}): a mean gap of {gap:e} is prescribed, and at 0 the surfaces touch everywhere; a smaller amplitude, or beyond full contact the normal force"
    )]
    GapClosed {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// The mean gap that is prescribed [length].
        gap: f64,
    },
    /// A cycle wears the surfaces more than the grid can follow.
    #[error(
        "increment {increment} ({stage}): this cycle alone wears off {share:.2} of the stiffest wave of pressure; choose a smaller wear.coefficient (with more cycles), or coarser cells, which do not help a nearly incompressible film"
    )]
    WearTooFast {
        /// Number of the cycle's last increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Share of the stiffest wave of pressure.
        share: f64,
    },
    /// Layers are worn so thin that their elastic response cannot be followed.
    #[error(
        "increment {increment} ({stage}): the layers cannot be followed any further: {reason}; wear.limit = ... ends the run before"
    )]
    WornTooThin {
        /// Number of the cycle's last increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Why.
        reason: String,
    },
    /// There is not the memory for the run, or for the fields that it keeps.
    #[error("increment {increment}: {error}")]
    OutOfMemory {
        /// Number of the increment that was not begun or not kept, from 0.
        increment: usize,
        /// What is needed and what there is.
        error: MemoryError,
    },
    /// The observer stopped the run.
    #[error("interrupted at increment {increment}")]
    Interrupted {
        /// Number of the increment that was not finished, from 0.
        increment: usize,
    },
}

impl RunError {
    /// Number of the increment that has no answer, from 0.
    pub fn increment(&self) -> usize {
        match self {
            Self::NotConverged { increment, .. }
            | Self::PlaceNotFound { increment, .. }
            | Self::NotSteady { increment, .. }
            | Self::ContactAtEdge { increment, .. }
            | Self::AboveSliding { increment, .. }
            | Self::AboveFullSlip { increment, .. }
            | Self::AboveHardness { increment, .. }
            | Self::NoTilt { increment, .. }
            | Self::HistoryUnresolved { increment, .. }
            | Self::GapClosed { increment, .. }
            | Self::WearTooFast { increment, .. }
            | Self::WornTooThin { increment, .. }
            | Self::OutOfMemory { increment, .. }
            | Self::Interrupted { increment } => *increment,
        }
    }
}

/// How a force stands to the limit of friction, and what that is.
fn limit(asked: f64, bound: f64, by: Carried) -> &'static str {
    match (asked > bound, by) {
        (true, Carried::Coefficient) => "is above mu P =",
        (false, Carried::Coefficient) => "reaches mu P =",
        (true, Carried::Strength) => {
            "is above what mu P and the shear strength of the interface (friction.max_shear) carry together,"
        }
        (false, Carried::Strength) => {
            "reaches what mu P and the shear strength of the interface (friction.max_shear) carry together,"
        }
        (true, Carried::Sliding) => "is above what friction carries where the contact slides,",
        (false, Carried::Sliding) => "reaches what friction carries where the contact slides,",
    }
}

/// What that means.
fn consequence(asked: f64, bound: f64) -> &'static str {
    if asked > bound { "no equilibrium" } else { "the contact slides, and no force tells how far" }
}

/// That layers are worn too thin in the increment before a place.
pub fn too_thin(case: &Case, place: &Place, reason: &str) -> RunError {
    let stage = case.stages.get(place.stage).map_or_else(String::new, |stage| stage.name.clone());
    RunError::WornTooThin { increment: place.solved, stage, reason: reason.to_owned() }
}

/// Coefficients from which on contacts of dissimilar bodies wander, and those that come as near to full stick.
const STICKS: f64 = 100.0;

/// What to try where an increment is not solved.
fn way_to_solve(case: &Case, stage: usize) -> String {
    let coefficient = case.friction.largest();
    if coefficient >= STICKS {
        return format!(
            "a friction.coefficient of {coefficient} stands for full stick, and one of 20 to 50 comes within 1 % of it"
        );
    }
    let shifts = case.stages[stage].tangential.iter().flatten().any(StageControl::is_motion);
    let usual = "try more increments in this stage, or a larger solver.tolerance";
    if case.counts_mean_gap() && shifts {
        format!(
            "{usual}; where periodic half-spaces touch everywhere and stick, a shift does not tell the force: a stage with a tangential_force \
             under which the first cells slip comes before it"
        )
    } else {
        usual.to_owned()
    }
}

/// What a solver's error means for increment `increment` of stage `stage` of a case.
pub fn run_error(error: &SolveError, increment: usize, case: &Case, stage: usize) -> RunError {
    let (number, tolerance) = (stage, case.tolerance);
    let stage = case.stages[number].name.clone();
    let unit = |kind: &str| Units::after(case.units.as_ref(), kind, case.dimension());
    match error.clone() {
        SolveError::NotConverged { reached, iterations } => RunError::NotConverged {
            increment,
            stage,
            reached,
            tolerance,
            iterations,
            advice: way_to_solve(case, number),
        },
        SolveError::Wanders { apart, rounds } => RunError::PlaceNotFound { increment, stage, apart, rounds },
        SolveError::NotSteady { change, increments } => {
            RunError::NotSteady { increment, stage, change, increments }
        }
        SolveError::AboveSliding { asked, bound, by } => {
            let (unit, advice) = (unit("force"), WAY_TO_SLIDE);
            RunError::AboveSliding { increment, stage, asked, bound, by, unit, advice }
        }
        SolveError::AboveFullSlip { fraction } => RunError::AboveFullSlip { increment, stage, fraction },
        SolveError::AboveHardness { asked, bound } => {
            RunError::AboveHardness { increment, stage, asked, bound, unit: unit("force") }
        }
        SolveError::NoTilt { asked, reached } => {
            RunError::NoTilt { increment, stage, asked, reached, unit: unit("force x length") }
        }
        SolveError::ContactAtEdge => {
            RunError::ContactAtEdge { increment, stage, advice: way_from_the_edge(case) }
        }
        SolveError::OperatorsMissing(error) => RunError::NotConverged {
            increment,
            stage,
            reached: f64::INFINITY,
            tolerance,
            iterations: 0,
            advice: format!(
                "the elastic response could not be computed ({error}): check moduli and lengths for extreme values"
            ),
        },
        SolveError::Stopped => RunError::Interrupted { increment },
    }
}
