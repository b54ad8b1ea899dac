//! What the histories of a sweep have in common: first stages that several of them begin with alike, and the compliance of bodies that
//! stay the same from one to the next. Each is made once; every history keeps the bits that it has alone.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use serde_json::json;

use super::beginning::Beginning;
use super::checkpoint::Checkpoint;
use super::observer::Observer;
use super::pair_compliance::PairCompliance;
use super::run_error::RunError;
use super::simulation::Simulation;
use crate::history::{History, setting, way_of_solving};
use crate::machine::memory::{Claim, claim};
use crate::model::digest;
use crate::plan::Plan;

/// What histories have in common.
#[derive(Debug, Default)]
pub struct InCommon {
    /// The beginnings of several histories, by the number of a history.
    beginnings: HashMap<usize, Arc<CommonBeginning>>,
    count: usize,
    /// The compliance that was asked for last.
    compliance: Mutex<Option<Arc<CommonCompliance>>>,
}

/// What may come to nothing: there is no solution, or not the memory for it.
type Once<T> = OnceLock<Option<(Arc<T>, Claim)>>;

/// First stages that several histories have in common.
#[derive(Debug)]
struct CommonBeginning {
    stages: usize,
    solved: Once<Beginning>,
}

/// The compliance of all histories that depend on the same.
#[derive(Debug)]
struct CommonCompliance {
    depends_on: String,
    made: Once<PairCompliance>,
}

/// What of a case no increment depends on, or its setting has by other names.
const AFTERWARDS: [&str; 12] = [
    "title",
    "units",
    "cells",
    "size",
    "bodies",
    "profile",
    "residual_stress",
    "fatigue",
    "conduction",
    "log_columns",
    "output",
    "stress",
];

/// For each number of first stages, from one on, a name of all that these depend on: histories that agree in it solve them alike, bit by bit.
pub fn beginnings(plan: &Plan) -> Vec<String> {
    let mut as_json = plan.to_json();
    let (setting, way) = (setting(&as_json), way_of_solving(&as_json));
    let stages = as_json["case"]["stages"].take();
    // All of the case but what only comes after a run.
    let mut rest = as_json["case"].take();
    if let Some(rest) = rest.as_object_mut() {
        rest.retain(|name, _| !AFTERWARDS.contains(&name.as_str()));
    }
    let start = plan.start.as_ref().map(|start| start.digest().to_owned());
    let all = json!([setting, way, rest, start]).to_string();
    let stages = stages.as_array().map_or(&[][..], Vec::as_slice);
    (1..=stages.len()).map(|count| digest(format!("{all}{}", json!(stages[..count])).into_bytes())).collect()
}

impl InCommon {
    /// Of histories with their numbers and [`beginnings`].
    pub fn of(histories: &[(usize, Vec<String>)]) -> Self {
        let mut counts: HashMap<&str, usize> = HashMap::new();
        for name in histories.iter().flat_map(|(_, beginnings)| beginnings) {
            *counts.entry(name).or_default() += 1;
        }
        let mut common: HashMap<&str, Arc<CommonBeginning>> = HashMap::new();
        let mut beginnings = HashMap::new();
        for (number, names) in histories {
            // The last stage ends the history: one that is another one's double is solved by itself.
            let before_last = names.len().saturating_sub(1);
            let longest = (1..=before_last).rev().find(|stages| counts[names[stages - 1].as_str()] > 1);
            if let Some(stages) = longest {
                let of_these = common.entry(&names[stages - 1]);
                let one =
                    of_these.or_insert_with(|| Arc::new(CommonBeginning { stages, solved: OnceLock::new() }));
                beginnings.insert(*number, Arc::clone(one));
            }
        }
        Self { beginnings, count: common.len(), compliance: Mutex::default() }
    }

    /// How many beginnings several histories have in common.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Solves a history, and says how many of its increments came from a common beginning. Who comes first makes what is in common while
    /// the others wait, so each caller needs a thread pool of its own.
    pub fn solve(
        &self,
        number: usize,
        simulation: Simulation<'_>,
        observer: &mut dyn Observer,
    ) -> (History, Result<(), RunError>, usize) {
        let compliance = self.compliance(simulation.plan());
        let simulation = simulation.with_compliance(compliance);
        if let Some(beginning) = self.beginning(number, &simulation, observer) {
            let (history, outcome) = beginning.followed_by(&simulation, observer);
            return (history, outcome, beginning.increments());
        }
        let (history, outcome) = simulation.follow(Checkpoint::start(simulation.plan()), observer);
        (history, outcome, 0)
    }

    /// What a history begins with, solved by now; `None` where it is to be solved alone.
    fn beginning(
        &self,
        number: usize,
        simulation: &Simulation<'_>,
        observer: &mut dyn Observer,
    ) -> Option<Arc<Beginning>> {
        let common = self.beginnings.get(&number)?;
        // A state and what the solver remembers: less than the run takes in all.
        let bytes = simulation.plan().memory_bytes / 2;
        once(&common.solved, bytes, || simulation.beginning(common.stages, observer).ok()?)
    }

    /// The compliance of a plan: that of the plan before where both depend on the same.
    fn compliance(&self, plan: &Plan) -> Option<Arc<PairCompliance>> {
        let depends_on = PairCompliance::depends_on(plan);
        let common = {
            let mut latest = self.compliance.lock().unwrap_or_else(PoisonError::into_inner);
            match &*latest {
                Some(common) if common.depends_on == depends_on => Arc::clone(common),
                _ => Arc::clone(
                    latest.insert(Arc::new(CommonCompliance { depends_on, made: OnceLock::new() })),
                ),
            }
        };
        once(&common.made, PairCompliance::bytes(plan), || Some(PairCompliance::of(plan)))
    }
}

/// Makes something once, in memory of its own [bytes].
fn once<T>(place: &Once<T>, bytes: usize, make: impl FnOnce() -> Option<T>) -> Option<Arc<T>> {
    let made = place.get_or_init(|| {
        let memory = claim(bytes).ok()?;
        Some((Arc::new(make()?), memory))
    });
    made.as_ref().map(|(made, _)| Arc::clone(made))
}
