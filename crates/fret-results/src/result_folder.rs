//! The result folder while a run writes into it.
//!
//! `case.toml` (verbatim copy), `run.json` (how it was computed and how it ended), `history.csv` (a line an increment),
//! `cycles.csv` (a line a cycle), `fields.zarr` (kept fields), `states` (what else a run needs to start from a kept increment), and
//! `checkpoint` while the run is not solved. An increment's fields and state are written first, then its line, then that of the cycle it ends, then the checkpoint: what the checkpoint counts is complete, what lies beyond it is cut off when the run goes on.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use fret_core::history::{CycleRecord, KeptFields, StepRecord, Warning};
use fret_core::plan::Plan;
use fret_core::run::Waypoint;
use fret_core::subsurface::fatigue::Parameter;

use crate::case_file::CaseFile;
use crate::checkpoint_folder::{CheckpointFolder, Found, Head, Stored};
use crate::checksums::checksums;
use crate::error::{ResultsError, Unwritten};
use crate::field_store::FieldStore;
use crate::history_table::{HistoryTable, Lines};
use crate::names::{
    ANSWERS, CASE, CHECKPOINT, CYCLES, ERROR_BARS, FIELDS, HISTORY, RECORD, STRESS, WRITTEN, is_named,
};
use crate::place::{refuse_link, refuse_links_below};
use crate::results::Results;
use crate::run_record::{Ending, Glance, Record, RunRecord, question};
use crate::state_store::{StateStore, has_memory, states_below};
use crate::tally::Tally;
use crate::whole_file::write_whole;

/// What lies where the results shall go.
#[derive(Debug)]
pub enum Standing {
    /// Nothing that matters.
    Free,
    /// Earlier results of the same case, to be replaced.
    SameCase,
    /// Something else, which the user wants written into.
    Forced,
    /// A run of the same case that is not solved, to go on with.
    Unfinished,
    /// The same case, solved; its record.
    Solved(Box<Record>),
}

/// What a run shall do with what it finds in its folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wish {
    /// Start from the beginning; replace nothing that was not asked to be replaced.
    Start,
    /// Start from the beginning, whatever is there.
    Force,
    /// Go on where an earlier run was broken off.
    Resume,
}

impl Wish {
    /// By two answers: whether to go on with what is there, and whether to replace it.
    pub fn of(resume: bool, replace: bool) -> Self {
        match (resume, replace) {
            (true, _) => Self::Resume,
            (false, true) => Self::Force,
            (false, false) => Self::Start,
        }
    }
}

/// What is wrong with a file that a run has written, and that is not there in the end.
const REMOVED: &str = "it was removed or changed by somebody else while the run went; solve the case again";

/// A folder a run writes into while it goes.
#[derive(Debug)]
pub struct ResultFolder {
    path: PathBuf,
    case_text: String,
    question: String,
    record: RunRecord,
    history: HistoryTable,
    cycles: HistoryTable,
    fields: FieldStore,
    states: StateStore,
    checkpoints: CheckpointFolder,
    /// Increments of the whole run, at the most.
    increments: usize,
}

