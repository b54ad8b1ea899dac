//! Files that are handed in beside a case.

use std::fs;
use std::io;
use std::path::Path;

/// Bytes of a file that a case names, at the most: the cells of the largest grid at sixteen letters each.
pub const MOST_BYTES: u64 = 1 << 30;

/// Content of a file that a case names, for those who hand it in. It is measured before it is read, and only ordinary files are read, so
/// that nothing waits on a pipe.
///
/// # Errors
/// In a few words why it cannot be had.
pub fn content(path: &Path) -> Result<Vec<u8>, String> {
    let facts = fs::metadata(path).map_err(|error| unreadable(&error))?;
    if !facts.is_file() {
        return Err("no ordinary file".to_owned());
    }
    if facts.len() > MOST_BYTES {
        return Err(format!("{} MB long; at most {} MB are read", facts.len() >> 20, MOST_BYTES >> 20));
    }
    if facts.len() == 0 {
        // Not read: some files of the kernel say so too, and wait for ever.
        return Ok(Vec::new());
    }
    fs::read(path).map_err(|error| unreadable(&error))
}

/// Why a file cannot be read, in a few words.
pub fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "no permission to read it".to_owned(),
        io::ErrorKind::OutOfMemory => "there is no memory to read it into".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_ordinary_files_that_are_not_too_long_are_read() {
        let folder = std::env::temp_dir().join(format!("fretting-attachments-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = |name: &str| folder.join(name);
        fs::write(path("short"), b"1 2 3").unwrap();
        fs::write(path("nothing"), b"").unwrap();
        // a file of holes: its length without its bytes
        fs::File::create(path("long")).unwrap().set_len(MOST_BYTES + 1).unwrap();
        let found = ["short", "long", "none", ".", "nothing"].map(|name| content(&path(name)));
        fs::remove_dir_all(&folder).unwrap();
        let [short, long, none, itself, nothing] = found;
        assert_eq!(nothing.unwrap(), b"");
        assert_eq!(short.unwrap(), b"1 2 3");
        assert_eq!(long.unwrap_err(), "1024 MB long; at most 1024 MB are read");
        assert_eq!(none.unwrap_err(), "no such file");
        assert_eq!(itself.unwrap_err(), "no ordinary file");
    }

    #[test]
    fn why_a_file_cannot_be_read_is_told_in_a_few_words() {
        let words = |kind: io::ErrorKind| unreadable(&io::Error::from(kind));
        assert_eq!(words(io::ErrorKind::NotFound), "no such file");
        assert_eq!(words(io::ErrorKind::PermissionDenied), "no permission to read it");
        assert_eq!(words(io::ErrorKind::OutOfMemory), "there is no memory to read it into");
        assert!(words(io::ErrorKind::TimedOut).starts_with("cannot be read: "));
    }
}
