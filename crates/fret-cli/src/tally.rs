//! What a run has come to, kept while it goes, so that an interrupted or failed run can tell as much as a solved one.

use fret_core::case::Course;
use fret_core::history::{StepRecord, Work};
use fret_core::plan::Plan;
use fret_core::study::Headline;
use serde::{Deserialize, Serialize};

/// A stage of the history, as increments of the whole.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StageSpan {
    /// Its name.
    pub name: String,
    /// Its last increment, from 0.
    pub last: usize,
    /// Increments of one of its cycles, where it has cycles.
    pub cycle: Option<usize>,
}

/// The stages of a plan, in order.
pub fn stage_spans(plan: &Plan) -> Vec<StageSpan> {
    let mut done = 0;
    plan.case
        .stages
        .iter()
        .map(|stage| {
            done += stage.increments_in_all();
            StageSpan {
                name: stage.name.clone(),
                last: done.saturating_sub(1),
                cycle: matches!(stage.course, Course::Cycles(_)).then_some(stage.increments),
            }
        })
        .collect()
}

/// Energy dissipated in one full cycle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CycleEnergy {
    /// Number of the stage, from 0.
    pub stage: usize,
    /// Number of the cycle in its stage, from 1.
    pub cycle: usize,
    /// Work of friction in this cycle [force x length].
    pub energy: f64,
}

/// What a run has come to.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Tally {
    /// The stages.
    pub stages: Vec<StageSpan>,
    /// Increments solved.
    pub solved: usize,
    /// The last record of each stage that is done, then of the stage at work.
    pub stage_ends: Vec<StepRecord>,
    /// Energy of each full cycle.
    pub cycle_energies: Vec<CycleEnergy>,
    /// Work of all increments.
    pub work: Work,
    /// Largest residual of all increments.
    pub largest_residual: f64,
    /// Headline numbers of the same increments as `stage_ends`, where they were asked for.
    pub headlines: Vec<Headline>,
    energy_at_cycle_start: f64,
}

impl Tally {
    /// Nothing yet.
    pub fn new(plan: &Plan) -> Self {
        Self {
            stages: stage_spans(plan),
            solved: 0,
            stage_ends: Vec::new(),
            cycle_energies: Vec::new(),
            work: Work::default(),
            largest_residual: 0.0,
            headlines: Vec::new(),
            energy_at_cycle_start: 0.0,
        }
    }

    /// Counts an increment in.
    pub fn add(&mut self, record: &StepRecord) {
        self.solved += 1;
        self.work += record.work;
        let residual = record.residual.largest();
        if residual > self.largest_residual || residual.is_nan() {
            self.largest_residual = residual;
        }
        match self.stage_ends.last_mut() {
            Some(last) if last.stage == record.stage => *last = record.clone(),
            _ => self.stage_ends.push(record.clone()),
        }
        self.count_cycle(record);
    }

    /// Remembers the headline numbers of an increment that was counted in.
    pub fn read(&mut self, headline: Headline) {
        match self.headlines.last_mut() {
            Some(last) if last.stage == headline.stage => *last = headline,
            _ => self.headlines.push(headline),
        }
    }

    /// The stage an increment belongs to.
    pub fn stage_of(&self, increment: usize) -> Option<&StageSpan> {
        self.stages.iter().find(|stage| increment <= stage.last)
    }

    fn count_cycle(&mut self, record: &StepRecord) {
        let first = match record.stage.checked_sub(1).and_then(|before| self.stages.get(before)) {
            Some(before) => before.last + 1,
            None => 0,
        };
        let Some(length) = self.stages.get(record.stage).map(|stage| stage.cycle) else { return };
        let done = record.increment + 1 - first;
        match length {
            Some(length) if done.is_multiple_of(length) => {
                self.cycle_energies.push(CycleEnergy {
                    stage: record.stage,
                    cycle: done / length,
                    energy: record.dissipated_energy - self.energy_at_cycle_start,
                });
                self.energy_at_cycle_start = record.dissipated_energy;
            }
            Some(_) => {}
            None => self.energy_at_cycle_start = record.dissipated_energy,
        }
    }
}