impl ResultFolder {
    /// What lies at `path`, and whether results of this case may go there. Writes nothing.
    ///
    /// # Errors
    /// With the words of a refusal, where they may not.
    pub fn standing(
        path: &Path,
        case_file: &CaseFile,
        plan: &Plan,
        wish: Wish,
    ) -> Result<Standing, ResultsError> {
        let shown = path.display();
        let other_folder = "choose another folder with --out DIR";
        let refuse = |what: &str, help: String| Err(ResultsError::Refused(format!("{shown}: {what}"), help));
        if path.exists() && !path.is_dir() {
            return refuse("a file, not a folder for results", other_folder.to_owned());
        }
        if holds_nothing(path) {
            return Ok(Standing::Free);
        }
        refuse_links_below(path, &WRITTEN)?;
        CheckpointFolder::refuse_taken(path)?;
        let Some(earlier) = fs::read(path.join(RECORD)).ok() else {
            return match wish {
                Wish::Force => Ok(Standing::Forced),
                Wish::Start | Wish::Resume => refuse(
                    "holds files that are not results of fret",
                    format!("{other_folder}, or write beside them with --force"),
                ),
            };
        };
        let record = Glance::at(&earlier);
        let is_same_question = record.question_fnv1a64 == Some(question(plan));
        let is_solved = record.status == "solved";
        let is_broken_off = !is_solved && CheckpointFolder::is_below(path);
        let same_text = || fs::read(path.join(CASE)).is_ok_and(|text| text == case_file.text.as_bytes());
        let is_same_case = || record.is_of_case(case_file) || same_text();
        match wish {
            Wish::Resume if !record.is_known() => refuse(
                "results of another program, or of another version of the format",
                format!("{other_folder}; nothing was touched"),
            ),
            Wish::Resume if !is_same_question => refuse(
                "holds the results of another case, or of a case that has been changed since or starts elsewhere",
                format!("{other_folder}; nothing was touched"),
            ),
            Wish::Resume if is_solved => {
                let results = Results::read(path)?;
                results.look_at_all()?;
                Ok(Standing::Solved(Box::new(results.record)))
            }
            Wish::Resume => Ok(Standing::Unfinished),
            Wish::Start if is_broken_off && !is_same_question => refuse(
                "holds an unfinished run of another case, or of this one before it was changed",
                format!(
                    "{other_folder} (--from {shown} continues from what is solved there), or replace it with --force"
                ),
            ),
            Wish::Start if is_broken_off && record.ended_without_answer() => refuse(
                &format!("holds this case's run, which failed: {}", record.why()),
                format!(
                    "it would end there again; a changed case goes on from what is solved with --from {shown} --out OTHER, \
                     and --force starts from the beginning"
                ),
            ),
            Wish::Start if is_broken_off => refuse(
                "holds an unfinished run of this case",
                "continue with --resume, or start from the beginning with --force".to_owned(),
            ),
            Wish::Start if is_solved && is_same_case() && !record.starts_as(plan) => refuse(
                "holds results that start from another state",
                format!("{other_folder}, or replace them with --force"),
            ),
            _ if is_same_case() => Ok(Standing::SameCase),
            Wish::Force => Ok(Standing::Forced),
            Wish::Start => refuse(
                "holds the results of another case",
                format!("{other_folder}, or replace them with --force"),
            ),
        }
    }

    /// Makes the folder ready for a run: earlier results are gone afterwards, and stresses, temperatures and scars that were computed of them; other
    /// files are left alone.
    ///
    /// # Errors
    /// When another run writes into the folder, or a file cannot be written.
    pub fn open(
        path: &Path,
        case_file: &CaseFile,
        plan: &Plan,
        record: RunRecord,
    ) -> Result<Self, ResultsError> {
        fs::create_dir_all(path).map_err(Unwritten::at(path))?;
        let checkpoints = CheckpointFolder::take(path)?;
        // First the record and the checkpoint, so that a kill in between never leaves old ones beside new numbers.
        write_whole(&path.join(RECORD), &record.running())?;
        checkpoints.clear()?;
        remove_earlier_fields(&path.join(FIELDS))?;
        remove_earlier_file(&path.join(ERROR_BARS))?;
        remove_earlier_answers(path)?;
        write_whole(&path.join(CASE), case_file.text.as_bytes())?;
        for (name, content) in case_file.beside.iter().flat_map(|beside| &beside.contents) {
            write_whole(&path.join(name), content)?;
        }
        Ok(Self {
            history: HistoryTable::create(&path.join(HISTORY), Lines::Increments, &plan.case)?,
            cycles: HistoryTable::create(&path.join(CYCLES), Lines::Cycles, &plan.case)?,
            fields: FieldStore::create(&path.join(FIELDS), plan)?,
            states: StateStore::create(path, plan.start.as_deref())?,
            path: path.to_owned(),
            case_text: case_file.text.clone(),
            question: question(plan),
            record,
            checkpoints,
            increments: plan.case.increments(),
        })
    }

    /// Removes results and what is computed of them, so that others can be copied there; from a folder that holds none, nothing.
    ///
    /// # Errors
    /// When a run writes into it, or one of them cannot be removed.
    pub fn clear(path: &Path) -> Result<(), ResultsError> {
        if !path.join(RECORD).exists() {
            return Ok(());
        }
        refuse_links_below(path, &WRITTEN)?;
        CheckpointFolder::refuse_taken(path)?;
        remove_earlier_answers(path)?;
        for name in WRITTEN {
            let entry = path.join(name);
            if entry.is_dir() { remove_earlier_fields(&entry)? } else { remove_earlier_file(&entry)? }
        }
        Ok(())
    }

