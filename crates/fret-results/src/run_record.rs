//! `run.json`: what was computed, by which version, with what, and how it ended. What is written is what is read back (`record.rs`).

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use fret_core::history::{Warning, WornByLayer, WornThrough};
use fret_core::model::digest;
use fret_core::plan::{LeaveOut, Plan, PlanRecord};
use fret_core::run::plausibility;
use fret_core::study::StageQuantities;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::case_file::CaseFile;
use crate::commit::{COMMIT, is_clean};
use crate::tally::Tally;

/// Version of the folder's format.
pub const FORMAT: u32 = 1;
/// The program that writes it.
pub const PROGRAM: &str = "fretting";

/// How a run ended that did not come to the end of its history.
#[derive(Debug)]
pub struct Ending {
    /// One word: interrupted, failed, refused.
    pub status: String,
    /// Why.
    pub message: String,
}

/// Where a run starts from, as it is written down.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StartedFrom {
    /// The folder of the results, as it was named.
    pub results: String,
    /// The number of the increment there, from 0.
    pub increment: usize,
    /// Digest of the state.
    pub fnv1a64: String,
}

/// The file of the case, as it is written down.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct CaseNamed {
    /// Its name.
    pub name: Option<String>,
    /// Digest of its text.
    pub fnv1a64: String,
    /// Digest of its place.
    pub path_fnv1a64: String,
}

/// The record of a run. What older versions did not write yet may be missing.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Record<P = PlanRecord> {
    /// Version of the format.
    pub format: u32,
    /// The program.
    pub program: String,
    /// Its version.
    pub version: String,
    /// The commit that it was built from, or "unknown".
    #[serde(default)]
    pub commit: String,
    /// Whether its sources were those of the commit, where that is known.
    pub tree_is_clean: Option<bool>,
    /// When the run started [s since 1970].
    pub started_unix_s: Option<u64>,
    /// How often it was resumed.
    pub resumed: u64,
    /// Threads that solved it.
    pub threads: usize,
    /// Bound on the residual.
    pub tolerance: f64,
    /// The file of the case.
    pub case_file: CaseNamed,
    /// Digest of the question.
    pub question_fnv1a64: Option<String>,
    /// The state that it started from; `None`: bodies apart.
    pub start: Option<StartedFrom>,
    /// How many shapes of the profile, the first ones, are the upper body's.
    pub shapes_of_upper: Option<usize>,
    /// Whether it is a line contact.
    pub line_contact: bool,
    /// The plan, with the case as it was understood.
    pub plan: P,
    /// What may mislead.
    pub warnings: Vec<Warning>,
    /// One word: running, solved, interrupted, failed, refused.
    pub status: String,
    /// What is known once it has ended.
    #[serde(flatten)]
    pub end: Option<End>,
}

/// What is known of a run once it has ended.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct End {
    /// Why early, if it did.
    pub message: Option<String>,
    /// Where and when the surfaces were worn through.
    pub worn_through: Option<WornThrough>,
    /// Volumes lost by the layers.
    pub worn_by_layer: Option<WornByLayer>,
    /// Quantities of interest at the ends of the stages.
    pub quantities_of_interest: Vec<StageQuantities>,
    /// Sums over the history.
    pub totals: Totals,
    /// Checksums of the texts beside the record.
    #[serde(default)]
    pub checksums: BTreeMap<String, u32>,
    /// Increments with a state to start from.
    #[serde(default)]
    pub states: Vec<usize>,
    /// Whether what the solver remembered at the end lies beside them.
    #[serde(default)]
    pub memory: bool,
}

/// Sums over a history, and its last numbers.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Totals {
    /// Increments solved.
    pub increments: usize,
    /// Operator products.
    pub convolutions: usize,
    /// Passes of the preconditioner.
    pub preconditioner_passes: usize,
    /// Outer iterations.
    pub outer_iterations: usize,
    /// Largest residual of all increments.
    pub largest_residual: f64,
    /// Dissipated energy [force x length].
    pub dissipated_energy: f64,
    /// Wear volume [length^3].
    pub worn_volume: f64,
    /// Largest wear depth [length].
    pub max_worn_depth: f64,
    /// Time of the run [s].
    pub wall_s: f64,
}

impl Totals {
    fn of(tally: &Tally, wall_s: f64) -> Self {
        let last = tally.stage_ends.last();
        Self {
            increments: tally.solved,
            convolutions: tally.work.convolutions,
            preconditioner_passes: tally.work.preconditioner_passes,
            outer_iterations: tally.work.outer_iterations,
            largest_residual: tally.largest_residual,
            dissipated_energy: last.map_or(0.0, |record| record.dissipated_energy),
            worn_volume: last.map_or(0.0, |record| record.worn_volume),
            max_worn_depth: last.map_or(0.0, |record| record.max_worn_depth),
            wall_s,
        }
    }
}

/// The record of a run while it is written.
pub type RunRecord = Record<Value>;

