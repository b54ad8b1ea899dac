//! `fret check`: is this a case that can be computed? All mistakes at once, or a few facts.

use fret_core::run::plausibility;
use serde_json::json;

use crate::arguments::PlannedArguments;
use crate::commands::plan::{answered, planned};
use crate::failure::Failure;
use crate::figures::counted;
use crate::plan_words::{cells, cells_in_contact_radius, expected_contact, left_out, stages, warnings};
use crate::terminal::Answer;

/// Judges a case.
pub fn check(asked: &PlannedArguments) -> Result<Answer, Failure> {
    let (case_file, plan) = planned(asked)?;
    let record = json!({
        "status": "good",
        "case": case_file.name(),
        "cells": plan.grid.cells(),
        "size": plan.grid.size(),
        "cells_in_contact_radius": cells_in_contact_radius(&plan),
        "increments": plan.increments,
        "warnings": plausibility::of_plan(&plan),
    });
    let warnings = warnings(&plan);
    let but = if warnings.is_empty() { "" } else { ", but" };
    let text = format!(
        "{}: good{but}\n  {}\n{}  {}: {}{}",
        case_file.name(),
        cells(&plan),
        expected_contact(&plan).map_or_else(String::new, |words| format!("  {words}\n")),
        counted(plan.increments, "increment"),
        stages(&plan),
        warnings,
    );
    asked.manner.step(|| left_out(&plan));
    answered(&asked.manner, record, text)
}
