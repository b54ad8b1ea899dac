//! What a point of a sweep came to.

use fret_core::case::Course;
use fret_core::history::{Regime, StepRecord};
use fret_core::plan::Plan;
use serde_json::{Value, json};

use crate::failure::Failure;

/// What a point came to, as it is written down.
#[derive(Debug, Clone)]
pub struct Answer(pub Value);

impl Answer {
    /// The answer of a solved point.
    pub fn solved(plan: &Plan, steps: &[StepRecord]) -> Self {
        Self(json!({
            "status": "solved",
            "message": "",
            "end": steps.last(),
            "stages": stage_ends(steps),
            "cycle": last_cycle(plan, steps),
        }))
    }

    /// Of a point that was refused or could not be solved.
    pub fn unsolved(failure: &Failure) -> Self {
        let mut answer = failure.to_json();
        answer["message"] = json!(failure.message());
        Self(answer)
    }

    /// `solved`, `refused`, `failed`.
    pub fn status(&self) -> &str {
        self.0["status"].as_str().unwrap_or_default()
    }
}

fn stage_ends(steps: &[StepRecord]) -> Vec<&StepRecord> {
    let ends = |pair: &[StepRecord]| pair[0].stage != pair[1].stage;
    steps.windows(2).filter(|pair| ends(pair)).map(|pair| &pair[0]).chain(steps.last()).collect()
}

/// The last full cycle of the last stage in cycles, with the state it starts from; null without one. Forces and shifts
/// are vectors: the span of a path is the diagonal of the box around it, its length where the path is straight.
fn last_cycle(plan: &Plan, steps: &[StepRecord]) -> Value {
    let mut end = 0;
    let mut found = None;
    for stage in &plan.case.stages {
        end += stage.increments_in_all();
        if matches!(stage.course, Course::Cycles(_)) && end <= steps.len() {
            found = Some(end - stage.increments..end);
        }
    }
    let Some(rows) = found.filter(|rows| !rows.is_empty()) else { return Value::Null };
    let path = &steps[rows.start.saturating_sub(1)..rows.end];
    let before = if rows.start > 0 { steps[rows.start - 1].dissipated_energy } else { 0.0 };
    let cycle = &steps[rows.clone()];
    let energy = steps[rows.end - 1].dissipated_energy - before;
    let force = half_span(path, |step| step.tangential_force);
    let shift = half_span(path, |step| step.shift);
    let full = 4.0 * force * shift;
    let touching = cycle.iter().filter(|step| step.contact_area > 0.0);
    let stick = touching.map(|step| step.stick_area / step.contact_area).reduce(f64::min);
    json!({
        "energy": energy,
        "force_amplitude": force,
        "shift_amplitude": shift,
        "energy_ratio": if full > 0.0 { energy / full } else { 0.0 },
        "least_stick_share": stick.unwrap_or(0.0),
        "regime": worst(cycle),
    })
}

fn half_span(path: &[StepRecord], of: impl Fn(&StepRecord) -> [f64; 2]) -> f64 {
    let span = |axis: usize| {
        let values = || path.iter().map(|step| of(step)[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    0.5 * span(0).hypot(span(1))
}

/// The regime with the most slip.
fn worst(cycle: &[StepRecord]) -> Regime {
    [Regime::GrossSlip, Regime::PartialSlip, Regime::FullStick, Regime::Frictionless]
        .into_iter()
        .find(|regime| cycle.iter().any(|step| step.regime == *regime))
        .unwrap_or(Regime::Apart)
}
