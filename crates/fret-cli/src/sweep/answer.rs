//! What a point of a sweep came to.

use fret_core::history::{History, StepRecord};
use serde_json::{Value, json};

use crate::failure::Failure;

/// What a point came to, as it is written down.
#[derive(Debug, Clone)]
pub struct Answer(pub Value);

impl Answer {
    /// The answer of a solved point, of which so many first increments were solved together with other points.
    pub fn solved(history: &History, common: usize) -> Self {
        Self(json!({
            "status": "solved",
            "message": "",
            "increments_in_common": common,
            "end": history.steps.last(),
            "stages": stage_ends(&history.steps),
            "cycle": history.cycles.last(),
        }))
    }

    /// Of a point that was refused or could not be solved.
    pub fn unsolved(failure: &Failure) -> Self {
        let mut answer = failure.to_json();
        answer["message"] = json!(failure.message());
        Self(answer)
    }

    /// Why there is none, a line a mistake; nothing of a solved point.
    pub fn why(&self) -> Vec<String> {
        let mistakes = self.0["mistakes"].as_array().into_iter().flatten();
        let told: Vec<String> =
            mistakes.filter_map(|mistake| mistake["message"].as_str()).map(str::to_owned).collect();
        if told.is_empty() {
            let message = self.0["message"].as_str().unwrap_or_default();
            return message.lines().take(1).map(str::to_owned).collect();
        }
        told
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
