//! `checkpoint/`: where an unfinished run stands. `even` and `odd` are written over in turn after every increment, so that one
//! of them is whole however the process ends; they are written while the next increment is solved. `synced` is replaced now and then, waits for the
//! disk, and survives a power failure. `lock` tells that a run is alive. The folder is gone when the run is solved.
//!
//! The body of a file ([`FramedFile`]) is a head and the waypoint of the core.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fret_core::history::Start;
use fret_core::plan::Plan;
use fret_core::run::{Checkpoint, Waypoint};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::{ResultsError, Unwritten};
use crate::framed_file::{FramedFile, body_of};
use crate::history_table::Written;
use crate::names::CHECKPOINT;
use crate::place::{folder_below, own_file};
use crate::tally::Tally;
use crate::turn_writer::TurnWriter;
use crate::whole_file::write_whole_by;

const TURNS: [&str; 2] = ["even", "odd"];
const SYNCED: &str = "synced";
const LOCK: &str = "lock";
const NAMES: [&str; 3] = [TURNS[0], TURNS[1], SYNCED];
const FIRST_LINE: &[u8] = b"fretting checkpoint\n";
/// Waiting for the disk takes no more than this share of the run.
const SYNC_SHARE: u32 = 100;

/// What the command needs to know besides the waypoint.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Head {
    /// Version of the program.
    pub version: String,
    /// Digest of the question.
    pub question: String,
    /// What of the history table belongs to the waypoint.
    pub history: Written,
    /// The same of the table of cycles.
    pub cycles: Written,
    /// Lines of that table.
    pub cycles_over: usize,
    /// Increments whose fields have been kept.
    pub kept: usize,
    /// What the run has come to.
    pub tally: Tally,
    /// Time spent so far [s].
    pub wall_s: f64,
}

/// A stored waypoint, read back.
#[derive(Debug)]
pub struct Stored {
    /// What the command needs.
    pub head: Head,
    /// What the core needs.
    pub checkpoint: Checkpoint,
}

/// What the folder holds.
#[derive(Debug)]
pub enum Found {
    /// No checkpoint: no increment was finished.
    Nothing,
    /// One to go on from; why newer ones were not used, where more than the increment in progress is lost by that.
    Stored(Box<Stored>, Option<String>),
    /// Only files that cannot be used, and why.
    Unusable(String),
}

/// The folder while a run writes into it. Nobody else does.
#[derive(Debug)]
pub struct CheckpointFolder {
    path: PathBuf,
    /// Held while this lives.
    _lock: File,
    turns: TurnWriter,
    synced_at: Option<Instant>,
    sync_took: Duration,
}

