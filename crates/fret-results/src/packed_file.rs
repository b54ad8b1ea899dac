//! Files of bytes that may be large and mostly zero: a line of text and an LZ4 frame with its checksum.

use std::fs;
use std::io::{Read, Write};
use std::path::Path;

use lz4_flex::frame::{Error, FrameDecoder, FrameEncoder, FrameInfo};

use crate::error::ResultsError;
use crate::whole_file::write_whole;

/// More bytes than this are none of the largest grid.
const LONGEST: u64 = 256 << 26;
/// No part of any frame.
const BEHIND: &[u8] = &[0xff; 16];

/// Writes a file that begins with a line; `None` for bytes that could not be had.
///
/// # Errors
/// When the file cannot be written.
pub fn write_packed(path: &Path, first_line: &str, bytes: Option<Vec<u8>>) -> Result<(), ResultsError> {
    let nothing = || ResultsError::Defect(format!("no bytes for {}", path.display()));
    let frame = FrameInfo::new().content_checksum(true);
    let mut encoder = FrameEncoder::with_frame_info(frame, first_line.as_bytes().to_vec());
    let written = encoder.write_all(&bytes.ok_or_else(nothing)?).map_err(Error::from);
    let content = written.and_then(|()| encoder.finish()).map_err(|_| nothing())?;
    Ok(write_whole(path, &content)?)
}

/// The bytes of a file that begins with a line, or in a few words why they cannot be had.
///
/// # Errors
/// When the file cannot be read, or is damaged.
pub fn read_packed(path: &Path, first_line: &str) -> Result<Vec<u8>, String> {
    let damaged = || format!("{}: damaged, or of another version of fret", path.display());
    let bytes = fs::read(path).map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
    let frame = bytes.strip_prefix(first_line.as_bytes()).ok_or_else(damaged)?;
    let mut content = Vec::new();
    // The decoder takes a frame that ends between two blocks for a whole one: then it reads on, into what stands behind.
    let mut frame = frame.chain(BEHIND);
    FrameDecoder::new(&mut frame).take(LONGEST).read_to_end(&mut content).map_err(|_| damaged())?;
    let (rest, behind) = frame.into_inner();
    if rest.is_empty() && behind == BEHIND { Ok(content) } else { Err(damaged()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_take_no_room_and_damage_is_seen() {
        let path = std::env::temp_dir().join(format!("fret-packed-{}", std::process::id()));
        let bytes = vec![0_u8; 1 << 20];
        write_packed(&path, "line\n", Some(bytes.clone())).unwrap();
        let content = fs::read(&path).unwrap();
        assert!(content.len() < bytes.len() / 200, "{}", content.len());
        assert_eq!(read_packed(&path, "line\n"), Ok(bytes));
        assert!(read_packed(&path, "other\n").is_err());
        let is_refused = |content: &[u8]| {
            fs::write(&path, content).unwrap();
            read_packed(&path, "line\n").is_err()
        };
        assert!(is_refused(&[&content[..], b"\0abc"].concat()), "more than was written");
        let bytes: Vec<u8> = (0..200).map(|number| (number * number % 251) as u8).collect();
        write_packed(&path, "line\n", Some(bytes)).unwrap();
        let content = fs::read(&path).unwrap();
        for end in 0..content.len() {
            assert!(is_refused(&content[..end]), "{end}");
        }
        for bit in 0..8 * content.len() {
            let mut flipped = content.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(is_refused(&flipped), "{bit}");
        }
        fs::remove_file(&path).unwrap();
    }
}