impl RunRecord {
    /// The record of a run that starts now.
    pub fn new(case_file: &CaseFile, plan: &Plan, threads: usize, start: Option<&StartedFrom>) -> Self {
        let started = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Self {
            format: FORMAT,
            program: PROGRAM.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: COMMIT.to_owned(),
            tree_is_clean: is_clean(),
            started_unix_s: Some(started),
            resumed: 0,
            threads,
            tolerance: plan.case.tolerance,
            case_file: CaseNamed {
                name: case_file.path.file_name().map(|name| name.to_string_lossy().into_owned()),
                fnv1a64: digest(case_file.text.bytes()),
                path_fnv1a64: place_hash(case_file),
            },
            question_fnv1a64: Some(question(plan)),
            start: start.cloned(),
            shapes_of_upper: Some(plan.case.profile.of_upper[0]),
            line_contact: plan.grid.dimension().into(),
            plan: plan.to_json(),
            warnings: plausibility::of_plan(plan),
            status: "running".to_owned(),
            end: None,
        }
    }

    /// The record of a run that goes on where the one that left `earlier` was broken off.
    #[must_use]
    pub fn continuing(mut self, earlier: &Glance) -> Self {
        self.started_unix_s = earlier.started_unix_s;
        self.start = self.start.or_else(|| earlier.start.clone()); // told by the folder alone where the call does not name it
        self.resumed = earlier.resumed + 1;
        self
    }

    /// As it stands while the run goes; as it stays when the run is killed.
    pub fn running(&self) -> Vec<u8> {
        self.written()
    }

    /// As it stands after the run; `kept` are the checksums of what lies beside it, the increments with a state, and whether the solver's
    /// memory is kept.
    pub fn ended(
        self,
        (tally, warnings): (&Tally, &[Warning]),
        wall_s: f64,
        early: Option<&Ending>,
        (checksums, states, memory): (BTreeMap<String, u32>, Vec<usize>, bool),
    ) -> Vec<u8> {
        let end = End {
            message: early.map(|early| early.message.clone()),
            worn_through: tally.worn_through,
            worn_by_layer: tally.worn_by_layer.clone(),
            quantities_of_interest: tally.stage_quantities.clone(),
            totals: Totals::of(tally, wall_s),
            checksums,
            states,
            memory,
        };
        let status = early.map_or("solved", |early| &early.status).to_owned();
        Self { status, warnings: warnings.to_vec(), end: Some(end), ..self }.written()
    }

    fn written(&self) -> Vec<u8> {
        format!("{:#}\n", json!(self)).into_bytes()
    }
}

/// What is asked of a record before it is known to be one of this version; of what is no record, nothing.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub struct Glance {
    /// The program.
    pub program: String,
    /// Version of the format.
    pub format: u32,
    /// One word.
    pub status: String,
    /// Why the run ended early.
    pub message: Option<String>,
    /// The file of the case.
    pub case_file: CaseNamed,
    /// Digest of the question.
    pub question_fnv1a64: Option<String>,
    started_unix_s: Option<u64>,
    start: Option<StartedFrom>,
    resumed: u64,
}

impl Glance {
    /// The record in some bytes.
    pub fn at(bytes: &[u8]) -> Self {
        serde_json::from_slice(bytes).unwrap_or_default()
    }

    /// Whether it is a record of this program and format.
    pub fn is_known(&self) -> bool {
        self.program == PROGRAM && self.format == FORMAT
    }

    /// Whether its run ended by its own: it would do so again.
    pub fn ended_without_answer(&self) -> bool {
        self.status == "failed" || self.status == "refused"
    }

    /// Why its run ended.
    pub fn why(&self) -> &str {
        self.message.as_deref().unwrap_or("unknown reason")
    }

    /// Whether its run started from the state that a plan starts from.
    pub fn starts_as(&self, plan: &Plan) -> bool {
        self.start.as_ref().map(|start| start.fnv1a64.as_str())
            == plan.start.as_ref().map(|start| start.digest())
    }

    /// Whether it was made from the file that `case_file` was read from.
    pub fn is_of_case(&self, case_file: &CaseFile) -> bool {
        self.case_file.path_fnv1a64 == place_hash(case_file)
    }
}

/// What is asked, as it was understood: the same for texts that differ in words and order only.
#[derive(Serialize, Deserialize)]
struct Question {
    case: Value,
    grid: Value,
    coupling: Value,
    /// Other ones than usual give other bits: the one does not go on where the other stopped.
    #[serde(default, skip_serializing_if = "is_usual")]
    leave_out: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<String>,
}

fn is_usual(leave_out: &Value) -> bool {
    *leave_out == json!(LeaveOut::ALL)
}

impl Question {
    fn digest(&self) -> String {
        digest(json!(self).to_string().bytes())
    }
}

/// A digest of what a plan asks.
pub fn question(plan: &Plan) -> String {
    Question {
        case: json!(plan.case),
        grid: json!(plan.grid),
        coupling: json!(plan.coupling),
        leave_out: json!(plan.leave_out),
        start: plan.start.as_ref().map(|start| start.digest().to_owned()),
    }
    .digest()
}

/// The same of the plan in a record, letter by letter; none where it has none.
pub fn recorded_question(record: &Value, start: Option<&StartedFrom>) -> Option<String> {
    let asked = Question::deserialize(record.get("plan")?).ok()?;
    Some(Question { start: start.map(|start| start.fnv1a64.clone()), ..asked }.digest())
}

/// A case file's place, told apart from others without telling a reader of the results where the user's files lie. A text that
/// came from no file is its own place.
fn place_hash(case_file: &CaseFile) -> String {
    if case_file.beside.is_some() { digest(case_file.text.bytes()) } else { path_hash(&case_file.path) }
}

fn path_hash(path: &Path) -> String {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    digest(path.as_os_str().as_encoded_bytes().iter().copied())
}
