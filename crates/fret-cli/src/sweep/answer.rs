//! What a point of a sweep came to, as it is written down and read back.

use std::ops::Range;

use fret_core::history::{CycleRecord, History, StepRecord};
use serde::{Deserialize, Serialize};

use crate::failure::{Failure, FailureRecord};
use crate::heat::HeatRecord;
use crate::stress::StressRecord;
use crate::way::Way;

/// What a case asks for after it is solved.
#[derive(Debug, Default)]
pub struct Besides {
    /// Stresses, fatigue, crack and coating.
    pub stress: Option<StressRecord>,
    /// Temperatures and resistances.
    pub heat: Option<HeatRecord>,
}

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
    /// What moves: displacement and tangential force along the load, or twist and moment, of the last cycle; of the whole history where
    /// there are no cycles.
    #[serde(default)]
    pub path: Path,
    /// Stresses, fatigue, crack and coating, where the case asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<StressRecord>,
    /// Temperatures and resistances, where the case asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<HeatRecord>,
    /// Why some of these are not there although the case asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unanswered: Option<String>,
    /// Whether that was the memory of the machine: another time, or another machine, may have it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    awaits_memory: bool,
}

/// The way of a loading: a loop.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Path {
    /// Whether it is a rotation over its moment, not a displacement over its force.
    pub twists: bool,
    /// Motion and load, increment by increment.
    pub points: Vec<[f64; 2]>,
}

/// More points of a path than this are thinned out.
const MOST_POINTS: usize = 240;

impl Path {
    /// The path of the last cycle of a history, or of the whole of it, thinned out where it is long.
    fn of(history: &History) -> Self {
        let mut path = Self::through(&history.steps[last_cycle(history)]);
        let every = path.points.len().div_ceil(MOST_POINTS).max(1);
        let all = path.points.len();
        let mut place = 0;
        path.points.retain(|_| {
            place += 1;
            (all - place).is_multiple_of(every)
        });
        path
    }

    /// The path through some increments, all of them.
    pub fn through(steps: &[StepRecord]) -> Self {
        let way = Way::through(steps);
        let (twists, [cosine, sine]) = (way.twists(), way.direction([0.0; 2]).unwrap_or([1.0, 0.0]));
        let along = |[x, y]: [f64; 2]| cosine * x + sine * y;
        let point = |step: &StepRecord| {
            if twists {
                [step.twist, step.twist_moment]
            } else {
                [along(step.shift), along(step.tangential_force)]
            }
        };
        Self { twists, points: steps.iter().map(point).collect() }
    }
}

/// Increments of the last cycle, with the one before it; all where there are no cycles.
pub fn last_cycle(history: &History) -> Range<usize> {
    let all = history.steps.len();
    match history.cycles.last() {
        Some(cycle) => {
            let first = cycle.first_increment.saturating_sub(1);
            first.min(all)..(cycle.last_increment + 1).min(all)
        }
        None => 0..all,
    }
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
            path: Path::of(history),
            stress: None,
            heat: None,
            unanswered: None,
            awaits_memory: false,
        };
        Self { told, numbers: Some(numbers) }
    }

    /// Of a point that was refused or could not be solved.
    pub fn unsolved(failure: &Failure) -> Self {
        Self { told: FailureRecord { message: failure.message(), ..failure.record() }, numbers: None }
    }

    /// Whether it tells all that one of its kind does: else a sweep that is continued solves the point again.
    pub fn is_whole(&self) -> bool {
        match &self.numbers {
            Some(numbers) => !numbers.awaits_memory,
            None => self.told.status != SOLVED,
        }
    }

    /// The same point with what its case asks for besides; where that cannot be had, what is solved stays, and the reason is told.
    pub fn asked(mut self, more: Result<Besides, Failure>) -> Self {
        if let Some(numbers) = &mut self.numbers {
            match more {
                Ok(Besides { stress, heat }) => (numbers.stress, numbers.heat) = (stress, heat),
                Err(failure) => {
                    numbers.unanswered = Some(failure.message());
                    self.told.message = failure.message();
                }
            }
        }
        self
    }

    /// The same point without what its case asks for besides, for which this machine has not the memory now.
    pub fn awaiting_memory(self, failure: Failure) -> Self {
        let mut answer = self.asked(Err(failure));
        answer.numbers.iter_mut().for_each(|numbers| numbers.awaits_memory = true);
        answer
    }

    /// Why there is none, a line a mistake; nothing of a solved point that has all that its case asks for.
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

    /// Why it ended early, or lacks what its case asks for besides; empty otherwise.
    pub fn message(&self) -> &str {
        &self.told.message
    }
}

/// How many points came to what.
pub struct Counts {
    /// Solved.
    pub solved: usize,
    /// Refused.
    pub refused: usize,
    /// Not solved for another reason.
    pub failed: usize,
}

impl Counts {
    /// Of the answers that there are.
    pub fn of(answers: &[Option<Answer>]) -> Self {
        let count = |status| answers.iter().flatten().filter(|answer| answer.status() == status).count();
        let [solved, refused] = [SOLVED, "refused"].map(count);
        Self { solved, refused, failed: answers.iter().flatten().count() - solved - refused }
    }

    /// Those without numbers.
    pub fn unsolved(&self) -> usize {
        self.refused + self.failed
    }
}

fn stage_ends(steps: &[StepRecord]) -> Vec<StepRecord> {
    let ends = |pair: &[StepRecord]| pair[0].stage != pair[1].stage;
    steps.windows(2).filter(|pair| ends(pair)).map(|pair| &pair[0]).chain(steps.last()).cloned().collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// What cannot be had besides takes nothing away: the numbers of the point stay, and its row says what is missing.
    #[test]
    fn a_point_without_its_stresses_keeps_its_numbers_and_says_why() {
        let solved = json!({"status": "solved", "message": "", "increments_in_common": 3, "stages": [], "end": null, "cycle": null});
        let solved: Answer = serde_json::from_value(solved).unwrap();
        let why = "not computed: the slip of increment 3 is not kept";
        let answer = solved.asked(Err(Failure::call(why, String::new())));
        assert_eq!((answer.status(), answer.message()), ("solved", why));
        assert_eq!(answer.why(), [why]);
        let read: Answer = serde_json::from_value(json!(answer)).unwrap();
        assert!(read.is_whole());
        assert_eq!(read.numbers.unwrap().increments_in_common, 3);
    }

    /// What is solved is solved: its numbers stand in the tables, what is missing is named, and a sweep that is continued asks again.
    #[test]
    fn a_point_without_memory_for_its_stresses_keeps_its_numbers() {
        let solved = r#"{"status": "solved", "message": "", "help": null, "mistakes": null, "increments_in_common": 0,
            "end": null, "stages": [], "cycle": null}"#;
        let answer: Answer = serde_json::from_str(solved).unwrap();
        assert!(answer.is_whole());
        let failure = Failure::call("stresses need 12 GB, and there are 8 GB", String::new());
        let waiting = answer.awaiting_memory(failure);
        let again: Answer = serde_json::from_str(&serde_json::to_string(&waiting).unwrap()).unwrap();
        for answer in [waiting, again] {
            assert!(answer.numbers.is_some() && !answer.is_whole());
            assert_eq!(answer.status(), "solved");
            assert!(answer.message().contains("stresses need 12 GB"));
        }
    }
}
