//! A planned case with its operators, ready to run.

use std::sync::Arc;

use ndarray::Array2;

use super::checkpoint::Checkpoint;
use super::debris::{Debris, give};
use super::evolving::Evolving;
use super::journey::Journey;
use super::moving::{Moving, Stepper};
use super::observer::Observer;
use super::pair_compliance::PairCompliance;
use super::plausibility::Gauge;
use super::records::Records;
use super::rim::OpenRim;
use super::rolling::Rolling;
use super::run_error::{RunError, run_error, too_thin};
use super::stiffest_wave::StiffestWave;
use super::surfaces::Surfaces;
use super::thinning::bodies_left;
use super::upper_frame::UpperFrame;
use super::wear::{Collected, Wearing};
use crate::history::History;
use crate::machine::memory::{Claim, claim};
use crate::model::BulkCompliance;
use crate::plan::{Plan, Simplification};
use crate::solver::{ContactSolver, SolverSettings};

/// On a grid of as many cells the response of the pair gives its memory back while nobody needs it: a tenth of all that a coupled run takes.
const GIVES_BACK: usize = 256 * 256;

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
    pub(crate) fn with_compliance(self, compliance: Option<Arc<PairCompliance>>) -> Self {
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
            Err(error) => (from.history(self.plan), Err(error)),
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

    fn journey(&self, from: Checkpoint, observer: &mut dyn Observer) -> (History, Result<(), RunError>) {
        let plan = self.plan;
        let (case, symmetry) = (&plan.case, plan.symmetry);
        let thinned = from.wear.as_ref().map_or([0.0; 2], Collected::thinned);
        let mut bodies = case.bodies.clone();
        let compliance = match &self.compliance {
            _ if thinned != [0.0; 2] => match bodies_left(plan, thinned) {
                Ok(left) => {
                    bodies = left;
                    PairCompliance::of_bodies(plan, &bodies)
                }
                Err(reason) => {
                    let error = too_thin(case, &from.place, reason);
                    return (from.history(plan), Err(error));
                }
            },
            Some(compliance) => PairCompliance::clone(compliance),
            None => PairCompliance::of(plan),
        };
        let Checkpoint { place, state, memory, cycle, wear, upper_wear, debris, slip } = from;
        let stiffest = case.wear.is_some().then(|| StiffestWave::of(plan, &compliance));
        let gap = case.profile.gap(&plan.grid);
        let unworn = state.worn_depth.as_ref().map(|_| symmetry.part(&gap));
        let mut solver = self.solver(compliance, gap);
        if let Some(unworn) = &unworn {
            let mut gap = unworn.clone();
            state.open(&mut gap);
            solver.set_gap(gap);
        }
        solver.set_give(give(case.wear.as_ref(), &state));
        let rim = |body: usize| {
            let rule = case.wear.as_ref().and_then(|rule| rule.rim.as_ref());
            rule.map(|rule| OpenRim::new(rule, body, &plan.grid, symmetry))
        };
        let of_jumps = case.wear.as_ref().map(|rule| (rule.tolerance, rule.largest_step));
        let debris = of_jumps.zip(debris).map(|(bounds, collected)| Debris::new(bounds, collected));
        let friction = || symmetry.part_of_friction(&case.friction).into_owned();
        let upper =
            case.wear.as_ref().zip(upper_wear).zip(stiffest.clone()).map(|((rule, collected), stiffest)| {
                let wearing =
                    Wearing::new(rule.of_body(1), stiffest, Array2::zeros([0, 0]), friction(), collected);
                (wearing.with_rim(rim(1)), UpperFrame::of(plan))
            });
        let rule =
            if upper.is_some() { case.wear.as_ref().map(|rule| rule.of_body(0)) } else { case.wear.clone() };
        let wears = rule.zip(wear).zip(stiffest.zip(unworn));
        let wearing = wears.map(|((rule, collected), (stiffest, unworn))| {
            Wearing::new(rule, stiffest, unworn, friction(), collected).with_rim(rim(0))
        });
        let evolution = case.friction_evolution.clone().zip(slip).zip(state.accumulated.as_ref());
        let friction_of_upper = case.kinematics.friction_of_upper && plan.moves;
        let evolving = evolution.map(|((rule, collected), slipped)| {
            let frame = friction_of_upper.then(|| UpperFrame::of(plan));
            Evolving::new(rule, friction(), slipped, collected).in_frame(frame)
        });
        let integration = case.integration;
        let surfaces = Surfaces { wearing, upper, friction_of_upper, debris, evolving, integration };
        solver.set_tilt(state.tilt);
        // Last: a new gap makes a solver forget.
        solver.restore_memory(memory);
        let moving = plan.moves.then(|| Moving::of(plan, &bodies)).transpose();
        let moving = match moving {
            Ok(moving) => moving,
            Err(error) => {
                let error = run_error(&error, place.solved, case, place.stage);
                let underway = surfaces.underway();
                return (Records::default().history(plan, (&place, state), underway), Err(error));
            }
        };
        let rolling = case.rolls().then(|| Rolling::of(plan));
        let solver = Stepper { solver, moving, rolling };
        let (records, gauge) = (Records::default(), Gauge::of(plan));
        let journey = Journey { plan, solver, surfaces, state, records, gauge, place, cycle, observer };
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
                reuse_pressure: plan.leave_out.takes(Simplification::Pressure)
                    && !plan.moves
                    && !case.rolls(),
                friction_work: case.output.fields.iter().any(|name| name == "friction_work"),
                skip_unloaded_shear: plan.leave_out.takes(Simplification::Tangential),
                ..SolverSettings::new(case.tolerance)
            },
            plan.leave_out.takes(Simplification::Region),
        )
        .with_shear_axis(plan.along)
        .with_bulk(BulkCompliance::of(&case.bodies, case.dimension()))
        .with_rig(case.springs())
        .with_beyond(case.beyond)
        .with_periods(case.periodic)
        .with_hardness(case.hardness)
        .with_symmetry(plan.symmetry);
        let solver = if plan.grid.len() < GIVES_BACK {
            solver
        } else {
            solver.with_response_made_by(Box::new(|| PairCompliance::of(plan).response))
        };
        match compliance.table {
            Some(table) => solver.with_response_table(table),
            None => solver,
        }
    }
}
