//! Files that are there whole or not at all: written beside, synchronised, renamed into place.

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::Unwritten;
use crate::place::new_file;

/// Writes a file. A reader, a kill and a power failure at any moment find the old content or the new one, never a part.
///
/// # Errors
/// When the file cannot be written.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Unwritten> {
    write_whole_by(path, |file| file.write_all(content))
}

/// The same without the blocks that are zero, which cost no room on the disk: a file reads as zero where nobody wrote to it.
/// A few bytes more stand at its `end`.
pub fn write_whole_sparsely(path: &Path, content: &[u8], end: &[u8]) -> Result<(), Unwritten> {
    const BLOCK: usize = 1 << 16;
    const ZEROS: &[u8] = &[0; BLOCK];
    write_whole_by(path, |file| {
        file.set_len((content.len() + end.len()) as u64)?;
        let blocks = content.chunks(BLOCK).zip((0..).step_by(BLOCK));
        for (block, start) in blocks.filter(|(block, _)| *block != &ZEROS[..block.len()]) {
            file.seek(SeekFrom::Start(start))?;
            file.write_all(block)?;
        }
        file.seek(SeekFrom::Start(content.len() as u64))?;
        file.write_all(end)
    })
}

/// A file of which pieces are written one after the other.
pub fn write_whole_by(
    path: &Path,
    content: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), Unwritten> {
    let part = part_of(path);
    new_file(&part)
        .and_then(|mut file| {
            content(&mut file)?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&part, path))
        .map_err(|error| {
            // What is left of a failed attempt is of no use; if even that cannot be removed, the first error says why.
            let _ = fs::remove_file(&part);
            Unwritten::at(path)(error)
        })
}

/// The name of a file while it is written.
pub fn part_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks of zeros, also at the end and in a last block that is not full, are read back like all others.
    #[test]
    fn a_file_with_zeros_left_out_reads_as_it_was_given() {
        let path = std::env::temp_dir().join(format!("fret-sparse-{}", std::process::id()));
        for (len, written) in
            [(0, None), (5, None), (5, Some(3)), (300_000, Some(200_001)), (1 << 17, Some(0_usize))]
        {
            let mut content = vec![0; len];
            if let Some(place) = written {
                content[place] = 7;
            }
            write_whole_sparsely(&path, &content, b"end").unwrap();
            assert!(fs::read(&path).unwrap() == [&content[..], b"end"].concat(), "{len} {written:?}");
        }
        fs::remove_file(&path).unwrap();
    }
}
