//! `fret plan`: what will be computed, what is left out and why, sizes and expected work; nothing heavy is done.

use fret_core::history::Warning;
use fret_core::machine::memory::{self, MemoryError, amount};
use fret_core::plan::{Coupling, Plan};
use fret_core::run::plausibility;
use fret_core::study::{Expectation, expectation};
use serde::Serialize;
use serde_json::{Value, json};

use crate::arguments::PlannedArguments;
use crate::failure::Failure;
use crate::figures::{LONGEST_TITLE, counted, duration, shortened};
use crate::manner::{Manner, refuse_other_file};
use crate::plan_words::{
    cells, cells_in_contact_radius, expected_contact, heights, layers, left_out, stages, warnings,
};
use crate::terminal::Answer;
use crate::threads;
use fret_results::{CaseFile, planned_from};

/// A plan with what it will take.
#[derive(Serialize)]
struct Record<'a> {
    #[serde(flatten)]
    plan: &'a Plan,
    status: &'static str,
    cells_in_contact_radius: Option<f64>,
    increments_expected: Option<usize>,
    convolutions_expected: Option<usize>,
    seconds_expected: Option<f64>,
    memory_lacking: Option<String>,
    warnings: Vec<Warning>,
}

/// The case that is asked about, and its plan.
pub fn planned(asked: &PlannedArguments) -> Result<(CaseFile, Plan), Failure> {
    asked.manner.out.as_deref().map_or(Ok(()), |path| refuse_other_file(path, &["json"]))?;
    let case_file = CaseFile::asked(&asked.case)?;
    let plan = planned_from(&case_file, asked.from.as_deref())?;
    Ok((case_file, plan))
}

/// An answer, written where that is asked for.
pub fn answered(manner: &Manner, record: Value, text: String) -> Result<Answer, Failure> {
    if let Some(path) = &manner.out {
        manner.write_json(path, &record)?;
    }
    Ok(Answer::new(record, text))
}

/// Plans a case and tells the plan.
pub fn plan(asked: &PlannedArguments) -> Result<Answer, Failure> {
    let (case_file, plan) = planned(asked)?;
    let lacking = memory::check(plan.memory_bytes).err();
    // A run that cannot be begun takes no time, and a part of it may be too much.
    let expected = match lacking {
        None => Some(threads::pool(threads::asked(None))?.install(|| expectation(&plan))),
        Some(_) => None,
    };
    let text = table((&case_file.title(&plan.case), &plan), expected.as_ref(), lacking.as_ref());
    let record = json!(Record {
        status: "planned",
        cells_in_contact_radius: cells_in_contact_radius(&plan),
        increments_expected: expected.map(|expected| expected.increments),
        convolutions_expected: expected.map(|expected| expected.convolutions),
        seconds_expected: expected.map(|expected| expected.seconds),
        memory_lacking: lacking.map(|error| format!("this {error}")),
        warnings: plausibility::of_plan(&plan),
        plan: &plan,
    });
    answered(&asked.manner, record, text)
}

fn table(
    (title, plan): (&str, &Plan),
    expected: Option<&Expectation>,
    lacking: Option<&MemoryError>,
) -> String {
    let coupling = match plan.coupling {
        Coupling::Frictionless => "pressure alone: there is no friction",
        Coupling::Uncoupled => "pressure first, then shear: they do not act on each other",
        Coupling::Coupled => "pressure and shear together: each acts on the other",
    };
    let work = expected.map_or_else(
        || "not this run on this machine".to_owned(),
        |expected| {
            format!(
                "about {} in {}, {} on {}",
                counted(expected.convolutions, "convolution"),
                counted(expected.increments, "increment"),
                duration(expected.seconds),
                counted(threads::asked(None), "thread"),
            )
        },
    );
    format!(
        "{}\n\n\
         solved     {coupling}\n\
         grid       {}\n\
         iterated   {}\n\
         {}layers     {}\n{}\
         history    {}: {}\n\
         residual   at most {:e} in every increment\n\
         memory     about {}{}\n\
         kept       {} of fields on disk\n\
         work       {work}\n\n{}{}",
        shortened(title, LONGEST_TITLE),
        cells(plan),
        if plan.case.periodic.is_both() {
            "on the whole grid: periodic"
        } else {
            "on the active subdomain around the contact; the rest of the grid is checked once per increment"
        },
        expected_contact(plan).map_or_else(String::new, |words| format!("contact    {words}\n")),
        layers(plan),
        heights(plan),
        counted(plan.increments, "increment"),
        stages(plan),
        plan.case.tolerance,
        amount(plan.memory_bytes as u64),
        lacking.map_or_else(String::new, |error| format!(": this {error}")),
        amount(plan.kept_bytes as u64),
        left_out(plan),
        warnings(plan),
    )
}
