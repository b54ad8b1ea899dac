//! Two files that are written over in turn, while the run goes on.

use std::fs::File;
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};
use std::thread::JoinHandle;

use crate::failure::Unwritten;

/// The two files. One is written at a time; the other one is whole meanwhile.
#[derive(Debug, Default)]
pub struct TurnWriter {
    files: [Option<File>; 2],
    /// Bytes written last; their memory is used again.
    bytes: Vec<u8>,
    at_work: Option<JoinHandle<Written>>,
}

/// A file after its writing.
#[derive(Debug)]
struct Written {
    turn: usize,
    file: Option<File>,
    bytes: Vec<u8>,
    outcome: Result<(), Unwritten>,
}

impl TurnWriter {
    /// Memory for the next bytes; or how the last writing failed.
    pub fn room(&mut self) -> Result<Vec<u8>, Unwritten> {
        if let Some(at_work) = self.at_work.take()
            && let Ok(written) = at_work.join()
        {
            self.take_back(written)?;
        }
        Ok(std::mem::take(&mut self.bytes))
    }

    /// Writes bytes over the file whose turn it is: beside the next increment where the run has more than one thread.
    pub fn write(&mut self, turn: usize, path: PathBuf, bytes: Vec<u8>) -> Result<(), Unwritten> {
        let file = self.files[turn].take();
        let write = move || {
            let (file, outcome) = written_over(file, &path, &bytes);
            Written { turn, file, bytes, outcome }
        };
        if rayon::current_num_threads() > 1 {
            self.at_work = Some(std::thread::spawn(write));
            return Ok(());
        }
        self.take_back(write())
    }

    fn take_back(&mut self, written: Written) -> Result<(), Unwritten> {
        self.files[written.turn] = written.file;
        self.bytes = written.bytes;
        written.outcome
    }
}

impl Drop for TurnWriter {
    /// Nothing is left half written by a run that ends.
    fn drop(&mut self) {
        if let Some(at_work) = self.at_work.take() {
            // What failed here was the last checkpoint: the one before it is whole.
            let _ = at_work.join();
        }
    }
}

fn written_over(file: Option<File>, path: &Path, bytes: &[u8]) -> (Option<File>, Result<(), Unwritten>) {
    let open = || File::options().write(true).create(true).truncate(false).open(path);
    match file.map_or_else(open, Ok) {
        Err(error) => (None, Err(Unwritten::at(path)(error))),
        Ok(mut file) => match file.rewind().and_then(|()| file.write_all(bytes)) {
            Ok(()) => (Some(file), Ok(())),
            Err(error) => (None, Err(Unwritten::at(path)(error))),
        },
    }
}
