//! The journey of a run: stages, increments, cycles, records. The only room that knows all of it.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use ndarray::Array2;

use super::checkpoint::{Checkpoint, Place, Waypoint, solved_state};
use super::fretting_loop::{CycleEnd, FrettingLoop};
use super::pair_compliance::PairCompliance;
use super::plausibility::Gauge;
use super::recording::{copied, kept, record};
use super::refinement::{DivisionError, Refinement, Span, in_halves};
use super::run_error::{RunError, run_error};
use super::stepping::StageSteps;
use super::wear::{Collected, Wearing, worn};
use crate::case::{Case, Stage};
use crate::history::{CycleRecord, History, KeptFields, StepRecord, WornThrough};
use crate::machine::memory::{Claim, claim};
use crate::model::{BulkCompliance, ContactState, CoulombFriction, LoadStep, SolvedState};
use crate::plan::{Coupling, Plan, Simplification};
use crate::solver::{ContactSolver, Resultants, SolverSettings};

/// Where an increment's iteration stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Number of the increment in the whole history, from 0.
    pub increment: usize,
    /// Number of its stage, from 0.
    pub stage: usize,
    /// Iteration within the increment.
    pub iteration: usize,
    /// Residual reached so far.
    pub residual: f64,
    /// Residual asked for.
    pub tolerance: f64,
}

/// Hears about a run and may stop it.
pub trait Observer {
    /// An iteration was done. `Break` stops the run.
    fn iterated(&mut self, iteration: &Iteration) -> ControlFlow<()> {
        let _ = iteration;
        ControlFlow::Continue(())
    }

    /// An increment is solved and heard of, and its cycle when that is over: where the run stands now, for those who store it.
    /// `Break` stops the run after it.
    fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
        let _ = waypoint;
        ControlFlow::Continue(())
    }

    /// An increment is solved; `kept` holds its fields when they are kept. `Break` stops the run after it.
    fn solved(
        &mut self,
        record: &StepRecord,
        state: &ContactState,
        kept: Option<&KeptFields>,
    ) -> ControlFlow<()> {
        let _ = (record, state, kept);
        ControlFlow::Continue(())
    }

    /// Whether the history is to hold the kept fields. An observer that has done with them once it has heard of them says no.
    fn leaves_fields(&self) -> bool {
        true
    }

    /// A cycle is over; its last increment was solved just before.
    fn cycled(&mut self, record: &CycleRecord) {
        let _ = record;
    }
}

/// Hears nothing and stops nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {}

/// A planned case with its operators, ready to run.
#[derive(Debug)]
pub struct Simulation<'a> {
    plan: &'a Plan,
    /// Whether its memory has been claimed already.
    is_claimed: bool,
    /// How the pair answers, where that is known already.
    compliance: Option<Arc<PairCompliance>>,
}

