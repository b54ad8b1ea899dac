//! A solved state that another history starts from: all that lasts of what came before, and what it is a state of.
//!
//! A state belongs to a setting: grid, bodies, profile. Friction, loads, wear and tolerances of the history that starts from it
//! are its own.

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::records::History;
use crate::case::Difference;
use crate::model::{SolvedState, digest};
use crate::solver::SolverMemory;

/// Grids whose spacings agree to this are one grid: what rounding a printed side length leaves.
const SAME_SPACING: f64 = 1e-9;

/// A solved state with its setting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// Grid, bodies and profile, as JSON with the keys of a case.
    setting: String,
    /// The state.
    pub solved: SolvedState,
    /// What the solver remembered, and as JSON of which way of solving and under which friction: one that goes on in the same way has the bits it
    /// would have had.
    memory: Option<(SolverMemory, String)>,
    #[serde(skip)]
    digest: OnceLock<String>,
}

impl Start {
    /// A state solved by a plan, which is given as JSON; `None` where that is no plan, or the state none of its grid.
    /// With what the solver remembered, and in which stage.
    pub fn new(plan: &Value, solved: SolvedState, memory: Option<(SolverMemory, usize)>) -> Option<Self> {
        let memory = memory.map(|(memory, stage)| {
            (memory, json!([way_of_solving(plan), friction_in(plan, stage)]).to_string())
        });
        Self { setting: setting(plan).to_string(), solved, memory, digest: OnceLock::new() }.sound()
    }

    /// The state of a history at the end of an increment; `None` where what is kept of it is not enough.
    pub fn of(history: &History, increment: usize) -> Option<Self> {
        let kept = history.fields_of(increment);
        let stage = history.steps.iter().find(|step| step.increment == increment).map(|step| step.stage);
        let memory = kept.and_then(|kept| kept.memory.as_deref().cloned()).zip(stage);
        let solved = if history.steps.last()?.increment == increment {
            history.end.clone().completed(|name| history.state.field(name).cloned().ok_or(()))
        } else {
            let kept = kept?;
            let rest = kept.rest.as_deref()?.clone();
            rest.completed(|name| kept.field(name).cloned().ok_or(()))
        };
        Self::new(&history.plan, solved.ok()?, memory)
    }

    /// Increments of a history that another one can start from.
    pub fn all_of(history: &History) -> Vec<usize> {
        let kept = history.fields.iter().filter(|kept| kept.rest.is_some()).map(|kept| kept.increment);
        let mut all: Vec<usize> = kept.chain(history.steps.last().map(|step| step.increment)).collect();
        all.dedup();
        all
    }

    /// Its bytes, in a compact form, floats bit by bit; none where the encoder refuses, which it does for no solved state.
    pub fn to_bytes(&self) -> Option<Vec<u8>> {
        postcard::to_stdvec(self).ok()
    }

    /// The state of some bytes; `None` where they are those of none.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (start, rest) = postcard::take_from_bytes::<Self>(bytes).ok()?;
        if rest.is_empty() { start.sound() } else { None }
    }

    /// A hash of its bytes: tells it from other states.
    pub fn digest(&self) -> &str {
        self.digest.get_or_init(|| digest(self.to_bytes().unwrap_or_default()))
    }

    /// The same, when its fields are sound ones of its grid.
    fn sound(self) -> Option<Self> {
        let cells = serde_json::from_value(self.grid("cells")).ok()?;
        self.solved.state.is_sound(cells).then_some(self)
    }

    fn grid(&self, key: &str) -> Value {
        let setting: Value = serde_json::from_str(&self.setting).unwrap_or_default();
        setting["grid"][key].clone()
    }

    /// Spacing of its grid [length].
    pub(crate) fn spacing(&self) -> Option<[f64; 2]> {
        serde_json::from_value(self.grid("spacing")).ok()
    }

    /// Whether a grid of this spacing is the state's, but for rounding.
    pub(crate) fn has_spacing(&self, spacing: [f64; 2]) -> bool {
        self.spacing().is_some_and(|own| {
            own.iter().zip(spacing).all(|(own, other)| (other / own - 1.0).abs() <= SAME_SPACING)
        })
    }

    /// Where a plan, which is given as JSON, has another setting than the state.
    pub(crate) fn differences(&self, plan: &Value) -> Vec<Difference> {
        let mut own: Value = serde_json::from_str(&self.setting).unwrap_or_default();
        if own.is_object() && own["kinematics"].is_null() {
            own["kinematics"] = json!({ "displacement": "small" }); // of a version that knew no other
        }
        let mut of_case = setting(plan);
        let reached = &self.solved.state;
        // A contact that has not rolled lies in the same place in both frames; surfaces that have not slipped remember nothing.
        let matters = [
            (FRAME, "kinematics.frame", "bodies", reached.roll != [0.0; 2]),
            (WHOSE_FRICTION, "friction.moves_with", "lower", reached.accumulated.is_some()),
            (BEYOND_MAPS, "kinematics.beyond_maps", "edge", reached.roll != [0.0; 2]),
        ];
        let words = matters.map(|(name, _, default, _)| {
            [&mut of_case, &mut own].map(|setting| {
                let given = setting.as_object_mut().and_then(|setting| setting.remove(name));
                given.and_then(|word| Some(word.as_str()?.to_owned())).unwrap_or_else(|| default.to_owned())
            })
        });
        let mut found = Vec::new();
        differences("", &of_case, &own, &mut found);
        for ((_, key, _, matters), [case, state]) in matters.into_iter().zip(words) {
            if matters && case != state {
                found.push(Difference { key: key.to_owned(), case, state });
            }
        }
        found
    }

    /// What the solver remembered, for a plan, given as JSON, that solves in the same way. Under another friction no increment goes on.
    pub(crate) fn memory_for(&self, plan: &Value) -> Option<SolverMemory> {
        let (memory, of) = self.memory.as_ref()?;
        let (way, friction): (String, Value) = serde_json::from_str(of).ok()?;
        let memory = (way == way_of_solving(plan)).then(|| memory.clone())?;
        Some(if friction == *friction_in(plan, 0) { memory } else { memory.without_increments_before() })
    }
}

