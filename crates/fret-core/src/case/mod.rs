//! The written question: a case, checked. Read from TOML text (`read`), judged all at once (`check`), refused with places (`refusal`).

mod arrays;
mod attachments;
mod bodies;
pub(crate) mod check;
mod coating;
mod controls;
mod course;
mod file;
mod friction;
mod judge;
mod line;
mod numbers;
mod pair;
mod read;
mod refusal;
mod repeating;
mod shape;
mod stage_file;
mod stages;
mod stress;
mod surface_file;
mod table;
mod wearing;
mod wording;

use serde::Serialize;

use crate::model::{ContactPair, CoulombFriction, LoadStep, Profile, Scheme, WearRule};

pub use attachments::{Attachments, content, unreadable};
pub(crate) use course::walk;
pub use course::{Course, Cycles, Path, Waveform};
pub use file::schema;
pub use numbers::{NumbersError, numbers};
pub use refusal::{CaseError, Difference, Mistake};
pub(crate) use stages::apart;
pub use stress::{FatigueRequest, Side, StressRequest};
pub use wording::{in_words, printable};

/// Fields that can be kept, by the names of the case file.
pub const FIELD_NAMES: [&str; 6] = ["pressure", "shear", "slip", "gap", "zone", "worn_depth"];

/// A case that has passed every check.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Title, or an empty text.
    pub title: String,
    /// Cells `[nx, ny]`; `[n, 1]` in a line contact.
    pub cells: [usize; 2],
    /// Side lengths of the grid.
    pub size: GridSize,
    /// Depth below the load that approach and shift of a line contact are relative to \[length\]; `None`: the size of the grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub datum: Option<f64>,
    /// Whether the scene repeats in x and y.
    pub periodic: bool,
    /// The two bodies.
    pub bodies: ContactPair,
    /// Undeformed gap.
    pub profile: Profile,
    /// Friction law at the start; stages may change it.
    pub friction: CoulombFriction,
    /// What is prescribed where the history starts; `None`: bodies that have not touched yet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<LoadStep>,
    /// Loading history.
    pub stages: Vec<Stage>,
    /// How the surfaces wear, when they do.
    pub wear: Option<WearRule>,
    /// Bound on the residual of every increment.
    pub tolerance: f64,
    /// How coupled pressure and shear are solved.
    pub scheme: Scheme,
    /// What is kept.
    pub output: Output,
    /// What is asked about stresses under the surface.
    pub stress: Option<StressRequest>,
    /// Where the case was written, for messages.
    #[serde(skip)]
    pub(crate) origin: Origin,
}

/// The text a case was read from, and where in it things stand.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Origin {
    pub name: String,
    pub text: String,
    pub size: std::ops::Range<usize>,
}

/// Side lengths of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum GridSize {
    /// Given [length]; of a line contact, the length and the width of one strip.
    Given([f64; 2]),
    /// Chosen so that the largest contact of the history fits with a margin.
    Auto,
}

/// One stage of the loading history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stage {
    /// Name for messages and tables.
    pub name: String,
    /// What changes normally, if anything.
    pub normal: Option<StageControl>,
    /// What changes tangentially along x and y, if anything.
    pub tangential: [Option<StageControl>; 2],
    /// What changes about z, if anything.
    pub twist: Option<StageControl>,
    /// Increments of the stage, or of one cycle, all rows of a table included.
    pub increments: usize,
    /// Each increment is solved in as many parts as this bound on the error of its history asks for (in shares of the way that the
    /// tractions go in it); in one when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history_tolerance: Option<f64>,
    /// How the stage runs through its increments.
    pub course: Course,
    /// Friction from this stage on; as before when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<CoulombFriction>,
}

/// What a stage prescribes in one direction, and how it runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StageControl {
    /// A force [force] or moment [force x length].
    Force(Path),
    /// A motion [length] or rotation [rad].
    Motion(Path),
}

/// What of the solution is kept.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Output {
    /// Names out of [`FIELD_NAMES`].
    pub fields: Vec<String>,
    /// Fields of every so many increments of a stage are kept, and of its last; `None`: of the last only.
    pub every: Option<usize>,
}

