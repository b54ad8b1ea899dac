//! What a point of a sweep came to, as it is written down and read back.

use fret_core::history::{CycleRecord, History, StepRecord};
use serde::{Deserialize, Serialize};

use crate::failure::{Failure, FailureRecord};

/// What a point came to.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Answer {
    #[serde(flatten)]
    told: FailureRecord,
    /// Its numbers, where it is solved.
    #[serde(flatten)]
    pub numbers: Option<Numbers>,
}

/// The numbers of a solved point.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Numbers {
    /// First increments that were solved together with other points.
    increments_in_common: usize,
    /// The last increment.
    pub end: Option<StepRecord>,
    /// The last increment of each stage.
    stages: Vec<StepRecord>,
    /// The last cycle.
    pub cycle: Option<CycleRecord>,
}

const SOLVED: &str = "solved";

impl Answer {
    /// The answer of a solved point, of which so many first increments were solved together with other points.
    pub fn solved(history: &History, common: usize) -> Self {
        let told =
            FailureRecord { status: SOLVED.to_owned(), message: String::new(), help: None, mistakes: None };
        let numbers = Numbers {
            increments_in_common: common,
            end: history.steps.last().cloned(),
            stages: stage_ends(&history.steps),
            cycle: history.cycles.last().cloned(),
        };
        Self { told, numbers: Some(numbers) }
    }

    /// Of a point that was refused or could not be solved.
    pub fn unsolved(failure: &Failure) -> Self {
        Self { told: FailureRecord { message: failure.message(), ..failure.record() }, numbers: None }
    }

    /// Whether it tells all that one of its kind does.
    pub fn is_whole(&self) -> bool {
        self.numbers.is_some() || self.told.status != SOLVED
    }

    /// Why there is none, a line a mistake; nothing of a solved point.
    pub fn why(&self) -> Vec<String> {
        match self.told.mistakes.as_deref() {
            Some(mistakes) if !mistakes.is_empty() => {
                mistakes.iter().map(|mistake| mistake.message.clone()).collect()
            }
            _ => self.message().lines().take(1).map(str::to_owned).collect(),
        }
    }

    /// `solved`, `refused`, `failed`.
    pub fn status(&self) -> &str {
        &self.told.status
    }

    /// Why it ended early; empty of a solved point.
    pub fn message(&self) -> &str {
        &self.told.message
    }
}

fn stage_ends(steps: &[StepRecord]) -> Vec<StepRecord> {
    let ends = |pair: &[StepRecord]| pair[0].stage != pair[1].stage;
    steps.windows(2).filter(|pair| ends(pair)).map(|pair| &pair[0]).chain(steps.last()).cloned().collect()
}
