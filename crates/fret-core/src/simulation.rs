//! The journey of a run: stages, increments, records. The only room that knows all of it.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use std::time::Instant;

use crate::case::Stage;
use crate::checkpoint::{Checkpoint, Waypoint};
use crate::compliance::SurfaceResponse;
use crate::history::{History, KeptFields, Residual, StepRecord};
use crate::kernel::{
    Components, PairResponse, ResponseTable, coefficients_of, influence_coefficients, periodic_symbols,
    symbols_of,
};
use crate::model::ContactState;
use crate::model::field::largest;
use crate::plan::{Coupling, Plan, Shortcut};
use crate::solver::{ContactSolver, Increment, SolveError, SolverSettings};
use crate::stepping::StageSteps;

/// Where an increment's iteration stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Number of the increment in the whole history, from 0.
    pub increment: usize,
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

    /// An increment is solved and heard of: where the run stands now, for those who store it. `Break` stops the run after it.
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
        self.resume(Checkpoint::start(self.plan), observer)
    }

    /// Runs what is left of the history after a checkpoint of this plan, with the bits of an unbroken run. The history that is
    /// returned holds the increments solved here.
    ///
    /// # Errors
    /// As [`Simulation::run`].
    pub fn resume(&self, from: Checkpoint, observer: &mut dyn Observer) -> Result<History, RunError> {
        let plan = self.plan;
        let case = &plan.case;
        let Checkpoint { mut place, state, memory } = from;
        let mut solver = self.solver();
        solver.remember(memory);
        let mut history = History {
            grid: plan.grid,
            bodies: case.bodies.clone(),
            periodic: case.periodic,
            stages: case.stages.iter().map(|stage| stage.name.clone()).collect(),
            steps: Vec::with_capacity(plan.increments - place.solved.min(plan.increments)),
            fields: Vec::new(),
            state,
        };
        if let Some(friction) =
            case.stages.iter().take(place.stage).rev().find_map(|stage| stage.friction.as_ref())
        {
            solver.rub_with(friction);
        }
        for (number, stage) in case.stages.iter().enumerate().skip(place.stage) {
            if let Some(friction) = &stage.friction {
                solver.rub_with(friction);
            }
            let steps = if place.solved_of_stage == 0 {
                StageSteps::new(stage, &place.held, &history.state, &place.resultants)
            } else {
                StageSteps::from_start(stage, place.stage_start)
            };
            place.stage = number;
            place.stage_start = steps.start();
            for k in place.solved_of_stage + 1..=stage.increments_in_all() {
                let increment = place.solved;
                let load = steps.at(k);
                let started = Instant::now();
                let mut watch = |iteration: usize, residual: f64| {
                    observer.iterated(&Iteration {
                        increment,
                        iteration,
                        residual,
                        tolerance: case.tolerance,
                    })
                };
                let solved = solver
                    .step(&history.state, &load, &mut watch)
                    .map_err(|error| run_error(&error, increment, stage, case.tolerance))?;
                let record = record(&solved, increment, number, started.elapsed().as_secs_f64());
                let kept = case.keeps(number, k).then(|| kept(&solved, increment, &case.output.fields));
                place.resultants = solved.outcome.resultants;
                place.held = load;
                place.solved += 1;
                place.solved_of_stage = k;
                history.state = solved.state;
                let heard = observer.solved(&record, &history.state, kept.as_ref());
                history.steps.push(record);
                history.fields.extend(kept);
                let stored = observer.reached(&Waypoint {
                    place: &place,
                    state: &history.state,
                    memory: solver.memory(),
                });
                if heard.is_break() || stored.is_break() {
                    return Err(RunError::Interrupted { increment: place.solved });
                }
            }
            place.solved_of_stage = 0;
        }
        Ok(history)
    }

    /// The solver with its operators.
    fn solver(&self) -> ContactSolver<'a> {
        let plan = self.plan;
        let case = &plan.case;
        let wanted = match plan.coupling {
            Coupling::Frictionless => Components::NORMAL,
            Coupling::Uncoupled => Components { normal: true, tangential: true, coupling: false },
            Coupling::Coupled => Components::ALL,
        };
        let spacing = plan.grid.spacing();
        let [longest, shortest] = [plan.grid.size(), spacing].map(|[x, y]| (x.max(y), x.min(y)));
        let plain = plan.leave_out.takes(Shortcut::LayeredResponse);
        let layered = || PairResponse::all_layers(&case.bodies, longest.0);
        let response = match (case.periodic, plain) {
            (true, true) => {
                SurfaceResponse::Periodic(periodic_symbols(&case.bodies, case.cells, spacing, wanted, 0))
            }
            (true, false) => SurfaceResponse::Periodic(symbols_of(layered(), case.cells, spacing, wanted)),
            (false, true) => {
                SurfaceResponse::FreeSpace(influence_coefficients(&case.bodies, case.cells, spacing, wanted))
            }
            (false, false) => {
                SurfaceResponse::FreeSpace(coefficients_of(&layered(), case.cells, spacing, wanted))
            }
        };
        let solver = ContactSolver::new(
            plan.grid,
            case.profile.gap(&plan.grid),
            &case.friction,
            plan.coupling,
            response,
            SolverSettings {
                scheme: case.scheme,
                leave_out: plan.leave_out,
                ..SolverSettings::new(case.tolerance)
            },
            plan.leave_out.takes(Shortcut::Box),
        )
        .sheared_along(plan.along);
        if case.periodic {
            return solver;
        }
        solver.with_waves(ResponseTable::new(&case.bodies, TAU / longest.0, 5.0 * PI / shortest.1))
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
