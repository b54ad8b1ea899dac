//! The place each test works at: a folder of its own, a small case, the command.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A sphere on a half-space with friction: 24 x 24 cells, Hertz contact radius 32e-6 at most. Solved in a blink.
pub const SPHERE: &str = r#"title = "a small sphere"

[grid]
cells = [24, 24]
size = [240e-6, 240e-6]

[upper]
rigid = true

[lower]
substrate = { young = 210e9, poisson = 0.3 }

[profile.sphere]
radius = 10e-3

[friction]
coefficient = 0.1

[[load]]
name = "indent"
normal_force = 1.0
increments = 3

[[load]]
name = "fretting"
tangential_force = [0.05, 0.0]
cycles = 2
increments = 8

[output]
fields = ["pressure", "shear", "zone"]
every = 5
"#;

/// A folder that is gone after the test.
pub struct Bench {
    /// Where it lies.
    pub folder: PathBuf,
}

/// How the command ended.
pub struct Answer {
    /// The exit code; none when a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Bench {
    /// Names of the warnings of the results in a folder, as a list.
    pub fn warnings(&self, results: &str) -> String {
        let record: serde_json::Value =
            serde_json::from_str(&self.text(&format!("{results}/run.json"))).unwrap();
        let warnings = record["warnings"].as_array().unwrap();
        let names: Vec<&str> = warnings.iter().map(|warning| warning["name"].as_str().unwrap()).collect();
        if names.is_empty() { "[]".to_owned() } else { names.join(", ") }
    }

    /// A folder named after the test, empty.
    pub fn new(test: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{test}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self { folder }
    }

    /// Writes a file into the folder.
    pub fn file(&self, name: &str, text: &str) -> &Self {
        std::fs::write(self.folder.join(name), text).unwrap();
        self
    }

    /// The command, to be started in the folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fret"));
        command.args(arguments).current_dir(&self.folder);
        command
    }

    /// Runs the command in the folder.
    pub fn fret(&self, arguments: &[&str]) -> Answer {
        Answer::from(self.command(arguments).output().unwrap())
    }

    /// Names of what lies in the folder.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The text of a file in the folder.
    pub fn text(&self, path: &str) -> String {
        std::fs::read_to_string(self.folder.join(path)).unwrap()
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

impl From<Output> for Answer {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}
