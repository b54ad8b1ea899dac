//! `fret plan`: what will be computed, what is left out and why, sizes and expected work; nothing heavy is done.

use std::path::Path;

use fret_core::plan::{Coupling, Plan};
use serde_json::json;

use crate::case_file::CaseFile;
use crate::failure::Failure;
use crate::figures::{counted, figure, memory};
use crate::output::resolved;
use crate::terminal;

/// Plans a case and tells the plan.
pub fn plan(path: &Path, as_json: bool) -> Result<(), Failure> {
    let planned = CaseFile::read(path).and_then(|case_file| case_file.planned());
    let answer = match (&planned, as_json) {
        (Ok(plan), false) => table(plan),
        (Ok(plan), true) => {
            let mut value = resolved(plan);
            value["status"] = json!("planned");
            format!("{value:#}")
        }
        (Err(_), false) => String::new(),
        (Err(error), true) => format!("{:#}", Failure::from(error.clone()).to_json()),
    };
    if !answer.is_empty() {
        terminal::answer(&answer)?;
    }
    planned.map(|_| ()).map_err(Failure::from)
}

fn table(plan: &Plan) -> String {
    let coupling = match plan.coupling {
        Coupling::Frictionless => "pressure alone: there is no friction",
        Coupling::Uncoupled => "pressure first, then shear: they do not act on each other",
        Coupling::Coupled => "pressure and shear together: each acts on the other",
    };
    let title = if plan.case.title.is_empty() { "case" } else { &plan.case.title };
    format!(
        "{title}\n\n\
         solved     {coupling}\n\
         grid       {}\n\
         history    {}: {}\n\
         residual   at most {:e} in every increment\n\
         memory     about {}\n\
         work       about {}\n\n{}",
        cells(plan),
        counted(plan.increments, "increment"),
        stages(plan),
        plan.case.tolerance,
        memory(plan.memory_bytes),
        counted(plan.convolutions_expected, "convolution"),
        left_out(plan),
    )
}

/// What is left out, as a block of text.
pub fn left_out(plan: &Plan) -> String {
    if plan.left_out.is_empty() {
        return "nothing is left out".to_owned();
    }
    let items = plan
        .left_out
        .iter()
        .map(|item| format!("  {}\n    because {}\n    saves {}", item.what, item.why, item.saves));
    format!("left out, the answer being the same without it:\n{}", items.collect::<Vec<_>>().join("\n"))
}

/// The grid in a line.
pub fn cells(plan: &Plan) -> String {
    let ([nx, ny], [dx, dy], [width, depth]) = (plan.grid.cells(), plan.grid.spacing(), plan.grid.size());
    format!(
        "{nx} x {ny} cells of {} x {}, {} x {} in all",
        figure(dx),
        figure(dy),
        figure(width),
        figure(depth)
    )
}

/// The stages in a line.
pub fn stages(plan: &Plan) -> String {
    let stages = plan.case.stages.iter().map(|stage| match stage.cycles() {
        Some(cycles) => {
            let most = if cycles.until_steady.is_some() { "at most " } else { "" };
            format!("{} ({most}{} of {})", stage.name, counted(cycles.most, "cycle"), stage.increments)
        }
        None => format!("{} ({})", stage.name, stage.increments),
    });
    stages.collect::<Vec<_>>().join(", ")
}
