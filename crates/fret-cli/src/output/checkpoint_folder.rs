//! `checkpoint/`: where an unfinished run stands. `latest` is written after every increment and survives the end of the process
//! at any moment; `synced` is written now and then, waits for the disk, and survives a power failure. `lock` tells that a run is
//! alive. The folder is gone when the run is solved.
//!
//! A file is a line of text, a checksum, a length, a head, and the waypoint of the core.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fret_core::checkpoint::{Checkpoint, Waypoint};
use fret_core::plan::Plan;
use serde::{Deserialize, Serialize};

use super::whole_file::{write_swiftly, write_whole};
use crate::failure::{Failure, Unwritten};
use crate::tally::Tally;

const LATEST: &str = "latest";
const SYNCED: &str = "synced";
const LOCK: &str = "lock";
const FIRST_LINE: &[u8] = b"fretting checkpoint\n";
/// Bytes of the checksum and the length.
const FRAME: usize = 4 + 8;
/// Waiting for the disk takes no more than this share of the run.
const SYNC_SHARE: u32 = 100;

/// What the command needs to know besides the waypoint.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Head {
    /// Version of the program.
    pub version: String,
    /// Digest of the question.
    pub question: String,
    /// Bytes of the history table that belong to the waypoint.
    pub history_bytes: u64,
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
    /// One to go on from; why a newer one was not used, if there is one.
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
    bytes: Vec<u8>,
    synced_at: Option<Instant>,
    sync_took: Duration,
}

impl CheckpointFolder {
    /// Takes the folder below the results at `path`; refused while another run holds it.
    pub fn take(results: &Path) -> Result<Self, Failure> {
        let path = results.join("checkpoint");
        fs::create_dir_all(&path).map_err(Unwritten::at(&path))?;
        let name = path.join(LOCK);
        let lock = File::create(&name).map_err(Unwritten::at(&name))?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Err(Failure::Call(
                format!("{}: another run is writing into it at this moment", results.display()),
                "wait for it, or choose another folder with --out DIR".to_owned(),
            )),
            // Where files cannot be locked there is no protection, but no reason to refuse either.
            Ok(()) | Err(TryLockError::Error(_)) => {
                Ok(Self { path, _lock: lock, bytes: Vec::new(), synced_at: None, sync_took: Duration::ZERO })
            }
        }
    }

    /// Whether unfinished work may be in the folder below the results at `path`.
    pub fn is_below(results: &Path) -> bool {
        [LATEST, SYNCED].iter().any(|name| results.join("checkpoint").join(name).exists())
    }

    /// The newest usable checkpoint of `plan`, whose question has this digest.
    pub fn newest(&self, plan: &Plan, question: &str) -> Found {
        let mut complaints = Vec::new();
        let mut newest: Option<Stored> = None;
        for name in [LATEST, SYNCED] {
            let path = self.path.join(name);
            let bytes = match fs::read(&path) {
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                Err(error) => {
                    complaints.push(format!("{}: {error}", path.display()));
                    continue;
                }
                Ok(bytes) => bytes,
            };
            match unpacked(&bytes, plan, question) {
                Err(why) => complaints.push(format!("{}: {why}", path.display())),
                Ok(stored)
                    if newest
                        .as_ref()
                        .is_none_or(|other| other.checkpoint.solved() < stored.checkpoint.solved()) =>
                {
                    newest = Some(stored);
                }
                Ok(_) => {}
            }
        }
        let complaint = (!complaints.is_empty()).then(|| complaints.join("; "));
        match (newest, complaint) {
            (Some(stored), complaint) => Found::Stored(Box::new(stored), complaint),
            (None, Some(complaint)) => Found::Unusable(complaint),
            (None, None) => Found::Nothing,
        }
    }

    /// Forgets what is stored: a run starts from the beginning.
    pub fn clear(&self) -> Result<(), Unwritten> {
        for name in [LATEST, SYNCED] {
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
    ) -> Result<(), Failure> {
        pack(&mut self.bytes, head, waypoint)?;
        let is_due = self.synced_at.is_none_or(|then| then.elapsed() >= self.sync_took * SYNC_SHARE);
        if is_due {
            let started = Instant::now();
            settle()?;
            write_whole(&self.path.join(SYNCED), &self.bytes)?;
            self.sync_took = started.elapsed();
            self.synced_at = Some(Instant::now());
        }
        Ok(write_swiftly(&self.path.join(LATEST), &self.bytes)?)
    }

    /// The run is solved: nothing is left to go on from.
    pub fn remove(self) {
        let Self { path, _lock: lock, .. } = self;
        drop(lock);
        // The results are whole; what stays behind by a failure here is only litter.
        let _ = fs::remove_dir_all(path);
    }
}

fn pack(bytes: &mut Vec<u8>, head: &Head, waypoint: &Waypoint<'_>) -> Result<(), Failure> {
    let unpackable = |what: String| Failure::Defect(format!("a checkpoint has no bytes: {what}"));
    let mut room = std::mem::take(bytes);
    room.clear();
    room.extend_from_slice(FIRST_LINE);
    room.extend_from_slice(&[0; FRAME]);
    let room = postcard::to_extend(head, room).map_err(|error| unpackable(error.to_string()))?;
    *bytes = waypoint.write(room).map_err(|error| unpackable(error.to_string()))?;
    let body = FIRST_LINE.len() + FRAME;
    let checksum = crc32fast::hash(&bytes[body..]).to_le_bytes();
    let length = ((bytes.len() - body) as u64).to_le_bytes();
    bytes[FIRST_LINE.len()..][..4].copy_from_slice(&checksum);
    bytes[FIRST_LINE.len() + 4..][..8].copy_from_slice(&length);
    Ok(())
}

fn unpacked(bytes: &[u8], plan: &Plan, question: &str) -> Result<Stored, String> {
    let frame = bytes.strip_prefix(FIRST_LINE).ok_or("not a checkpoint, or a damaged one")?;
    let (checksum, frame) = frame.split_first_chunk::<4>().ok_or("damaged: it ends early")?;
    let (length, body) = frame.split_first_chunk::<8>().ok_or("damaged: it ends early")?;
    if u64::from_le_bytes(*length) != body.len() as u64 {
        return Err("damaged: it has not the length it had when it was written".to_owned());
    }
    if u32::from_le_bytes(*checksum) != crc32fast::hash(body) {
        return Err("damaged: its checksum does not fit".to_owned());
    }
    let (head, waypoint) =
        postcard::take_from_bytes::<Head>(body).map_err(|_| "written by another version of fret")?;
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
