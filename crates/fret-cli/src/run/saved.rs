//! A history in memory, written into a folder as the run itself would have done.

use std::path::Path;
use std::sync::Arc;

use fret_core::history::{History, Start};
use fret_core::plan::Plan;
use fret_core::study::StageQuantities;

use crate::failure::Failure;
use crate::threads;
use fret_results::{
    CaseFile, ERROR_BARS, Ending, Origin, ResultFolder, RunRecord, Standing, Tally, Wish, read_record,
    resolved_path, write_whole,
};

/// A state to start from that no folder holds.
pub fn origin_in_memory(start: Option<Arc<Start>>) -> Option<Origin> {
    start.map(|start| Origin { start, results: "a state in memory".to_owned(), increment: 0 })
}

/// A history in memory with what it was solved by.
#[derive(Debug, Clone, Copy)]
pub struct Solved<'a> {
    /// Its plan.
    pub plan: &'a Plan,
    /// The history.
    pub history: &'a History,
    /// Quantities of interest at the ends of its stages.
    pub quantities: &'a [StageQuantities],
    /// One word and the reason, where it ended early.
    pub early: Option<(&'a str, &'a str)>,
    /// Its error bars, where they were asked for.
    pub error_bars: Option<&'a str>,
}

/// Writes a history into a folder, as the run itself would have done.
///
/// # Errors
/// When the folder holds something else, or cannot be written.
pub fn save(solved: Solved<'_>, case_file: &CaseFile, folder: &Path, wish: Wish) -> Result<(), Failure> {
    let Solved { plan, history, quantities, early, error_bars } = solved;
    let folder = &resolved_path(folder);
    match ResultFolder::standing(folder, case_file, plan, wish)? {
        Standing::SameCase
            if early.is_some() && read_record(folder).is_ok_and(|record| record.is_solved()) =>
        {
            let what = format!(
                "{}: holds this history to its end, and the one to be saved ended early",
                folder.display()
            );
            return Err(Failure::call(what, "choose another folder, or replace it by that with --force"));
        }
        Standing::Free | Standing::SameCase | Standing::Forced => {}
        Standing::Unfinished | Standing::Solved(_) => {
            let what = format!("{}: holds results already", folder.display());
            return Err(Failure::call(what, "choose another folder with --out DIR"));
        }
    }
    let origin = origin_in_memory(plan.start.clone());
    let record =
        RunRecord::new(case_file, plan, threads::asked(None), origin.as_ref().map(Origin::told).as_ref());
    let mut results = ResultFolder::open(folder, case_file, plan, record)?;
    let mut tally = Tally::new(plan);
    for step in &history.steps {
        results.keep(step, history.fields_of(step.increment))?;
        tally.add(step);
        for cycle in history.cycles.iter().filter(|cycle| cycle.last_increment == step.increment) {
            results.keep_cycle(cycle)?;
            tally.add_cycle(cycle);
        }
    }
    tally.stage_quantities = quantities.to_vec();
    tally.worn_through.clone_from(&history.worn_through);
    tally.worn_by_layer.clone_from(&history.worn_by_layer);
    let wall_s = history.steps.iter().map(|step| step.wall_s).sum();
    let ending =
        early.map(|(status, message)| Ending { status: status.to_owned(), message: message.to_owned() });
    results.close((&tally, &history.warnings), wall_s, ending.as_ref())?;
    if let Some(text) = error_bars {
        write_whole(&folder.join(ERROR_BARS), text.as_bytes())?;
    }
    Ok(())
}
