//! What a run has come to, kept while it goes, so that an interrupted or failed run can tell as much as a solved one.

use fret_core::history::{CycleRecord, StepRecord, Work, WornByLayer, WornThrough};
use fret_core::plan::{Advance, Plan};
use fret_core::run::plausibility::Gauge;
use fret_core::study::StageQuantities;
use serde::{Deserialize, Serialize};

/// A stage of the history, as increments of the whole.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StageSpan {
    /// Its name.
    pub name: String,
    /// Its last increment, from 0, as far as is known.
    pub last: usize,
}

/// The stages of a plan, in order.
pub fn stage_spans(plan: &Plan) -> Vec<StageSpan> {
    let mut done = 0;
    plan.case
        .stages
        .iter()
        .map(|stage| {
            done += stage.increments_in_all();
            StageSpan { name: stage.name.clone(), last: done.saturating_sub(1) }
        })
        .collect()
}

/// What a run has come to.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Tally {
    /// The stages.
    pub stages: Vec<StageSpan>,
    /// Increments solved.
    pub solved: usize,
    /// How far that is in the history as planned.
    pub advance: Advance,
    /// The last record of each stage that is done, then of the stage at work.
    pub stage_ends: Vec<StepRecord>,
    /// The cycles that are over. Their table keeps them for a run that goes on, however many they are.
    #[serde(skip)]
    pub cycles: Vec<CycleRecord>,
    /// Where and when the surfaces were first worn through a coating, or to the limit, at which the run ended.
    pub worn_through: Option<WornThrough>,
    /// Volumes lost by the layers of both bodies.
    pub worn_by_layer: Option<WornByLayer>,
    /// Work of all increments.
    pub work: Work,
    /// Largest residual of all increments.
    pub largest_residual: f64,
    /// What warnings are made of.
    pub gauge: Gauge,
    /// Quantities of interest of the same increments as `stage_ends`, where they were asked for.
    pub stage_quantities: Vec<StageQuantities>,
}

impl Tally {
    /// Nothing yet.
    pub fn new(plan: &Plan) -> Self {
        Self {
            stages: stage_spans(plan),
            solved: 0,
            advance: Advance::new(&plan.case),
            stage_ends: Vec::new(),
            cycles: Vec::new(),
            worn_through: None,
            worn_by_layer: None,
            work: Work::default(),
            largest_residual: 0.0,
            gauge: Gauge::of(plan),
            stage_quantities: Vec::new(),
        }
    }

    /// Counts an increment in.
    pub fn add(&mut self, record: &StepRecord) {
        self.solved += 1;
        self.advance.solved(record);
        self.gauge.add(record);
        self.work += record.work;
        let residual = record.residual.largest();
        if residual > self.largest_residual || residual.is_nan() {
            self.largest_residual = residual;
        }
        match self.stage_ends.last_mut() {
            Some(last) if last.stage == record.stage => *last = record.clone(),
            _ => {
                self.begin_stage(record);
                self.stage_ends.push(record.clone());
            }
        }
    }

    /// Remembers the quantities of interest of an increment that was counted in.
    pub fn read(&mut self, quantities: StageQuantities) {
        match self.stage_quantities.last_mut() {
            Some(last) if last.stage == quantities.stage => *last = quantities,
            _ => self.stage_quantities.push(quantities),
        }
    }

    /// Counts a cycle in.
    pub fn add_cycle(&mut self, record: &CycleRecord) {
        self.cycles.push(record.clone());
        self.advance.cycled(record);
        self.gauge.add_cycle(record);
    }

    /// How far the run has come, in words.
    pub fn standing(&self) -> String {
        let (solved, passed, all) = (self.solved, self.advance.passed(), self.advance.planned());
        if passed == solved {
            format!("{solved} of {all} increments are solved")
        } else {
            format!("{solved} increments are solved, which stand for {passed} of {all},")
        }
    }

    /// A stage that ended early brings all that follow it forward.
    fn begin_stage(&mut self, record: &StepRecord) {
        let Some(before) = record.stage.checked_sub(1) else { return };
        let saved = (self.stages[before].last + 1).saturating_sub(record.increment);
        for stage in &mut self.stages[before..] {
            stage.last -= saved;
        }
    }
}
