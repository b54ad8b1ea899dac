//! The journey of a run: stages, increments, records. The only room that knows all of it.

use std::ops::ControlFlow;

use std::time::Instant;

use ndarray::Array2;

use crate::case::{Case, Stage};
use crate::compliance::SurfaceResponse;
use crate::cycle::CycleRecord;
use crate::fretting_loop::{CycleEnd, FrettingLoop};
use crate::history::{History, KeptFields, Residual, StepRecord};
use crate::kernel::{Components, influence_coefficients, periodic_symbols};
use crate::model::field::largest;
use crate::model::{ContactState, Control, LoadStep};
use crate::plan::{Coupling, Plan};
use crate::solver::{ContactSolver, Increment, Resultants, SolveError, SolverSettings};
use crate::stepping::StageSteps;
use crate::wear::{Wearing, WornThrough, worn};

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

    /// A cycle is over; its last increment was solved just before.
    fn cycled(&mut self, record: &CycleRecord) {
        let _ = record;
    }
}

/// Hears nothing and stops nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {}

/// Why a run ended without its answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The equations could not be satisfied to the tolerance.
    #[error(
        "increment {increment} ({stage}) not solved: residual {reached:.1e} after {iterations} iterations, asked for {tolerance:.1e}; {advice}"
    )]
    NotConverged {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Residual reached.
        reached: f64,
        /// Residual asked for.
        tolerance: f64,
        /// Iterations made.
        iterations: usize,
        /// What to try.
        advice: String,
    },
    /// The contact reaches the edge of the grid.
    #[error(
        "increment {increment} ({stage}): the contact reaches the edge of the grid; enlarge grid.size, or write size = \"auto\""
    )]
    ContactAtEdge {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
    },
    /// A tangential load above what friction carries.
    #[error(
        "increment {increment} ({stage}): tangential force {asked:.6e} is above mu W = {bound:.6e}: no equilibrium; prescribe the shift to slide"
    )]
    AboveSliding {
        /// Number of the increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Force asked for.
        asked: f64,
        /// mu W.
        bound: f64,
    },
    /// A cycle wears the surfaces more than the grid can follow.
    #[error(
        "increment {increment} ({stage}): this cycle alone wears off {share:.2} of a cell's pressure; choose a smaller wear.coefficient (with more cycles), or coarser cells"
    )]
    WearTooFast {
        /// Number of the cycle's last increment, from 0.
        increment: usize,
        /// Name of its stage.
        stage: String,
        /// Share of a cell's pressure that the cell's own compliance gives up.
        share: f64,
    },
    /// The observer stopped the run.
    #[error("interrupted at increment {increment}")]
    Interrupted {
        /// Number of the increment that was not finished, from 0.
        increment: usize,
    },
}

impl RunError {
    /// Number of the increment that has no answer, from 0.
    pub fn increment(&self) -> usize {
        match self {
            Self::NotConverged { increment, .. }
            | Self::ContactAtEdge { increment, .. }
            | Self::AboveSliding { increment, .. }
            | Self::WearTooFast { increment, .. }
            | Self::Interrupted { increment } => *increment,
        }
    }
}

/// A planned case with its operators, ready to run.
#[derive(Debug)]
pub struct Simulation<'a> {
    plan: &'a Plan,
}

impl<'a> Simulation<'a> {
    /// Simulation of a plan.
    pub fn new(plan: &'a Plan) -> Self {
        Self { plan }
    }

    /// Runs the whole history. Use inside a thread pool to bound the threads; the bits do not depend on their number.
    ///
    /// # Errors
    /// When an increment cannot be solved, or the observer stops the run.
    pub fn run(&self, observer: &mut dyn Observer) -> Result<History, RunError> {
        let plan = self.plan;
        let case = &plan.case;
        let wanted = match plan.coupling {
            Coupling::Frictionless => Components::NORMAL,
            Coupling::Uncoupled => Components { normal: true, tangential: true, coupling: false },
            Coupling::Coupled => Components::ALL,
        };
        let response = if case.periodic {
            SurfaceResponse::Periodic(periodic_symbols(
                &case.bodies,
                case.cells,
                plan.grid.spacing(),
                wanted,
                0,
            ))
        } else {
            SurfaceResponse::FreeSpace(influence_coefficients(
                &case.bodies,
                case.cells,
                plan.grid.spacing(),
                wanted,
            ))
        };
        let wearing = case.wear.map(|rule| Wearing::new(rule, case.cells, response.own_normal(case.cells)));
        let mut state = ContactState::untouched(case.cells);
        state.worn_depth = wearing.as_ref().map(|_| Array2::zeros(case.cells));
        let journey = Journey {
            plan,
            solver: ContactSolver::new(
                plan.grid,
                case.profile.gap(&plan.grid),
                &case.friction,
                plan.coupling,
                response,
                SolverSettings::new(case.tolerance),
                true,
            ),
            wearing,
            history: History {
                grid: plan.grid,
                stages: case.stages.iter().map(|stage| stage.name.clone()).collect(),
                steps: Vec::with_capacity(plan.increments),
                cycles: Vec::new(),
                worn_through: None,
                fields: Vec::new(),
                state,
            },
            held: LoadStep {
                normal: Control::Force(0.0),
                tangential: [Control::Force(0.0); 2],
                twist: Control::Motion(0.0),
            },
            resultants: Resultants { normal: 0.0, tangential: [0.0; 2], moment: 0.0 },
            observer,
        };
        journey.through_all_stages()
    }
}

