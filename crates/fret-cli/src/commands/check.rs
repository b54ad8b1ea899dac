//! `fret check`: is this a case that can be computed? All mistakes at once, or a few facts.

use fret_core::run::plausibility;
use serde_json::json;

use crate::arguments::PlannedArguments;
use crate::commands::plan::{cells, cells_in_contact_radius, expected_contact, left_out, stages, warnings};
use crate::failure::Failure;
use crate::figures::counted;
use crate::manner::refuse_other_file;
use crate::terminal::Answer;
use fret_results::{CaseFile, planned_from};

/// Judges a case.
pub fn check(PlannedArguments { case, from, manner }: &PlannedArguments) -> Result<Answer, Failure> {
    manner.out.as_deref().map_or(Ok(()), |path| refuse_other_file(path, &["json"]))?;
    let case_file = CaseFile::asked(case)?;
    let plan = planned_from(&case_file, from.as_deref())?;
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
    manner.step(|| left_out(&plan));
    if let Some(path) = &manner.out {
        manner.write(path, format!("{record:#}\n").as_bytes())?;
    }
    Ok(Answer::new(record, text))
}