impl<'a> Simulation<'a> {
    /// Simulation of a plan.
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan, is_claimed: false, compliance: None }
    }

    /// The same in memory that has been claimed for it, by somebody who holds the claim meanwhile; else a run claims its own.
    #[must_use]
    pub fn in_claimed_memory(self) -> Self {
        Self { is_claimed: true, ..self }
    }

    /// The same with the compliance of its plan, which was made for another one.
    pub(super) fn with_compliance(self, compliance: Option<Arc<PairCompliance>>) -> Self {
        Self { compliance, ..self }
    }

    /// What it is a simulation of.
    pub(crate) fn plan(&self) -> &'a Plan {
        self.plan
    }

    /// Runs the whole history. Use inside a thread pool to bound the threads; the bits do not depend on their number.
    ///
    /// # Errors
    /// When an increment cannot be solved, a cycle wears more than the grid can follow, or the observer stops the run.
    pub fn run(&self, observer: &mut dyn Observer) -> Result<History, RunError> {
        let _memory = self.memory(observer.leaves_fields(), 0)?;
        let (history, outcome) = self.journey(Checkpoint::start(self.plan), observer);
        outcome.map(|()| history)
    }

    /// Runs what is left of the history after a checkpoint of this plan, with the bits of an unbroken run. The history that is
    /// returned holds the increments solved here and the cycles that end here.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn resume(&self, from: Checkpoint, observer: &mut dyn Observer) -> Result<History, RunError> {
        let (history, outcome) = self.follow(from, observer);
        outcome.map(|()| history)
    }

    /// As [`Simulation::resume`], with what was solved also where the history has no end: every increment before the one that
    /// failed or was interrupted, with the fields kept so far.
    pub fn follow(&self, from: Checkpoint, observer: &mut dyn Observer) -> (History, Result<(), RunError>) {
        match self.memory(observer.leaves_fields(), from.place.solved) {
            Ok(_memory) => self.journey(from, observer),
            Err(error) => (self.history_from(&from.place, from.state, from.wear.as_ref()), Err(error)),
        }
    }

    /// Claims the memory of a run that starts with an increment, where that has not been done before.
    fn memory(&self, holds_fields: bool, increment: usize) -> Result<Option<Claim>, RunError> {
        // Of a history that may end early nobody knows how much it keeps.
        let holds = holds_fields && !self.plan.case.is_open_ended();
        let kept = if holds { self.plan.kept_bytes } else { 0 };
        let needed = self.plan.memory_bytes.saturating_add(kept);
        let own = (!self.is_claimed).then(|| claim(needed)).transpose();
        own.map_err(|error| RunError::OutOfMemory { increment, error })
    }

    /// A history that has only its start.
    fn history_from(&self, place: &Place, state: ContactState, wear: Option<&Collected>) -> History {
        let plan = self.plan;
        let case = &plan.case;
        History {
            grid: plan.grid,
            bodies: case.bodies.clone(),
            periodic: case.periodic,
            stages: case.stages.iter().map(|stage| stage.name.clone()).collect(),
            steps: Vec::new(),
            cycles: Vec::new(),
            worn_through: None,
            fields: Vec::new(),
            end: solved_state(place, &state, wear).beside(|_| true),
            state,
            plan: plan.to_json(),
            warnings: Vec::new(),
        }
    }

    fn journey(&self, from: Checkpoint, observer: &mut dyn Observer) -> (History, Result<(), RunError>) {
        let plan = self.plan;
        let case = &plan.case;
        let Checkpoint { place, state, memory, cycle, wear } = from;
        let history = self.history_from(&place, state, wear.as_ref());
        let compliance = match &self.compliance {
            Some(compliance) => PairCompliance::clone(compliance),
            None => PairCompliance::of(plan),
        };
        let own = compliance.response.own_normal(case.cells);
        let unworn = case.profile.gap(&plan.grid);
        let mut solver = self.solver(compliance, unworn.clone());
        if let Some(depth) = &history.state.worn_depth {
            solver.set_gap(&unworn + depth);
        }
        let wearing = case
            .wear
            .zip(wear)
            .map(|(rule, collected)| Wearing::new(rule, own, unworn, case.friction.clone(), collected));
        solver.set_tilt(history.state.tilt);
        // Last: a new gap makes a solver forget.
        solver.restore_memory(memory);
        let journey =
            Journey { plan, solver, wearing, history, gauge: Gauge::default(), place, cycle, observer };
        journey.through_all_stages()
    }

    /// The solver with its operators.
    fn solver(&self, compliance: PairCompliance, undeformed: Array2<f64>) -> ContactSolver<'a> {
        let plan = self.plan;
        let case = &plan.case;
        let solver = ContactSolver::new(
            plan.grid,
            undeformed,
            &case.friction,
            plan.coupling,
            compliance.response,
            SolverSettings {
                scheme: case.scheme,
                integration: case.integration,
                single_precision: plan.single_precision,
                reuse_pressure: plan.leave_out.takes(Simplification::Pressure),
                skip_unloaded_shear: plan.leave_out.takes(Simplification::Tangential),
                ..SolverSettings::new(case.tolerance)
            },
            plan.leave_out.takes(Simplification::Region),
        )
        .with_shear_axis(plan.along)
        .with_bulk(BulkCompliance::of(&case.bodies, case.is_line()))
        .with_rig(case.springs())
        .with_symmetry(plan.symmetry);
        match compliance.table {
            Some(table) => solver.with_response_table(table),
            None => solver,
        }
    }
}

/// A run on its way.
struct Journey<'a> {
    plan: &'a Plan,
    solver: ContactSolver<'a>,
    wearing: Option<Wearing>,
    history: History,
    gauge: Gauge,
    place: Place,
    /// The cycle at work.
    cycle: Option<FrettingLoop>,
    observer: &'a mut dyn Observer,
}

