//! Histories of which no derivatives are taken, each refused by the key that makes it one: never a wrong derivative in silence.

use super::error::SensitivityError;
use crate::case::{Stage, StageControl};
use crate::kernel::uniform_response;
use crate::plan::{Plan, Simplification};

/// Whether derivatives are taken of the history of a plan.
pub(super) fn check(plan: &Plan) -> Result<(), SensitivityError> {
    let case = &plan.case;
    let without = "take the derivatives without it";
    // Where a half-space repeats, nothing else moves along the normal.
    let repeats = case.periodic && uniform_response(&case.bodies).is_none();
    let moves = |stage: &Stage| stage.normal.as_ref().is_some_and(StageControl::is_motion);
    let by_mean_gap = repeats && case.stages.iter().any(moves);
    let refusals = [
        (case.wear.is_some(), "[wear]", without),
        (case.friction_evolution.is_some(), "friction.evolution", without),
        (plan.moves, "kinematics.displacement = \"finite\"", without),
        (case.stages.iter().any(Stage::rolls), "roll", without),
        (by_mean_gap, "mean_gap", "prescribe the normal force"),
        (case.stages.iter().any(Stage::stretches), "bulk_stress", without),
        (plan.start.is_some(), "a start from another history", "give all stages in one case"),
        (
            case.stages.iter().any(|stage| stage.history_tolerance.is_some()),
            "increments = \"auto\"",
            "give the stages a number of increments",
        ),
        (
            !plan.leave_out.takes(Simplification::LayeredResponse),
            "all layers in their place",
            "take the derivatives with the simplifications of the plan",
        ),
    ];
    match refusals.into_iter().find(|(is, ..)| *is) {
        Some((_, key, advice)) => Err(SensitivityError::NotCovered { key: key.to_owned(), advice }),
        None => Ok(()),
    }
}