    /// Takes up the unfinished run in the folder; `None` where it had not solved any increment. What lies beyond the checkpoint
    /// is cut off, but only once everything has been found in order.
    ///
    /// # Errors
    /// When the folder does not hold what was written, or another run writes into it.
    pub fn reopen(
        path: &Path,
        case_file: &CaseFile,
        plan: &Plan,
        record: RunRecord,
    ) -> Result<Option<Taken>, ResultsError> {
        let checkpoints = CheckpointFolder::take(path)?;
        let question = question(plan);
        let spoilt = |why: String| {
            Err(ResultsError::Refused(
                format!("{}: its run cannot be resumed: {why}", path.display()),
                "nothing was touched; --force starts from the beginning, --out DIR elsewhere".to_owned(),
            ))
        };
        let (mut stored, passed_over) = match checkpoints.newest(plan, &question) {
            // A kill between the first line and the first checkpoint leaves the head and one line.
            Found::Nothing if HistoryTable::lines(&path.join(HISTORY)) > 2 => {
                return spoilt("its checkpoint is gone".to_owned());
            }
            Found::Nothing => return Ok(None),
            Found::Unusable(why) => return spoilt(why),
            Found::Stored(stored, passed_over) => (*stored, passed_over),
        };
        let Head { history: written, cycles: cycles_written, cycles_over: ended, kept, .. } = stored.head;
        let (history, cycles) = (path.join(HISTORY), path.join(CYCLES));
        let solved = stored.checkpoint.solved();
        let not_whole = |table: &Path, count: usize| {
            spoilt(format!(
                "{}: not the {count} lines that were written: they are fewer, or changed since",
                table.display()
            ))
        };
        if solved != stored.head.tally.solved || !HistoryTable::holds(&history, written, solved, &plan.case) {
            return not_whole(&history, solved);
        }
        match HistoryTable::cycles(&cycles, cycles_written, &plan.case) {
            Some(records) if records.len() == ended => stored.head.tally.cycles = records,
            _ => return not_whole(&cycles, ended),
        }
        if let Some((file, why)) = FieldStore::damaged(&path.join(FIELDS), plan, kept) {
            return spoilt(format!("{}: {why}", file.display()));
        }
        let steps = FieldStore::steps(&path.join(FIELDS), plan, kept);
        if let Some(why) = StateStore::damaged(path, plan, &steps, &stored.head.tally) {
            return spoilt(why);
        }
        let earlier = Glance::at(&fs::read(path.join(RECORD)).unwrap_or_default());
        let ended = earlier.ended_without_answer().then(|| earlier.why().to_owned());
        let record = record.continuing(&earlier);
        write_whole(&path.join(RECORD), &record.running())?;
        write_whole(&path.join(CASE), case_file.text.as_bytes())?; // its words may have changed
        let folder = Self {
            case_text: case_file.text.clone(),
            history: HistoryTable::reopen(&history, written)?,
            cycles: HistoryTable::reopen(&cycles, cycles_written)?,
            fields: FieldStore::reopen(&path.join(FIELDS), plan, kept)?,
            states: StateStore::reopen(path, solved)?,
            path: path.to_owned(),
            question,
            record,
            checkpoints,
            increments: plan.case.increments(),
        };
        Ok(Some(Taken { folder, stored, passed_over, ended }))
    }