impl<'a> Journey<'a> {
    fn case(&self) -> &'a Case {
        &self.plan.case
    }

    /// The law of friction in force in the stage at work.
    fn friction(&self) -> &'a CoulombFriction {
        let case = self.case();
        let mut latest_first = case.stages.iter().take(self.place.stage + 1).rev();
        latest_first.find_map(|stage| stage.friction.as_ref()).unwrap_or(&case.friction)
    }

    /// How the next increment is divided; it is one step where its end does not depend on the way there.
    fn refinement(&self) -> Option<Refinement> {
        let stage = &self.case().stages[self.place.stage];
        let tolerance = stage.history_tolerance?;
        let friction = self.friction().largest();
        let shear = self.history.state.shear.iter().flatten().any(|shear| *shear != 0.0);
        let depends = self.plan.coupling == Coupling::Coupled || stage.is_tangential() || shear;
        (friction > 0.0 && depends).then_some(Refinement {
            tolerance,
            residual: self.case().tolerance,
            integration: self.case().integration,
            friction,
        })
    }

    fn through_all_stages(mut self) -> (History, Result<(), RunError>) {
        let outcome = loop {
            let Some(stage) = self.case().stages.get(self.place.stage) else { break Ok(()) };
            if let Err(error) = self.through_stage(stage) {
                break Err(error);
            }
        };
        self.history.worn_through = self.place.worn_through;
        self.history.warnings = self.gauge.warnings(self.plan);
        self.history.end = self.solved_state().beside(|_| true);
        (self.history, outcome)
    }

    /// Where the run stands, for another history to start from.
    fn solved_state(&self) -> SolvedState {
        let collected = self.wearing.as_ref().map(Wearing::collected);
        solved_state(&self.place, &self.history.state, collected)
    }

    /// Solves what is left of the stage at work.
    fn through_stage(&mut self, stage: &'a Stage) -> Result<(), RunError> {
        self.solver.set_friction(self.friction());
        let friction = self.friction();
        if let Some(wearing) = &mut self.wearing {
            wearing.set_friction(friction);
        }
        let place = &self.place;
        let (number, begins) = (place.stage, place.solved_of_stage == 0);
        let steps = if begins {
            let reached = (&place.resultants, self.case().springs());
            StageSteps::new(stage, &place.held, &self.history.state, reached)
        } else {
            StageSteps::from_start(stage, place.stage_start)
        };
        if begins {
            self.place.stage_start = steps.start();
            self.place.cycles = 0;
            self.cycle = stage.cycles().map(|_| self.loop_from_here(1));
        }
        for k in self.place.solved_of_stage + 1..=stage.increments_in_all() {
            let from = if k == 1 { steps.start() } else { steps.at(k - 1) };
            self.increment(stage, k, [&from, &steps.at(k)])?;
            if self.place.stage > number {
                break;
            }
        }
        Ok(())
    }

    /// Solves increment `k` of the stage at work and tells of it. When that ends a cycle or the stage, so does the place.
    fn increment(&mut self, stage: &Stage, k: usize, [from, to]: [&LoadStep; 2]) -> Result<(), RunError> {
        let (number, all) = (self.place.stage, stage.increments_in_all());
        let may_keep = k == all || stage.ends_cycle(k) || self.case().keeps(number, k);
        let (mut record, mut kept) = self.solved([from, to], may_keep)?;
        if let Some(cycle) = &mut self.cycle {
            cycle.add(&record);
        }
        let ended =
            if stage.ends_cycle(k) || k == all { self.cycle_over(stage, record.increment)? } else { None };
        record.dissipated_energy = self.history.state.dissipated_energy;
        record.bulk_work = self.history.state.bulk_work;
        [record.worn_volume, record.max_worn_depth] = worn(&self.history.state, &self.plan.grid);
        let steady = ended.as_ref().is_some_and(|cycle| cycle.steady);
        let enough = stage.cycles().is_some_and(|course| self.place.cycles >= course.most);
        let last = k == all || steady || enough || self.place.worn_through.is_some();
        if !last && !self.case().keeps(number, k) {
            kept = None;
        }
        if let (Some(kept), Some(depth)) = (&mut kept, &self.history.state.worn_depth)
            && self.case().output.fields.iter().any(|name| name == "worn_depth")
        {
            let increment = record.increment;
            let out_of_memory = |error| RunError::OutOfMemory { increment, error };
            kept.worn_depth = Some(copied(depth).map_err(out_of_memory)?);
        }
        self.place.solved += 1;
        self.place.solved_of_stage = k;
        if let Some(kept) = &mut kept {
            kept.rest = self.rest_beside(kept, last).map(Box::new);
        }
        self.gauge.add(&record);
        let heard = self.observer.solved(&record, &self.history.state, kept.as_ref());
        self.history.steps.push(record);
        if self.observer.leaves_fields() {
            self.history.fields.extend(kept);
        }
        if let Some(cycle) = ended {
            self.observer.cycled(&cycle);
            self.cycle = Some(self.loop_from_here(cycle.cycle + 1));
            self.history.cycles.push(cycle);
        }
        if last {
            self.place.stage =
                if self.place.worn_through.is_some() { self.case().stages.len() } else { number + 1 };
            self.place.solved_of_stage = 0;
            self.cycle = None;
        }
        let stored = self.observer.reached(&Waypoint {
            place: &self.place,
            state: &self.history.state,
            memory: self.solver.memory(),
            cycle: self.cycle.as_ref(),
            wear: self.wearing.as_ref().map(Wearing::collected),
        });
        if heard.is_break() || stored.is_break() {
            return Err(RunError::Interrupted { increment: self.place.solved });
        }
        Ok(())
    }

    /// What another history needs to start here besides the kept fields; of what `ends` a stage in any case, of other increments
    /// where the fields that are not kept are zero.
    fn rest_beside(&self, kept: &KeptFields, ends: bool) -> Option<SolvedState> {
        let mut rest = self.solved_state().beside(|name| kept.field(name).is_some());
        (rest.thinned() || ends).then_some(rest)
    }

    /// A cycle that starts now, in the stage at work.
    fn loop_from_here(&self, cycle: usize) -> FrettingLoop {
        let Place { solved, stage, resultants, .. } = self.place;
        let Resultants { tangential, moment, .. } = resultants;
        FrettingLoop::new((stage, cycle), solved, &self.history.state, tangential, moment)
    }

    /// Solves the next increment, in parts where it is left to the program or not solved as a whole; its fields, should they be kept.
    fn solved(
        &mut self,
        [from, to]: [&LoadStep; 2],
        may_keep: bool,
    ) -> Result<(StepRecord, Option<KeptFields>), RunError> {
        let case = self.case();
        let Place { solved: increment, stage, .. } = self.place;
        let refinement = self.refinement();
        let started = Instant::now();
        let observer = &mut *self.observer;
        let failed = |error| run_error(&error, increment, case, stage);
        let mut watch = |iteration: usize, residual: f64| {
            let tolerance = case.tolerance;
            observer.iterated(&Iteration { increment, stage, iteration, residual, tolerance })
        };
        let state = &self.history.state;
        let (solved, parts) = match refinement {
            None => {
                let span = Span { state, from, to };
                in_halves(&mut self.solver, &mut self.wearing, span, &mut watch).map_err(failed)?
            }
            Some(refinement) => {
                let span = Span { state, from, to };
                let wearing = self.wearing.as_ref();
                let divided = refinement
                    .solve(&mut self.solver, wearing, span, self.place.parts, &mut watch)
                    .map_err(|error| match error {
                        DivisionError::Unsolved(error) => failed(error),
                        DivisionError::Unresolved { reached, parts } => RunError::HistoryUnresolved {
                            increment,
                            stage: case.stages[stage].name.clone(),
                            reached,
                            tolerance: refinement.tolerance,
                            parts,
                        },
                    })?;
                self.wearing = divided.wearing;
                self.place.parts = divided.next;
                (divided.end, divided.parts)
            }
        };
        let wall_s = started.elapsed().as_secs_f64();
        let record = record(&solved, case.springs(), (increment, stage, parts), wall_s);
        let kept = may_keep.then(|| kept(&solved, increment, &case.output.fields)).transpose();
        let kept = kept.map_err(|error| RunError::OutOfMemory { increment, error })?;
        self.place.resultants = solved.outcome.resultants;
        self.place.held = *to;
        self.history.state = solved.state;
        Ok((record, kept))
    }

    /// Wears the surfaces by what the cycle (or the stage without cycles) that ends with `increment` took off, and reads the
    /// cycle's loop.
    fn cycle_over(&mut self, stage: &Stage, increment: usize) -> Result<Option<CycleRecord>, RunError> {
        let left = stage.cycles().map_or(1, |course| course.most - self.place.cycles);
        let stands_for = self.wear(stage, increment, left)?;
        self.place.cycles += stands_for;
        let (Some(cycle), Some(course)) = (&self.cycle, stage.cycles()) else { return Ok(None) };
        let end = CycleEnd {
            rig: self.case().rig,
            stands_for,
            last_cycle: self.place.cycles,
            tolerance: course.until_steady,
            worn: worn(&self.history.state, &self.plan.grid),
        };
        let record = cycle.close(&self.history.state, self.friction(), end);
        self.history.state.bulk_work = cycle.total_bulk_work(&self.history.state, stands_for);
        self.history.state.dissipated_energy = record.total_dissipated_energy;
        Ok(Some(record))
    }

    /// Opens the gap by what has worn since the last time; the number of cycles that stands for, out of `left`.
    fn wear(&mut self, stage: &Stage, increment: usize, left: usize) -> Result<usize, RunError> {
        let Some(wearing) = &mut self.wearing else { return Ok(1) };
        let block = wearing.block(&self.history.state, left).map_err(|too_fast| RunError::WearTooFast {
            increment,
            stage: stage.name.clone(),
            share: too_fast.share,
        })?;
        if let Some(depth) = &mut self.history.state.worn_depth
            && block.depth.iter().any(|depth| *depth > 0.0)
        {
            *depth += &block.depth;
            self.solver.set_gap(wearing.gap(depth));
        }
        self.place.worn_through = block.through.map(|cell| WornThrough {
            increment,
            stage: self.place.stage,
            cycles: self.place.cycles + block.cycles,
            cell,
            place: [self.plan.grid.centre(0, cell[0]), self.plan.grid.centre(1, cell[1])],
        });
        Ok(block.cycles)
    }
}
