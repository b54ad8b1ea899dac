//! Histories of which no derivatives are taken, each refused by the key that makes it one: never a wrong derivative in silence.

use super::error::SensitivityError;
use crate::plan::{Plan, Simplification};

/// Whether derivatives are taken of the history of a plan.
pub(super) fn check(plan: &Plan) -> Result<(), SensitivityError> {
    let case = &plan.case;
    let without = "take the derivatives without it";
    let refusals = [
        (case.wear.is_some(), "[wear]", without),
        (case.friction_evolution.is_some(), "friction.evolution", without),
        (plan.moves, "kinematics.displacement = \"finite\"", without),
        (case.stages.iter().any(crate::case::Stage::stretches), "bulk_stress", without),
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
