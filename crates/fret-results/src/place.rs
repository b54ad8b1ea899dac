//! Where files may go: folders as the system will resolve them, and files and folders inside them that are no links to elsewhere.
//!
//! A folder of results may come from somebody else. What is written into it is written there and nowhere else: an existing link in the
//! place of a file is removed before the file is made, and one in the place of a folder is refused.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::error::{ResultsError, Unwritten};
use crate::names::RECORD;

/// The folder that a path will name once all folders on its way are made: `new/../old` is `old`, even where there is no `new` yet.
pub fn resolved_path(path: &Path) -> PathBuf {
    if path.exists() || !path.components().any(|part| part == Component::ParentDir) {
        return path.to_owned();
    }
    let mut reached = PathBuf::new();
    for part in path.components() {
        match part {
            // Above where the command is called: nothing of the way is yet gone.
            Component::ParentDir if reached.as_os_str().is_empty() || reached.ends_with("..") => {
                reached.push(part);
            }
            // Where the way so far is there, the system says what lies above it: it may be a link.
            Component::ParentDir if reached.exists() => {
                reached.push(part);
                reached = reached.canonicalize().unwrap_or(reached);
            }
            Component::ParentDir => {
                reached.pop();
            }
            _ => reached.push(part),
        }
    }
    if reached.as_os_str().is_empty() { PathBuf::from(".") } else { reached }
}

/// The name of a folder for what a file asks: its name without the extension, unless that would name another folder.
pub fn stem(path: &Path, otherwise: &str) -> PathBuf {
    let names_another = |stem: &&OsStr| *stem == OsStr::new(".") || *stem == OsStr::new("..");
    path.file_stem()
        .filter(|stem| !names_another(stem))
        .map_or_else(|| PathBuf::from(otherwise), PathBuf::from)
}

/// Makes a folder for answers ready. One that holds something has to hold an earlier answer, which one of `marks` tells, and no run.
///
/// # Errors
/// When it holds something else, or cannot be made.
pub fn folder_for_answers(path: &Path, marks: &[&str], what: &str) -> Result<PathBuf, ResultsError> {
    let path = resolved_path(path);
    let refuse = |why: String| {
        Err(ResultsError::Refused(
            format!("{}: {why}", path.display()),
            "choose another folder with --out DIR".to_owned(),
        ))
    };
    if path.exists() && !path.is_dir() {
        return refuse(format!("a file, not a folder for {what}"));
    }
    let holds_something = fs::read_dir(&path).is_ok_and(|mut entries| entries.next().is_some());
    let is_ours = marks.iter().any(|mark| path.join(mark).exists());
    if holds_something && (!is_ours || path.join(RECORD).exists()) {
        return refuse(format!("holds files that are not those of {what}"));
    }
    fs::create_dir_all(&path).map_err(Unwritten::at(&path))?;
    Ok(path)
}

/// Makes the folder that `key` names below `root`, step by step; none of them may be a link.
///
/// # Errors
/// When one of them is a link or a file, or cannot be made.
pub fn folder_below(root: &Path, key: &Path) -> Result<PathBuf, Unwritten> {
    let mut path = root.to_owned();
    for part in key.components() {
        path.push(part);
        match fs::create_dir(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => refuse_link(&path)?,
            made => made.map_err(Unwritten::at(&path))?,
        }
    }
    Ok(path)
}

/// Refuses a path that is a symbolic link.
///
/// # Errors
/// When it is one.
pub fn refuse_link(path: &Path) -> Result<(), Unwritten> {
    let is_link = fs::symlink_metadata(path).is_ok_and(|facts| facts.is_symlink());
    if is_link { Err(Unwritten::at(path)(link())) } else { Ok(()) }
}

/// Refuses a symbolic link anywhere in what `keys` name below `root`.
///
/// # Errors
/// With the first link that is found.
pub fn refuse_links_below(root: &Path, keys: &[&str]) -> Result<(), Unwritten> {
    fn look(path: &Path) -> Result<(), Unwritten> {
        for entry in fs::read_dir(path).into_iter().flatten().flatten() {
            match entry.file_type() {
                Ok(kind) if kind.is_symlink() => return Err(Unwritten::at(&entry.path())(link())),
                Ok(kind) if kind.is_dir() => look(&entry.path())?,
                _ => {}
            }
        }
        Ok(())
    }
    for path in keys.iter().map(|key| root.join(key)) {
        refuse_link(&path)?;
        look(&path)?;
    }
    Ok(())
}