/// A run on its way.
struct Journey<'a> {
    plan: &'a Plan,
    solver: ContactSolver<'a>,
    wearing: Option<Wearing>,
    history: History,
    held: LoadStep,
    resultants: Resultants,
    observer: &'a mut dyn Observer,
}

impl<'a> Journey<'a> {
    fn case(&self) -> &'a Case {
        &self.plan.case
    }

    fn through_all_stages(mut self) -> Result<History, RunError> {
        for number in 0..self.case().stages.len() {
            self.through_stage(number)?;
            if self.history.worn_through.is_some() {
                break;
            }
        }
        Ok(self.history)
    }

    fn through_stage(&mut self, number: usize) -> Result<(), RunError> {
        let stage = &self.case().stages[number];
        let steps = StageSteps::new(stage, &self.held, &self.history.state, &self.resultants);
        let all = stage.increments_in_all();
        let mut cycles = 0;
        let mut fretting = stage.cycles().map(|_| self.new_loop(number, 1));
        for k in 1..=all {
            let load = steps.at(k);
            let may_end = k == all || stage.ends_cycle(k);
            let may_keep = may_end || self.case().keeps(number, k);
            let (record, mut kept) = self.increment(number, &load, may_keep)?;
            if let Some(fretting) = &mut fretting {
                fretting.add(&record);
            }
            let cycle_ends = stage.ends_cycle(k);
            let mut ended = None;
            if cycle_ends || (stage.cycles().is_none() && k == all) {
                let left = stage.cycles().map_or(1, |course| course.most - cycles);
                let stands_for = self.wear(&record, number, cycles, left)?;
                cycles += stands_for;
                if let (Some(fretting), Some(course)) = (&fretting, stage.cycles()) {
                    let end = CycleEnd {
                        stands_for,
                        tolerance: course.until_steady,
                        worn: worn(&self.history.state, &self.plan.grid),
                    };
                    ended = Some(fretting.close(&self.history.state, &self.case().friction, end));
                }
            }
            let steady = ended.as_ref().is_some_and(|cycle| cycle.steady);
            let worn_through = self.history.worn_through.is_some();
            let enough = stage.cycles().is_some_and(|course| cycles >= course.most);
            let last = k == all || (cycle_ends && (steady || worn_through || enough));
            if !last && !self.case().keeps(number, k) {
                kept = None;
            }
            if let (Some(kept), Some(depth)) = (&mut kept, &self.history.state.worn_depth)
                && self.case().output.fields.iter().any(|name| name == "worn_depth")
            {
                kept.worn_depth = Some(depth.clone());
            }
            let increment = record.increment;
            let go_on = self.observer.solved(&record, &self.history.state, kept.as_ref());
            self.history.steps.push(record);
            self.history.fields.extend(kept);
            if let Some(cycle) = ended {
                self.observer.cycled(&cycle);
                fretting = Some(self.new_loop(number, cycle.cycle + 1));
                self.history.cycles.push(cycle);
            }
            if go_on.is_break() {
                return Err(RunError::Interrupted { increment: increment + 1 });
            }
            if last {
                break;
            }
        }
        Ok(())
    }

    fn new_loop(&self, stage: usize, cycle: usize) -> FrettingLoop {
        let first = self.history.steps.len();
        let Resultants { tangential, moment, .. } = self.resultants;
        FrettingLoop::new((stage, cycle), first, &self.history.state, tangential, moment)
    }

    /// Solves the next increment; its fields, should they be kept.
    fn increment(
        &mut self,
        number: usize,
        load: &LoadStep,
        may_keep: bool,
    ) -> Result<(StepRecord, Option<KeptFields>), RunError> {
        let case = self.case();
        let increment = self.history.steps.len();
        let started = Instant::now();
        let observer = &mut *self.observer;
        let mut watch = |iteration: usize, residual: f64| {
            let tolerance = case.tolerance;
            observer.iterated(&Iteration { increment, stage: number, iteration, residual, tolerance })
        };
        let solved = self
            .solver
            .step(&self.history.state, load, &mut watch)
            .map_err(|error| run_error(&error, increment, &case.stages[number], case.tolerance))?;
        let record = record(&solved, increment, number, started.elapsed().as_secs_f64());
        let kept = may_keep.then(|| kept(&solved, increment, &case.output.fields));
        if let Some(wearing) = &mut self.wearing {
            wearing.add(&self.history.state, &solved.state);
        }
        self.resultants = solved.outcome.resultants;
        self.held = *load;
        self.history.state = solved.state;
        Ok((record, kept))
    }

    /// Opens the gap by what has worn since the last time; the number of cycles that stands for, out of `left`.
    fn wear(
        &mut self,
        record: &StepRecord,
        stage: usize,
        done: usize,
        left: usize,
    ) -> Result<usize, RunError> {
        let (case, increment) = (self.case(), record.increment);
        let Some(wearing) = &mut self.wearing else { return Ok(1) };
        let block = wearing.block(&self.history.state, &case.friction, left).map_err(|too_fast| {
            let stage = case.stages[stage].name.clone();
            RunError::WearTooFast { increment, stage, share: too_fast.share }
        })?;
        if block.depth.iter().any(|depth| *depth > 0.0) {
            self.solver.open_gap(&block.depth);
            if let Some(worn) = &mut self.history.state.worn_depth {
                *worn += &block.depth;
            }
        }
        self.history.worn_through = block.through.map(|cell| WornThrough {
            increment,
            stage,
            cycles: done + block.cycles,
            cell,
            place: [self.plan.grid.centre(0, cell[0]), self.plan.grid.centre(1, cell[1])],
        });
        Ok(block.cycles)
    }
}

