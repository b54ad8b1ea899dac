//! Files that tell whether they are whole: a line of text, a checksum and a length, a body, and whatever an older one left behind that.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};

use crc32fast::Hasher;

/// What stands before the body while it is written: no body of this length has this checksum.
const UNFINISHED: [u8; 12] = [0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0, 0, 0, 0, 0];

/// A file whose body is being written, from its beginning.
pub struct FramedFile {
    file: File,
    first_line: &'static [u8],
    checksum: Hasher,
    length: u64,
}

impl FramedFile {
    /// Begins to write over a file.
    pub fn begin(mut file: File, first_line: &'static [u8]) -> io::Result<Self> {
        file.rewind()?;
        file.write_all(first_line)?;
        file.write_all(&UNFINISHED)?;
        Ok(Self { file, first_line, checksum: Hasher::new(), length: 0 })
    }

    /// Makes the file whole.
    pub fn finish(mut self) -> io::Result<File> {
        self.file.seek(SeekFrom::Start(self.first_line.len() as u64))?;
        self.file.write_all(&self.checksum.finalize().to_le_bytes())?;
        self.file.write_all(&self.length.to_le_bytes())?;
        Ok(self.file)
    }
}

impl Write for FramedFile {
    fn write(&mut self, body: &[u8]) -> io::Result<usize> {
        let written = self.file.write(body)?;
        self.checksum.update(&body[..written]);
        self.length += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The body of a file that is whole.
pub fn body_of<'a>(bytes: &'a [u8], first_line: &[u8]) -> Result<&'a [u8], String> {
    let frame = bytes.strip_prefix(first_line).ok_or("not a checkpoint, or a damaged one")?;
    let (checksum, frame) = frame.split_first_chunk::<4>().ok_or("damaged: it ends early")?;
    let (length, body) = frame.split_first_chunk::<8>().ok_or("damaged: it ends early")?;
    let length = usize::try_from(u64::from_le_bytes(*length)).unwrap_or(usize::MAX);
    let body = body.get(..length).ok_or("damaged: it ends early")?;
    if u32::from_le_bytes(*checksum) != crc32fast::hash(body) {
        return Err("damaged: its checksum does not fit".to_owned());
    }
    Ok(body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_read_back_once_it_is_whole() {
        let path = std::env::temp_dir().join(format!("fret-framed-{}", std::process::id()));
        std::fs::write(&path, [b'x'; 300]).unwrap();
        let read = || body_of(&std::fs::read(&path).unwrap(), b"line\n").map(<[u8]>::to_vec);
        let file = File::options().write(true).open(&path).unwrap();
        let mut framed = FramedFile::begin(file, b"line\n").unwrap();
        assert!(read().unwrap_err().contains("checksum"));
        framed.write_all(&[1; 100]).unwrap();
        framed.write_all(&[2; 50]).unwrap();
        assert!(read().unwrap_err().contains("checksum"));
        framed.finish().unwrap();
        assert_eq!(read().unwrap(), [[1; 50], [1; 50], [2; 50]].concat());
        assert!(body_of(b"line", b"line\n").is_err());
        assert!(body_of(b"line\n123", b"line\n").is_err());
        std::fs::remove_file(&path).unwrap();
    }
}