/// A file that was not there before; whatever had its name, a link among it, is gone.
///
/// # Errors
/// When it cannot be made.
pub fn new_file(path: &Path) -> io::Result<File> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    OpenOptions::new().write(true).create_new(true).open(path)
}

/// A file to be written into as it is, or a new one; not what a link leads to.
///
/// # Errors
/// When it is a link, or cannot be opened.
pub fn own_file(path: &Path) -> io::Result<File> {
    if fs::symlink_metadata(path).is_ok_and(|facts| facts.is_symlink()) {
        return Err(link());
    }
    let mut options = OpenOptions::new();
    options.write(true).create(true).truncate(false);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits().cast_signed());
    }
    options.open(path)
}

fn link() -> io::Error {
    io::Error::other("a symbolic link, and nothing is written through those; remove it")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bench(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("fret-place-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_path_is_what_it_names_once_its_folders_are_made() {
        let bench = bench("resolved");
        fs::create_dir(bench.join("old")).unwrap();
        for (path, name) in [
            ("new/../old", "old"),
            ("new/er/../../old", "old"),
            ("new/../other", "other"),
            ("a/b/../c", "a/c"),
        ] {
            assert_eq!(resolved_path(&bench.join(path)), bench.join(name), "{path}");
        }
        for path in ["old", "old/../old", "new"] {
            assert_eq!(resolved_path(&bench.join(path)), bench.join(path), "{path}");
        }
        assert_eq!(resolved_path(Path::new("no-such-folder/..")), Path::new("."));
        // Beside and above the folder that the command is called in.
        for (path, name) in [
            ("../no-such-folder", "../no-such-folder"),
            ("../../no-such-folder", "../../no-such-folder"),
            ("../new/../no-such-folder", "../no-such-folder"),
            ("new/../../no-such-folder", "../no-such-folder"),
        ] {
            assert_eq!(resolved_path(Path::new(path)), Path::new(name), "{path}");
        }
        fs::remove_dir_all(bench).unwrap();
    }

    #[test]
    fn a_stem_names_no_folder_above() {
        for (file, name) in
            [("a/ball.toml", "ball"), ("...toml", "case"), ("..toml", "case"), ("x/..", "case")]
        {
            assert_eq!(stem(Path::new(file), "case"), Path::new(name), "{file}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_are_replaced_or_refused_and_never_followed() {
        let bench = bench("links");
        let (precious, at) = (bench.join("precious"), |name: &str| bench.join(name));
        fs::write(&precious, "precious").unwrap();
        fs::create_dir(at("elsewhere")).unwrap();
        for name in ["new", "own"] {
            std::os::unix::fs::symlink(&precious, at(name)).unwrap();
        }
        std::os::unix::fs::symlink(at("nowhere"), at("dangling")).unwrap();
        std::os::unix::fs::symlink(at("elsewhere"), at("folder")).unwrap();
        assert!(new_file(&at("new")).is_ok() && !at("new").is_symlink());
        assert!(own_file(&at("own")).is_err() && own_file(&at("dangling")).is_err());
        assert!(own_file(&at("fresh")).is_ok() && own_file(&at("fresh")).is_ok());
        assert!(folder_below(&bench, Path::new("folder/in")).is_err());
        assert!(folder_below(&bench, Path::new("made/in")).is_ok() && at("made/in").is_dir());
        assert!(refuse_links_below(&bench, &["made", "new", "none"]).is_ok());
        assert!(refuse_links_below(&bench, &["made", "folder"]).is_err());
        std::os::unix::fs::symlink(at("elsewhere"), at("made/in/link")).unwrap();
        assert!(refuse_links_below(&bench, &["made"]).is_err());
        assert_eq!(fs::read_to_string(&precious).unwrap(), "precious");
        assert!(!at("nowhere").exists() && fs::read_dir(at("elsewhere")).unwrap().next().is_none());
        fs::remove_dir_all(bench).unwrap();
    }
}