fn record(solved: &Increment, increment: usize, stage: usize, wall_s: f64) -> StepRecord {
    let state = &solved.state;
    let outcome = &solved.outcome;
    let max_shear = state.shear[0].iter().zip(&state.shear[1]).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    StepRecord {
        increment,
        stage,
        normal_force: outcome.resultants.normal,
        approach: state.approach,
        tangential_force: outcome.resultants.tangential,
        shift: state.shift,
        twist_moment: outcome.resultants.moment,
        twist: state.twist,
        max_pressure: state.pressure.as_slice().map_or(0.0, largest),
        max_shear,
        contact_area: solved.contact_area,
        stick_area: solved.stick_area,
        contact_cells: outcome.contact_cells,
        stick_cells: outcome.stick_cells,
        dissipated_energy: state.dissipated_energy,
        regime: outcome.regime,
        residual: Residual { ..outcome.residual },
        work: solved.work,
        wall_s,
    }
}

fn kept(solved: &Increment, increment: usize, names: &[String]) -> KeptFields {
    let asked = |name: &str| names.iter().any(|asked| asked == name);
    let state = &solved.state;
    KeptFields {
        increment,
        pressure: asked("pressure").then(|| state.pressure.clone()),
        shear: asked("shear").then(|| state.shear.clone()),
        slip: asked("slip").then(|| state.slip.clone()),
        gap: asked("gap").then(|| solved.gap.clone()),
        zone: asked("zone").then(|| state.zone.clone()),
        worn_depth: None,
    }
}

fn run_error(error: &SolveError, increment: usize, stage: &Stage, tolerance: f64) -> RunError {
    let stage = stage.name.clone();
    match *error {
        SolveError::NotConverged { reached, iterations } => RunError::NotConverged {
            increment,
            stage,
            reached,
            tolerance,
            iterations,
            advice: "try more increments in this stage, or a larger solver.tolerance".to_owned(),
        },
        SolveError::AboveSliding { asked, bound } => {
            RunError::AboveSliding { increment, stage, asked, bound }
        }
        SolveError::ContactAtEdge => RunError::ContactAtEdge { increment, stage },
        SolveError::OperatorsMissing => RunError::NotConverged {
            increment,
            stage,
            reached: f64::INFINITY,
            tolerance,
            iterations: 0,
            advice: "the elastic answer could not be computed: check moduli and lengths for extreme values"
                .to_owned(),
        },
        SolveError::Stopped => RunError::Interrupted { increment },
    }
}