    /// Writes down a solved increment: first its kept fields and what else of its state is needed to start there, then its line.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn keep(&mut self, record: &StepRecord, kept: Option<&KeptFields>) -> Result<(), ResultsError> {
        if let Some(kept) = kept {
            self.fields.keep(kept)?;
            if let Some(rest) = &kept.rest {
                self.states.keep(kept.increment, rest)?;
            }
            if let Some(memory) = &kept.memory {
                self.states.keep_memory(kept.increment, memory)?;
            }
        }
        Ok(self.history.add(record)?)
    }

    /// Writes down a cycle that is over.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn keep_cycle(&mut self, record: &CycleRecord) -> Result<(), Unwritten> {
        self.cycles.add_cycle(record)
    }

    /// Writes down where the run stands, after everything about it has been kept; nothing after its last increment, which is solved
    /// again should the process end before the run is closed.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn reached(
        &mut self,
        waypoint: &Waypoint<'_>,
        tally: &Tally,
        wall_s: f64,
    ) -> Result<(), ResultsError> {
        if waypoint.solved() >= self.increments {
            return Ok(());
        }
        let head = Head {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            question: self.question.clone(),
            history: self.history.written(),
            cycles: self.cycles.written(),
            cycles_over: tally.cycles.len(),
            kept: self.fields.kept(),
            tally: tally.clone(),
            wall_s,
        };
        let settle = || self.history.settle().and_then(|()| self.cycles.settle());
        Ok(self.checkpoints.store(&head, waypoint, settle)?)
    }

    /// Whether what is in a folder can be continued: its table and a checkpoint are still there.
    pub fn can_go_on(path: &Path) -> bool {
        path.join(HISTORY).is_file() && CheckpointFolder::is_below(path)
    }

    /// Writes down how the run ended.
    ///
    /// # Errors
    /// When a file cannot be written, or was removed while the run went.
    pub fn close(
        self,
        (tally, warnings): (&Tally, &[Warning]),
        wall_s: f64,
        early: Option<&Ending>,
    ) -> Result<(), Unwritten> {
        self.history.settle()?;
        self.cycles.settle()?;
        let (history, cycles) = (self.history.read_again(), self.cycles.read_again());
        let lost = history.as_ref().err().or(cycles.as_ref().err()).cloned().or_else(|| self.fields.lost());
        let lost = lost.map(|file| Unwritten::at(&file)(io::Error::other(REMOVED)));
        let torn =
            lost.as_ref().map(|lost| Ending { status: "failed".to_owned(), message: lost.to_string() });
        let tables = [(HISTORY, history.ok()), (CYCLES, cycles.ok())];
        let texts = tables.iter().filter_map(|(name, text)| Some((*name, text.as_deref()?)));
        let texts = texts.chain([(CASE, self.case_text.as_bytes())]);
        let kept = (checksums(texts), states_below(&self.path), has_memory(&self.path));
        let record = self.record.ended((tally, warnings), wall_s, early.or(torn.as_ref()), kept);
        write_whole(&self.path.join(RECORD), &record)?;
        if let Some(lost) = lost {
            return Err(lost);
        }
        if early.is_none() {
            self.checkpoints.remove();
        }
        Ok(())
    }
}

/// An unfinished run, resumed.
#[derive(Debug)]
pub struct Taken {
    /// Its folder, ready for the next increment.
    pub folder: ResultFolder,
    /// Where it stands.
    pub stored: Stored,
    /// Why a newer checkpoint could not be used, if there was one.
    pub passed_over: Option<String>,
    /// Why it ended without its answer, if it did.
    pub ended: Option<String>,
}

/// Whether a folder is empty, apart from what a run that is killed in its first moment leaves behind.
fn holds_nothing(path: &Path) -> bool {
    let is_litter = |name: &str| name == "run.json.part" || name == CHECKPOINT;
    match fs::read_dir(path) {
        Ok(mut entries) => {
            !CheckpointFolder::is_below(path)
                && entries
                    .all(|entry| entry.is_ok_and(|entry| entry.file_name().to_str().is_some_and(is_litter)))
        }
        // Not there, or not to be looked into: the attempt to write will tell.
        Err(_) => true,
    }
}

fn remove_earlier_file(path: &Path) -> Result<(), Unwritten> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Unwritten::at(path)(error)),
        _ => Ok(()),
    }
}

/// What is computed of the results that were there; other files stay.
fn remove_earlier_answers(path: &Path) -> Result<(), Unwritten> {
    for ([folder, record], beside) in ANSWERS {
        let folder = path.join(folder);
        if refuse_link(&folder).is_err() || !folder.join(record).exists() {
            continue;
        }
        let is_ours = |name: &str| {
            let pictures = || Parameter::ALL.iter().any(|of| name.strip_suffix(".svg") == Some(of.name()));
            name == record
                || beside.iter().any(|pattern| is_named(name, pattern))
                || record == STRESS[1] && pictures()
        };
        for entry in fs::read_dir(&folder).map_err(Unwritten::at(&folder))?.flatten() {
            if entry.file_name().to_str().is_some_and(is_ours) {
                remove_earlier_file(&entry.path())?;
            }
        }
        // One with files of others stays.
        let _ = fs::remove_dir(&folder);
    }
    Ok(())
}

fn remove_earlier_fields(path: &Path) -> Result<(), Unwritten> {
    match fs::remove_dir_all(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Unwritten::at(path)(error)),
        _ => Ok(()),
    }
}