/// Key of the frame in which a contact rolls.
const FRAME: &str = "frame";
/// Key of what lies beyond maps that travel through the grid.
const BEYOND_MAPS: &str = "beyond_maps";
/// Key of the body to whose places a friction map, and what friction follows, belong.
const WHOSE_FRICTION: &str = "friction_of";

/// What a state belongs to, with the keys that a case has for it.
pub(crate) fn setting(plan: &Value) -> Value {
    let case = &plan["case"];
    let mut setting = json!({
        "grid": {
            "cells": plan["grid"]["cells"],
            "spacing": plan["grid"]["spacing"],
            "periodic": case["periodic"],
        },
        "upper": case["bodies"]["upper"],
        "lower": case["bodies"]["lower"],
        "profile": case["profile"],
        "kinematics": { "displacement": displacement(case) },
        FRAME: case["kinematics"]["frame"],
        BEYOND_MAPS: case["kinematics"]["beyond_maps"],
        WHOSE_FRICTION: if case["kinematics"]["friction_of_upper"] == true { "upper" } else { "lower" },
    });
    // approach and shift of a line contact are relative to it
    if !plan["datum"].is_null() {
        setting["grid"]["datum"] = plan["datum"].clone();
    }
    setting
}

/// How far the surfaces of a case are taken to move; one that does not say is one of small displacements.
fn displacement(case: &Value) -> Value {
    let given = &case["kinematics"]["displacement"];
    if given.is_null() { Value::from("small") } else { given.clone() }
}

/// What a solver's memory belongs to besides.
pub(crate) fn way_of_solving(plan: &Value) -> String {
    let case = &plan["case"];
    let shortcuts =
        ["coupling", "along", "symmetry", "single_precision", "leave_out"].map(|name| &plan[name]);
    // what the response and the laws of pressure have besides
    let gives = [&case["hardness"], &case["wear"]["debris"]["stiffness"]];
    json!([shortcuts, case["tolerance"], case["scheme"], case["integration"], gives]).to_string()
}

/// The friction law in a stage of a plan, given as JSON.
fn friction_in(plan: &Value, stage: usize) -> &Value {
    let case = &plan["case"];
    let stages = case["stages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mut latest_first = stages.iter().take(stage + 1).rev().map(|stage| &stage["friction"]);
    latest_first.find(|friction| !friction.is_null()).unwrap_or(&case["friction"])
}

fn differences(key: &str, case: &Value, state: &Value, found: &mut Vec<Difference>) {
    match (case, state) {
        (Value::Object(one), Value::Object(other)) if one.keys().eq(other.keys()) => {
            for (name, value) in one {
                differences(&joined(key, name), value, &other[name], found);
            }
        }
        (Value::Array(one), Value::Array(other))
            if one.len() == other.len() && one.iter().all(Value::is_object) =>
        {
            for (index, (one, other)) in one.iter().zip(other).enumerate() {
                let place = if key == "profile" { key.to_owned() } else { format!("{key}[{index}]") };
                differences(&place, one, other, found);
            }
        }
        _ if case != state => {
            found.push(Difference { key: key.to_owned(), case: case.to_string(), state: state.to_string() });
        }
        _ => {}
    }
}

/// The key of an entry as a case has it: the program's own words for kinds are left out.
fn joined(key: &str, name: &str) -> String {
    match name {
        "elastic" | "material" | "shapes" => key.to_owned(),
        "base" => format!("{key}.substrate"),
        _ if key.is_empty() => name.to_owned(),
        _ => format!("{key}.{name}"),
    }
}
