//! `levels/`: the finished levels of a study that is not finished, in files by the digest of what was solved, so that a study that
//! was stopped goes on where it was. The folder is gone when the study is finished.

use std::fs;
use std::path::{Path, PathBuf};

use fret_core::plan::Plan;
use fret_core::study::Level;

use crate::failure::{Failure, Unwritten};
use fret_results::{folder_below, question, read_packed, write_packed};

/// Name of the folder.
pub const LEVELS: &str = "levels";
const FIRST_LINE: &str = concat!("fretting level ", env!("CARGO_PKG_VERSION"), "\n");

/// The finished levels.
#[derive(Debug)]
pub struct Levels {
    path: PathBuf,
}

impl Levels {
    /// Those of the study in a folder.
    pub fn below(folder: &Path) -> Result<Self, Unwritten> {
        Ok(Self { path: folder_below(folder, Path::new(LEVELS))? })
    }

    /// The level that a plan solves, when it is finished; a file that cannot be read is none.
    pub fn finished(&self, plan: &Plan) -> Option<Level> {
        postcard::from_bytes(&read_packed(&self.place(plan), FIRST_LINE).ok()?).ok()
    }

    /// Writes a finished level down.
    pub fn keep(&self, plan: &Plan, level: &Level) -> Result<(), Failure> {
        Ok(write_packed(&self.place(plan), FIRST_LINE, postcard::to_stdvec(level).ok())?)
    }

    /// The study is finished: its answer stands in its own files.
    pub fn remove(self) {
        // What stays behind by a failure here is only litter.
        let _ = fs::remove_dir_all(self.path);
    }

    fn place(&self, plan: &Plan) -> PathBuf {
        self.path.join(question(plan))
    }
}