impl CheckpointFolder {
    /// Takes the folder below the results at `path`; refused while another run holds it.
    pub fn take(results: &Path) -> Result<Self, ResultsError> {
        let path = folder_below(results, Path::new(CHECKPOINT))?;
        let name = path.join(LOCK);
        let lock = own_file(&name).map_err(Unwritten::at(&name))?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Err(taken(results)),
            // Where files cannot be locked there is no protection, but no reason to refuse either.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self {
                path,
                _lock: lock,
                turns: TurnWriter::new(FIRST_LINE),
                synced_at: None,
                sync_took: Duration::ZERO,
            }),
        }
    }

    /// Refuses results that another run is writing at this moment; takes and writes nothing.
    pub fn refuse_taken(results: &Path) -> Result<(), ResultsError> {
        // Where there is no lock, or none that can be looked at, the attempt to take it will tell.
        let Ok(lock) = File::open(results.join(CHECKPOINT).join(LOCK)) else { return Ok(()) };
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Err(taken(results)),
            Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
        }
    }

    /// Whether unfinished work may be in the folder below the results at `path`.
    pub fn is_below(results: &Path) -> bool {
        NAMES.iter().any(|name| results.join(CHECKPOINT).join(name).exists())
    }

    /// The newest usable checkpoint of `plan`, whose question has this digest.
    pub fn newest(&self, plan: &Plan, question: &str) -> Found {
        let mut complaints = Vec::new();
        let mut newest: Option<(&str, Stored)> = None;
        for name in NAMES {
            let path = self.path.join(name);
            let read = match fs::read(&path) {
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                Err(error) => Err(error.to_string()),
                Ok(bytes) => unpacked(&bytes, plan, question),
            };
            let solved = newest.as_ref().map(|(_, stored)| stored.checkpoint.solved());
            match read {
                Err(why) => complaints.push(format!("{}: {why}", path.display())),
                Ok(stored) if solved < Some(stored.checkpoint.solved()) => newest = Some((name, stored)),
                Ok(_) => {}
            }
        }
        match newest {
            // Of the two that are written in turn, one may be torn: that is how a killed run looks.
            Some((name, stored)) => Found::Stored(
                Box::new(stored),
                (name == SYNCED && !complaints.is_empty()).then(|| complaints.join("; ")),
            ),
            None if complaints.is_empty() => Found::Nothing,
            None => Found::Unusable(complaints.join("; ")),
        }
    }

    /// Forgets what is stored: a run starts from the beginning.
    pub fn clear(&self) -> Result<(), Unwritten> {
        for name in NAMES {
            let path = self.path.join(name);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Unwritten::at(&path)(error));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Stores where the run stands. `settle` brings to the disk what the checkpoint relies on.
    pub fn store(
        &mut self,
        head: &Head,
        waypoint: &Waypoint<'_>,
        settle: impl FnOnce() -> Result<(), Unwritten>,
    ) -> Result<(), Unwritten> {
        let is_due = self.synced_at.is_none_or(|then| then.elapsed() >= self.sync_took * SYNC_SHARE);
        if is_due {
            let started = Instant::now();
            settle()?;
            write_whole_by(&self.path.join(SYNCED), |file| {
                let mut to =
                    BufWriter::with_capacity(1 << 20, FramedFile::begin(file.try_clone()?, FIRST_LINE)?);
                pack(&mut to, head, waypoint)?;
                to.into_inner()?.finish().map(drop)
            })?;
            self.sync_took = started.elapsed();
            self.synced_at = Some(Instant::now());
        }
        let turn = waypoint.solved() % 2;
        self.turns.write(turn, &self.path.join(TURNS[turn]), |to| pack(to, head, waypoint))
    }

    /// The run is solved: nothing is left to go on from.
    pub fn remove(self) {
        let Self { path, _lock: lock, turns, .. } = self;
        drop((lock, turns));
        // The results are whole; what stays behind by a failure here is only litter.
        let _ = fs::remove_dir_all(path);
    }
}

fn taken(results: &Path) -> ResultsError {
    ResultsError::Refused(
        format!("{}: another run is writing into it at this moment", results.display()),
        "wait for it, or choose another folder with --out DIR".to_owned(),
    )
}

fn pack(to: &mut dyn Write, head: &Head, waypoint: &Waypoint<'_>) -> io::Result<()> {
    let head = postcard::to_stdvec(head).map_err(io::Error::other)?;
    to.write_all(&head)?;
    waypoint.write(to)
}

/// The newest usable checkpoint below the results at `path`, whose plan is given as JSON, as a state to start from, and the number
/// of its increment.
pub fn newest_start(results: &Path, plan: &Value) -> Option<(usize, Start)> {
    let starts = NAMES.iter().filter_map(|name| {
        let bytes = fs::read(results.join(CHECKPOINT).join(name)).ok()?;
        let (head, waypoint) = parts(&bytes).ok()?;
        let increment = head.tally.solved.checked_sub(1)?;
        Some((increment, Checkpoint::start_of(waypoint, plan).ok()?))
    });
    starts.max_by_key(|(increment, _)| *increment)
}

fn unpacked(bytes: &[u8], plan: &Plan, question: &str) -> Result<Stored, String> {
    let (head, waypoint) = parts(bytes)?;
    if head.version != env!("CARGO_PKG_VERSION") {
        return Err(format!(
            "written by fret {}, which may compute other last digits than this one, {}",
            head.version,
            env!("CARGO_PKG_VERSION")
        ));
    }
    if head.question != question {
        return Err("written for another case".to_owned());
    }
    let checkpoint = Checkpoint::read(waypoint, plan).map_err(|error| error.to_string())?;
    Ok(Stored { head, checkpoint })
}

/// The head of a checkpoint file and the bytes of its waypoint, when the file is whole.
fn parts(bytes: &[u8]) -> Result<(Head, &[u8]), String> {
    let body = body_of(bytes, FIRST_LINE)?;
    postcard::take_from_bytes::<Head>(body).map_err(|_| "written by another version of fret".to_owned())
}
