//! `states/`: of every increment that another run can start from what its kept fields do not hold, in a file by its number; `memory`, what
//! the solver remembers at the end of the run; and `start.state`, the state that this run started from itself.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::history::Start;
use fret_core::model::SolvedState;
use fret_core::plan::Plan;
use fret_core::solver::SolverMemory;

use crate::error::{ResultsError, Unwritten};
use crate::names::{START, STATES};
use crate::packed_file::{read_packed, write_packed};
use crate::place::folder_below;
use crate::run_record::Record;
use crate::tally::Tally;

const FIRST_LINE: &str = "fretting state 5\n";
const MEMORY: &str = "memory";

/// The states while a run goes.
#[derive(Debug)]
pub struct StateStore {
    results: PathBuf,
    path: PathBuf,
}

impl StateStore {
    /// The store of the results at `path`, without any state of an earlier run; `start` is where this one starts.
    pub fn create(results: &Path, start: Option<&Start>) -> Result<Self, ResultsError> {
        let store = Self { results: results.to_owned(), path: results.join(STATES) };
        store.cut_back(0)?;
        let first = results.join(START);
        match start {
            Some(start) => write_packed(&first, FIRST_LINE, start.to_bytes())?,
            None => removed(&first)?,
        }
        Ok(store)
    }

    /// The store of a broken-off run, cut back to its first `solved` increments.
    pub fn reopen(results: &Path, solved: usize) -> Result<Self, Unwritten> {
        let store = Self { results: results.to_owned(), path: results.join(STATES) };
        store.cut_back(solved)?;
        Ok(store)
    }

    /// Writes down the state of an increment.
    pub fn keep(&self, increment: usize, rest: &SolvedState) -> Result<(), ResultsError> {
        folder_below(&self.results, Path::new(STATES))?;
        write_packed(&self.path.join(increment.to_string()), FIRST_LINE, postcard::to_stdvec(rest).ok())
    }

    /// Writes down what the solver remembers at the end of the last increment.
    pub fn keep_memory(&self, increment: usize, memory: &SolverMemory) -> Result<(), ResultsError> {
        write_packed(&self.path.join(MEMORY), FIRST_LINE, postcard::to_stdvec(&(increment, memory)).ok())
    }

    /// Why the states of the first increments of a run are not those that were written, if they are not; `kept` are those of them whose
    /// fields are kept.
    pub fn damaged(results: &Path, plan: &Plan, kept: &[usize], tally: &Tally) -> Option<String> {
        let found = states_below(results);
        let keeps = |name: &str| plan.case.output.fields.iter().any(|field| field == name);
        // A state is kept where the kept fields complete it; at the end of a stage in any case.
        let always = ["pressure", "shear", "slip"].into_iter().all(keeps);
        let ends = tally.stage_ends.iter().rev().skip(1).map(|end| end.increment);
        let wanted: Vec<usize> =
            if always { kept.to_vec() } else { ends.filter(|end| kept.contains(end)).collect() };
        if let Some(lost) = wanted.iter().find(|increment| !found.contains(increment)) {
            return Some(format!("{}: missing", results.join(STATES).join(lost.to_string()).display()));
        }
        let solved = found.into_iter().filter(|increment| *increment < tally.solved);
        solved.map(|increment| state_below(results, increment)).find_map(Result::err)
    }

    fn cut_back(&self, solved: usize) -> Result<(), Unwritten> {
        removed(&self.path.join(MEMORY))?;
        let beyond = numbers_in(&self.path).into_iter().filter(|number| *number >= solved);
        beyond.map(|number| self.path.join(number.to_string())).try_for_each(|file| removed(&file))
    }
}

/// Increments with a state in the results at `path`, in order.
pub fn states_below(results: &Path) -> Vec<usize> {
    numbers_in(&results.join(STATES))
}

/// In words, which of the states that the record of a solved run lists is not there any more.
pub fn lost_state(results: &Path, record: &Record) -> Option<String> {
    let end = record.end.as_ref().filter(|_| record.is_solved())?;
    if end.memory && !has_memory(results) {
        return Some(format!("{}: missing", results.join(STATES).join(MEMORY).display()));
    }
    let found = states_below(results);
    let lost = end.states.iter().find(|kept| !found.contains(kept))?;
    Some(format!("{}: the state of increment {lost} is missing", results.display()))
}

/// What the kept fields of an increment do not hold of its state.
pub fn state_below(results: &Path, increment: usize) -> Result<SolvedState, String> {
    let path = results.join(STATES).join(increment.to_string());
    let bytes = read_packed(&path, FIRST_LINE)?;
    postcard::from_bytes(&bytes).map_err(|_| format!("{}: damaged", path.display()))
}

/// Whether what the solver remembered at the end of the run is kept.
pub fn has_memory(results: &Path) -> bool {
    results.join(STATES).join(MEMORY).exists()
}

/// What the solver remembers at the end of an increment: of the last one of a run of second order.
pub fn memory_below(results: &Path, increment: usize) -> Result<Option<SolverMemory>, String> {
    if !has_memory(results) {
        return Ok(None);
    }
    let path = results.join(STATES).join(MEMORY);
    let bytes = read_packed(&path, FIRST_LINE)?;
    let (last, memory): (usize, _) =
        postcard::from_bytes(&bytes).map_err(|_| format!("{}: damaged", path.display()))?;
    Ok((last == increment).then_some(memory))
}

/// The state that the run in the results at `path` started from; none where it started from bodies apart.
pub fn start_below(results: &Path) -> Result<Option<Start>, String> {
    let path = results.join(START);
    if !path.exists() {
        return Ok(None);
    }
    let start = Start::from_bytes(&read_packed(&path, FIRST_LINE)?)
        .ok_or_else(|| format!("{}: damaged", path.display()))?;
    Ok(Some(start))
}

fn numbers_in(folder: &Path) -> Vec<usize> {
    let names = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let mut numbers: Vec<usize> = names.filter_map(|name| name.to_str()?.parse().ok()).collect();
    numbers.sort_unstable();
    numbers
}

fn removed(path: &Path) -> Result<(), Unwritten> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Unwritten::at(path)(error)),
        _ => Ok(()),
    }
}