impl Case {
    /// Reads and checks a case from TOML text that names no other files. `name` stands in messages (a file name).
    ///
    /// # Errors
    /// With every mistake found, each with its place and a way out.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_toml_with(text, name, Attachments::none())
    }

    /// As [`Case::from_toml`]; `attachments` hands in the files and arrays the case names.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_toml_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        read::case(text, name, attachments)
    }

    /// Reads and checks a case given as JSON text of the same structure; messages show it as TOML.
    ///
    /// # Errors
    /// As [`Case::from_toml`]; also when the text is not a JSON object.
    pub fn from_json(text: &str, name: &str) -> Result<Self, CaseError> {
        Self::from_json_with(text, name, Attachments::none())
    }

    /// As [`Case::from_json`]; `attachments` hands in the files and arrays the case names. The n-th array stands in the case as
    /// `{ "array": n }`.
    ///
    /// # Errors
    /// As [`Case::from_json`]; also when a file or an array cannot be had or does not hold what the case says.
    pub fn from_json_with(text: &str, name: &str, attachments: Attachments<'_>) -> Result<Self, CaseError> {
        let refuse = |message: String| CaseError::plain(name, message);
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|error| refuse(format!("not readable as JSON: {error}")))?;
        let table = toml::Table::try_from(without_null(value))
            .map_err(|error| refuse(format!("not a case: {error}")))?;
        let text = toml::to_string(&table).map_err(|error| refuse(format!("not a case: {error}")))?;
        Self::from_toml_with(&text, name, attachments)
    }

    /// Whether it is a line contact: plane strain across a line along y, all loads per unit length.
    pub fn is_line(&self) -> bool {
        self.cells[1] == 1
    }

    /// Whether there is no friction anywhere in the whole history.
    pub fn is_frictionless(&self) -> bool {
        let changes = self.stages.iter().filter_map(|stage| stage.friction.as_ref());
        std::iter::once(&self.friction).chain(changes).all(CoulombFriction::is_frictionless)
    }

    /// Refuses the case for its grid's side lengths.
    pub(crate) fn refuse_size(&self, message: String, help: &str) -> CaseError {
        let mistake = Mistake { message, help: Some(help.to_owned()), span: Some(self.origin.size.clone()) };
        CaseError::new(&self.origin.name, &self.origin.text, vec![mistake])
    }

    /// Refuses the case for the state that its history would start from, which is one of another setting.
    pub(crate) fn refuse_start(&self, differences: &[Difference]) -> CaseError {
        let text = &self.origin.text;
        let tables = toml::de::DeTable::parse(text).ok().map(toml::Spanned::into_inner);
        let mistakes = differences.iter().map(|Difference { key, case, state }| {
            let table = key.split(['.', '[']).next().unwrap_or_default();
            let found = tables.as_ref().and_then(|tables| {
                tables.keys().find(|written| written.get_ref().as_ref() == table).map(toml::Spanned::span)
            });
            Mistake {
                message: format!("{key} = {case}: the state to start from has {state}"),
                help: Some(
                    "grid, bodies and profile are those of the state; loads, friction and wear may differ"
                        .to_owned(),
                ),
                span: found,
            }
        });
        CaseError::new(&self.origin.name, text, mistakes.collect())
    }

    /// Whether fields are kept of increment `k` (from 1) of a stage: of every `output.every`-th, and of the last.
    pub fn keeps(&self, stage: usize, k: usize) -> bool {
        self.output.every.is_some_and(|every| k.is_multiple_of(every))
            || k == self.stages[stage].increments_in_all()
    }

    /// Numbers in the whole history, from 0, of the increments whose fields are kept.
    pub fn kept_increments(&self) -> Vec<usize> {
        let mut kept = Vec::new();
        let mut before = 0;
        for (number, stage) in self.stages.iter().enumerate() {
            let all = stage.increments_in_all();
            kept.extend((1..=all).filter(|&k| self.keeps(number, k)).map(|k| before + k - 1));
            before += all;
        }
        kept
    }

    /// Whether the history may end before all its increments: a stage that stops when it is steady, or wear in blocks of
    /// cycles or up to a limit.
    pub fn is_open_ended(&self) -> bool {
        let steady = |stage: &Stage| stage.cycles().is_some_and(|cycles| cycles.until_steady.is_some());
        self.stages.iter().any(steady)
            || self.wear.as_ref().is_some_and(|wear| wear.every > 1 || wear.limit.is_some())
    }

    /// Increments of the whole history, at the most.
    pub fn increments(&self) -> usize {
        self.stages.iter().map(Stage::increments_in_all).sum()
    }
}

/// JSON's null means "not given"; TOML has no word for it.
fn without_null(value: serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Object(map) => Value::Object(
            map.into_iter().filter(|(_, v)| !v.is_null()).map(|(k, v)| (k, without_null(v))).collect(),
        ),
        Value::Array(items) => Value::Array(items.into_iter().map(without_null).collect()),
        other => other,
    }
}
