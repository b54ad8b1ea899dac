//! Two files that are written over in turn, while the run goes on.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::error::Unwritten;
use crate::framed_file::FramedFile;
use crate::place::own_file;

/// Bytes that are written at once.
const CHUNK: usize = 1 << 20;
/// Chunks that wait at the most to be written beside the run: a file that is larger holds the run up, and takes no more memory.
const WAITING: usize = 32;

/// The two files. One is written at a time; the other one is whole meanwhile.
#[derive(Debug)]
pub struct TurnWriter {
    first_line: &'static [u8],
    files: [Option<File>; 2],
    at_work: Option<JoinHandle<Written>>,
}

/// A file after its writing.
#[derive(Debug)]
struct Written {
    turn: usize,
    file: Result<File, Unwritten>,
}

impl TurnWriter {
    /// Of files that begin with a line.
    pub fn new(first_line: &'static [u8]) -> Self {
        Self { first_line, files: [None, None], at_work: None }
    }

    /// Writes the file whose turn it is: beside the next increment where the run has more than one thread. How a writing beside it failed is
    /// told at the next one.
    pub fn write(
        &mut self,
        turn: usize,
        path: &Path,
        body: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Unwritten> {
        self.settle()?;
        let (mut file, first_line) = (self.files[turn].take(), self.first_line);
        if rayon::current_num_threads() > 1 {
            let (sender, receiver) = sync_channel(WAITING);
            let (of_turn, at) = (file.take(), path.to_path_buf());
            let beside = move || Written {
                turn,
                file: written(of_turn, &at, first_line, &receiver).map_err(Unwritten::at(&at)),
            };
            // Where the system starts no more threads the file is opened anew, and written here.
            if let Ok(at_work) = std::thread::Builder::new().spawn(beside) {
                self.at_work = Some(at_work);
                let mut chunks = Chunks { sender, chunk: Vec::new() };
                return body(&mut chunks).and_then(|()| chunks.finish()).map_err(Unwritten::at(path));
            }
        }
        let here = |path: &Path| {
            let mut to = BufWriter::with_capacity(CHUNK, begun(file, path, first_line)?);
            body(&mut to)?;
            to.into_inner()?.finish()
        };
        self.files[turn] = Some(here(path).map_err(Unwritten::at(path))?);
        Ok(())
    }

    /// Waits for what is written beside the run.
    fn settle(&mut self) -> Result<(), Unwritten> {
        if let Some(at_work) = self.at_work.take()
            && let Ok(Written { turn, file }) = at_work.join()
        {
            self.files[turn] = Some(file?);
        }
        Ok(())
    }
}

impl Drop for TurnWriter {
    /// Nothing is left half written by a run that ends.
    fn drop(&mut self) {
        // What failed here was the last file: the one before it is whole.
        let _ = self.settle();
    }
}

/// What goes to the thread that writes. If that has failed, it says so in the end.
struct Chunks {
    sender: SyncSender<Message>,
    chunk: Vec<u8>,
}

enum Message {
    Body(Vec<u8>),
    End,
}

impl Chunks {
    fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        let _ = self.sender.send(Message::End);
        Ok(())
    }
}

impl Write for Chunks {
    fn write(&mut self, body: &[u8]) -> io::Result<usize> {
        if self.chunk.capacity() == 0 {
            self.chunk.reserve_exact(CHUNK);
        }
        let taken = body.len().min(CHUNK - self.chunk.len());
        self.chunk.extend_from_slice(&body[..taken]);
        if self.chunk.len() == CHUNK {
            self.flush()?;
        }
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        let _ = self.sender.send(Message::Body(std::mem::take(&mut self.chunk)));
        Ok(())
    }
}

fn begun(file: Option<File>, path: &Path, first_line: &'static [u8]) -> io::Result<FramedFile> {
    FramedFile::begin(file.map_or_else(|| own_file(path), Ok)?, first_line)
}

/// The file after all chunks; one that did not come to its end stays unfinished.
fn written(
    file: Option<File>,
    path: &Path,
    first_line: &'static [u8],
    chunks: &Receiver<Message>,
) -> io::Result<File> {
    let mut to = begun(file, path, first_line)?;
    loop {
        match chunks.recv() {
            Ok(Message::Body(chunk)) => to.write_all(&chunk)?,
            Ok(Message::End) => return to.finish(),
            Err(_) => return Err(io::Error::other("its end was not written")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framed_file::body_of;

    /// Bodies of many chunks, longer and shorter than the one before, on one thread and beside the run.
    #[test]
    fn bodies_are_whole_in_both_ways() {
        let path =
            |turn: usize| std::env::temp_dir().join(format!("fret-turn-{}-{turn}", std::process::id()));
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut writer = TurnWriter::new(b"line\n");
                let lengths = [5 * CHUNK + 3, 40 * CHUNK, 2 * CHUNK, 0, 7];
                for (index, length) in lengths.into_iter().enumerate() {
                    let body: Vec<u8> = (0..length).map(|place| (place % 251) as u8).collect();
                    let write = |to: &mut dyn Write| {
                        to.write_all(&body[..length / 3]).and_then(|()| to.write_all(&body[length / 3..]))
                    };
                    writer.write(index % 2, &path(index % 2), write).unwrap();
                    writer.settle().unwrap();
                    assert!(body_of(&std::fs::read(path(index % 2)).unwrap(), b"line\n").unwrap() == body);
                }
                let breaks_off =
                    |to: &mut dyn Write| to.write_all(&[1; 10]).and_then(|()| Err(io::Error::other("no")));
                assert!(writer.write(0, &path(0), breaks_off).is_err());
                drop(writer);
                assert!(body_of(&std::fs::read(path(0)).unwrap(), b"line\n").is_err());
            });
        }
        for turn in [0, 1] {
            std::fs::remove_file(path(turn)).unwrap();
        }
    }

    #[test]
    fn a_folder_that_is_gone_is_told() {
        let mut writer = TurnWriter::new(b"line\n");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        pool.install(|| {
            let gone = Path::new("/no/such/folder/at/all");
            writer.write(0, gone, |to| to.write_all(&[1; 3])).unwrap();
            assert!(writer.write(1, gone, |to| to.write_all(&[1; 3])).is_err());
        });
    }
}
