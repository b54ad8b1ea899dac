//! Where a run starts that goes on from a solved state: `--from RESULTS[:INCREMENT]`.

use std::path::Path;
use std::sync::Arc;

use fret_core::history::Start;
use fret_core::model::LoadStep;

use crate::failure::Failure;
use crate::output::kept_run::KeptRun;
use crate::output::{lost_state, newest_start, start_below, state_below, states_below};

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
    pub fn read(named: &str) -> Result<Self, Failure> {
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
    pub fn of(results: &Path, increment: Option<usize>) -> Result<Self, Failure> {
        let run = KeptRun::open(results)?;
        let plan = &run.record["plan"];
        let newest = if run.unfinished.is_some() { newest_start(results, plan) } else { None };
        let mut all = states_below(results);
        all.retain(|kept| *kept < run.solved);
        all.extend(newest.iter().map(|(increment, _)| *increment));
        all.sort_unstable();
        all.dedup();
        let shown = results.display();
        if let Some(lost) = lost_state(results, &run.record) {
            return Err(Failure::Call(lost, "solve its case again".to_owned()));
        }
        let increment = match (increment, all.last()) {
            (_, None) => {
                return Err(Failure::Call(
                    format!("{shown}: holds no state to start from"),
                    "solve its case with this version: the end of every stage is one".to_owned(),
                ));
            }
            (None, Some(last)) => *last,
            (Some(asked), _) if all.contains(&asked) => asked,
            (Some(asked), _) => {
                return Err(Failure::Call(
                    format!("{shown}: has no state at the end of increment {asked} to start from"),
                    format!(
                        "increments to start from (counted from 0): {}; those whose pressure, shear and slip are kept \
                         ([output]), and the last of every stage",
                        listed(&all)
                    ),
                ));
            }
        };
        let damaged = |why: String| Failure::Call(why, "start from another increment".to_owned());
        let start = match newest {
            Some((number, start)) if number == increment => start,
            _ => {
                let rest = state_below(results, increment).map_err(damaged)?;
                let solved = rest.completed(|name| {
                    run.field(name, increment)?.ok_or_else(|| {
                        damaged(format!("{shown}: {name} of increment {increment} is missing"))
                    })
                })?;
                Start::new(plan, solved, None).ok_or_else(|| {
                    damaged(format!("{shown}: the state of increment {increment} is damaged"))
                })?
            }
        };
        Ok(Self { start: Arc::new(start), results: shown.to_string(), increment })
    }

    /// The state that the run in a folder of results started from; none where it started from bodies apart.
    pub fn below(results: &Path) -> Result<Option<Self>, Failure> {
        let start = start_below(results).map_err(|why| {
            Failure::Call(
                why,
                "name the state with --from, or start from the beginning with --force".to_owned(),
            )
        })?;
        let origin =
            |start| Self { start: Arc::new(start), results: results.display().to_string(), increment: 0 };
        Ok(start.map(origin))
    }

    /// What is prescribed there.
    pub fn loads(&self) -> LoadStep {
        self.start.solved.loads
    }
}

fn listed(increments: &[usize]) -> String {
    let words = |part: &[usize]| part.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    match increments {
        few if few.len() <= MOST_LISTED => words(few),
        many => format!("{}, ..., {}", words(&many[..MOST_LISTED - 2]), words(&many[many.len() - 1..])),
    }
}
