//! `run.json`: what was computed, by which version, with what, and how it ended.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use fret_core::history::Warning;
use fret_core::model::digest;
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::plausibility;
use serde_json::{Map, Value, json};

use crate::case_file::CaseFile;
use crate::commit::{COMMIT, is_clean};
use crate::failure::Failure;
use crate::origin::Origin;
use crate::tally::Tally;

/// Version of the folder's format.
pub const FORMAT: u32 = 1;

/// How a run ended that did not come to the end of its history.
#[derive(Debug)]
pub struct Ending {
    /// One word: interrupted, failed, refused.
    pub status: String,
    /// Why.
    pub message: String,
}

impl Ending {
    /// The end by a failure.
    pub fn of(failure: &Failure) -> Self {
        Self { status: failure.status().to_owned(), message: failure.message() }
    }
}

/// The record of a run, without its end.
#[derive(Debug)]
pub struct RunRecord(Value);

impl RunRecord {
    /// The record of a run that starts now.
    pub fn new(case_file: &CaseFile, plan: &Plan, threads: usize, origin: Option<&Origin>) -> Self {
        let started = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Self(json!({
            "format": FORMAT,
            "program": "fretting",
            "version": env!("CARGO_PKG_VERSION"),
            "commit": COMMIT,
            "tree_is_clean": is_clean(),
            "started_unix_s": started,
            "resumed": 0,
            "threads": threads,
            "tolerance": plan.case.tolerance,
            "case_file": {
                "name": case_file.path.file_name().map(|name| name.to_string_lossy()),
                "fnv1a64": digest(case_file.text.bytes()),
                "path_fnv1a64": place_hash(case_file),
            },
            "question_fnv1a64": question(plan),
            "start": origin.map(|origin| json!({
                "results": origin.results,
                "increment": origin.increment,
                "fnv1a64": origin.start.digest(),
            })),
            "line_contact": plan.grid.is_line(),
            "plan": resolved(plan),
            "warnings": plausibility::of_plan(plan),
        }))
    }

    /// The record of a run that goes on where the one recorded as `earlier` was broken off.
    #[must_use]
    pub fn continuing(mut self, earlier: &Value) -> Self {
        self.0["started_unix_s"] = earlier["started_unix_s"].clone();
        if self.0["start"].is_null() {
            self.0["start"] = earlier["start"].clone(); // told by the folder alone where the call does not name it
        }
        self.0["resumed"] = json!(earlier["resumed"].as_u64().unwrap_or(0) + 1);
        self
    }

    /// As it stands while the run goes; as it stays when the run is killed.
    pub fn running(&self) -> Vec<u8> {
        written(&self.with(json!({ "status": "running" })))
    }

    /// As it stands after the run.
    pub fn ended(
        &self,
        (tally, warnings): (&Tally, &[Warning]),
        wall_s: f64,
        early: Option<&Ending>,
        // What is kept besides, for those who read it back.
        kept: Map<String, Value>,
    ) -> Vec<u8> {
        let mut record = self.with(json!({
            "status": early.map_or("solved", |early| early.status.as_str()),
            "message": early.map(|early| early.message.as_str()),
            "worn_through": tally.worn_through,
            "worn_by_layer": tally.worn_by_layer,
            "quantities_of_interest": tally.stage_quantities,
            "warnings": warnings,
            "totals": {
                "increments": tally.solved,
                "convolutions": tally.work.convolutions,
                "preconditioner_passes": tally.work.preconditioner_passes,
                "outer_iterations": tally.work.outer_iterations,
                "largest_residual": tally.largest_residual,
                "dissipated_energy": tally.stage_ends.last().map_or(0.0, |record| record.dissipated_energy),
                "worn_volume": tally.stage_ends.last().map_or(0.0, |record| record.worn_volume),
                "max_worn_depth": tally.stage_ends.last().map_or(0.0, |record| record.max_worn_depth),
                "wall_s": wall_s,
            },
        }));
        record.extend(kept);
        written(&record)
    }

    fn with(&self, end: Value) -> Map<String, Value> {
        let mut record = self.0.as_object().cloned().unwrap_or_default();
        if let Value::Object(end) = end {
            record.extend(end);
        }
        record
    }
}

fn written(record: &Map<String, Value>) -> Vec<u8> {
    (serde_json::to_string_pretty(record).unwrap_or_default() + "\n").into_bytes()
}

/// A plan as JSON, with the case as it was understood: every default filled in.
pub fn resolved(plan: &Plan) -> Value {
    plan.to_json()
}

/// The same of the plan in a record.
pub fn recorded_question(record: &Value) -> String {
    let plan = &record["plan"];
    let mut asked = json!({ "case": plan["case"], "grid": plan["grid"], "coupling": plan["coupling"] });
    if plan["leave_out"] != json!(LeaveOut::ALL) {
        asked["leave_out"] = plan["leave_out"].clone();
    }
    if !record["start"].is_null() {
        asked["start"] = record["start"]["fnv1a64"].clone();
    }
    digest(asked.to_string().bytes())
}

/// A digest of what is asked, as it was understood: the same for texts that differ in words and order only.
pub fn question(plan: &Plan) -> String {
    let mut asked = json!({ "case": plan.case, "grid": plan.grid, "coupling": plan.coupling });
    if plan.leave_out != LeaveOut::ALL {
        asked["leave_out"] = json!(plan.leave_out); // other bits: the one does not go on where the other stopped
    }
    if let Some(start) = &plan.start {
        asked["start"] = json!(start.digest());
    }
    digest(asked.to_string().bytes())
}

/// Whether a record was made from the file that `case_file` was read from.
pub fn is_of_case(record: &Value, case_file: &CaseFile) -> bool {
    record["case_file"]["path_fnv1a64"] == place_hash(case_file)
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
