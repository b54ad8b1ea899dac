//! Where a run starts that goes on from a solved state: `--from RESULTS[:INCREMENT]`.

use std::path::Path;
use std::sync::Arc;

use fret_core::history::Start;
use fret_core::plan::{LeaveOut, Plan};

use crate::case_file::CaseFile;
use crate::checkpoint_folder::newest_start;
use crate::error::ResultsError;
use crate::results::Results;
use crate::run_record::StartedFrom;
use crate::state_store::{lost_state, memory_below, start_below, state_below, states_below};

/// More increments than this are not listed one by one.
const MOST_LISTED: usize = 12;

/// A solved state, and where it was found.
#[derive(Debug, Clone)]
pub struct Origin {
    /// The state.
    pub start: Arc<Start>,
    /// The folder of its results, as it was named.
    pub results: String,
    /// The number of its increment there, from 0.
    pub increment: usize,
}

impl Origin {
    /// The state that is named as `RESULTS:INCREMENT`, or the last one of `RESULTS`.
    ///
    /// # Errors
    /// As [`Origin::of`].
    pub fn read(named: &str) -> Result<Self, ResultsError> {
        let numbered =
            named.rsplit_once(':').and_then(|(folder, number)| Some((folder, number.parse().ok()?)));
        match numbered {
            Some((folder, increment)) if !Path::new(named).exists() => {
                Self::of(Path::new(folder), Some(increment))
            }
            _ => Self::of(Path::new(named), None),
        }
    }

    /// The state at the end of an increment of the results in a folder; of the last that is solved when none is named.
    ///
    /// # Errors
    /// When the folder holds no results, or no such state.
    pub fn of(results: &Path, increment: Option<usize>) -> Result<Self, ResultsError> {
        let run = Results::read(results)?;
        let plan = &run.plan().to_json();
        let newest = if run.record.is_solved() { None } else { newest_start(results, plan) };
        let mut all = states_below(results);
        all.retain(|kept| *kept < run.table.rows());
        all.extend(newest.iter().map(|(increment, _)| *increment));
        all.sort_unstable();
        all.dedup();
        let shown = results.display();
        if let Some(lost) = lost_state(results, &run.record) {
            return Err(ResultsError::Refused(lost, "solve its case again".to_owned()));
        }
        let increment = match (increment, all.last()) {
            (_, None) => {
                return Err(ResultsError::Refused(
                    format!("{shown}: holds no state to start from"),
                    "solve its case with this version: the end of every stage is one".to_owned(),
                ));
            }
            (None, Some(last)) => *last,
            (Some(asked), _) if all.contains(&asked) => asked,
            (Some(asked), _) => {
                return Err(ResultsError::Refused(
                    format!("{shown}: has no state at the end of increment {asked} to start from"),
                    format!(
                        "increments to start from (counted from 0): {}; those whose pressure, shear and slip are kept \
                         ([output]), and the last of every stage",
                        listed(&all)
                    ),
                ));
            }
        };
        let damaged = |why: String| ResultsError::Refused(why, "start from another increment".to_owned());
        let start = match newest {
            Some((number, start)) if number == increment => start,
            _ => {
                let rest = state_below(results, increment).map_err(damaged)?;
                let solved = rest.completed(|name| {
                    run.field(name, increment)?.ok_or_else(|| {
                        damaged(format!("{shown}: {name} of increment {increment} is missing"))
                    })
                })?;
                let stage = run.table.at("stage", increment) as usize;
                let memory = memory_below(results, increment).map_err(damaged)?.map(|memory| (memory, stage));
                Start::new(plan, solved, memory).ok_or_else(|| {
                    damaged(format!("{shown}: the state of increment {increment} is damaged"))
                })?
            }
        };
        Ok(Self { start: Arc::new(start), results: shown.to_string(), increment })
    }

    /// The state that the run in a folder of results started from; none where it started from bodies apart.
    ///
    /// # Errors
    /// When the state is damaged.
    pub fn below(results: &Path) -> Result<Option<Self>, ResultsError> {
        let start = start_below(results).map_err(|why| {
            ResultsError::Refused(
                why,
                "name the state with --from, or start from the beginning with --force".to_owned(),
            )
        })?;
        let origin =
            |start| Self { start: Arc::new(start), results: results.display().to_string(), increment: 0 };
        Ok(start.map(origin))
    }

    /// What is written down of it.
    pub fn told(&self) -> StartedFrom {
        let Self { start, results, increment } = self;
        StartedFrom { results: results.clone(), increment: *increment, fnv1a64: start.digest().to_owned() }
    }
}

/// A case, read and planned to start from the state that is named `from`, if one is.
///
/// # Errors
/// When the case is refused, or there is no such state.
pub fn planned_from(case_file: &CaseFile, from: Option<&str>) -> Result<Plan, ResultsError> {
    let origin = from.map(Origin::read).transpose()?;
    Ok(case_file.planned_leaving_out(LeaveOut::ALL, origin.as_ref().map(|origin| &origin.start))?)
}

fn listed(increments: &[usize]) -> String {
    let words = |part: &[usize]| part.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    match increments {
        few if few.len() <= MOST_LISTED => words(few),
        many => format!("{}, ..., {}", words(&many[..MOST_LISTED - 2]), words(&many[many.len() - 1..])),
    }
}
