//! Where a run stands after an increment: all that later increments depend on, so that a run can be broken off at any moment and
//! resumed with the bits it would have had. Its fields are those in front of the mirrors of the contact.

use std::io::{self, Write};

use ndarray::Array2;
use postcard::ser_flavors::Flavor;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::debris::{CollectedDebris, OneCycle};
use super::evolving::CollectedSlip;
use super::fretting_loop::FrettingLoop;
use super::moving::upper_wear_over_grid;
use super::surfaces::Underway;
use super::thinning::mean_depths;
use super::wear::Collected;
use crate::case::{Case, Stage};
use crate::history::{Start, WornThrough};
use crate::model::{AccumulatedSlip, ContactState, Control, LoadStep, SolvedState, Symmetry};
use crate::plan::Plan;
use crate::solver::{Resultants, SolverMemory};

/// Version of the bytes; another layout of what is stored gets another one.
const FORMAT: u32 = 15;

/// How far a run has come in its stages.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    /// Increments solved in the whole history.
    pub solved: usize,
    /// The stage at work; their number, once all are over.
    pub stage: usize,
    /// Increments solved in it; none, of a stage that has yet to begin.
    pub solved_of_stage: usize,
    /// Parts that the next increment is divided into first, where that is left to the program.
    pub parts: usize,
    /// Cycles done in it, those that a computed one stands for included.
    pub cycles: usize,
    /// Controls where it started.
    pub stage_start: LoadStep,
    /// Controls now.
    pub held: LoadStep,
    /// Resultants now.
    pub resultants: Resultants,
    /// Where and when the surfaces were first worn through a coating, or to the limit.
    pub worn_through: Option<WornThrough>,
    /// Whether they are worn to the limit: all is over.
    pub worn_out: bool,
}

/// Where a run stands after an increment, as the run itself holds it: to be looked at or stored.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Waypoint<'a> {
    pub(crate) place: &'a Place,
    pub(crate) state: &'a ContactState,
    pub(crate) memory: &'a SolverMemory,
    pub(crate) cycle: Option<&'a FrettingLoop>,
    pub(crate) wear: Option<&'a Collected>,
    pub(crate) upper_wear: Option<&'a Collected>,
    pub(crate) debris: Option<&'a CollectedDebris>,
    pub(crate) slip: Option<&'a CollectedSlip>,
}

/// A stored waypoint, from which a run goes on.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Checkpoint {
    pub(crate) place: Place,
    pub(crate) state: ContactState,
    pub(crate) memory: SolverMemory,
    /// The cycle at work.
    pub(crate) cycle: Option<FrettingLoop>,
    /// What has worn since the gap was opened last; off the upper body alone, where the bodies move against each other.
    pub(crate) wear: Option<Collected>,
    pub(crate) upper_wear: Option<Collected>,
    /// What becomes debris of it.
    pub(crate) debris: Option<CollectedDebris>,
    /// What slip has done since friction changed last.
    pub(crate) slip: Option<CollectedSlip>,
}

/// Why stored bytes are no checkpoint of a plan.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// Written by a version that stores other things.
    #[error("it has format {found}, this version reads format {FORMAT}")]
    Format {
        /// Its format.
        found: u32,
    },
    /// No checkpoint at all, or a damaged one.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// Whole, but of another grid or another history.
    #[error("it does not belong to this case")]
    Foreign,
}

/// Bytes on their way, field by field, and how that failed.
struct Passed<'a> {
    to: &'a mut dyn Write,
    failed: &'a mut Option<io::Error>,
}

impl Flavor for Passed<'_> {
    type Output = ();

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.try_extend(&[byte])
    }

    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.to.write_all(bytes).map_err(|error| {
            *self.failed = Some(error);
            postcard::Error::SerializeBufferFull
        })
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

impl Waypoint<'_> {
    /// Increments solved in the whole history.
    pub fn solved(&self) -> usize {
        self.place.solved
    }

    /// A copy that lasts.
    pub(crate) fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            place: *self.place,
            state: self.state.clone(),
            memory: self.memory.clone(),
            cycle: self.cycle.cloned(),
            wear: self.wear.cloned(),
            upper_wear: self.upper_wear.cloned(),
            debris: self.debris.cloned(),
            slip: self.slip.cloned(),
        }
    }

    /// Writes the bytes of the waypoint: its format, then its parts in a compact form, floats bit by bit.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        let mut failed = None;
        let done = postcard::serialize_with_flavor(&(FORMAT, self), Passed { to, failed: &mut failed });
        done.map_err(|error| failed.unwrap_or_else(|| io::Error::other(error)))
    }
}

impl Checkpoint {
    /// The start of a plan: the state it says, or bodies that have not touched yet.
    pub fn start(plan: &Plan) -> Self {
        let symmetry = plan.symmetry;
        let cells = symmetry.part_of(plan.grid.cells());
        let start = plan.start.as_deref();
        let (loads, resultants, mut state) = match start.map(|start| &start.solved) {
            None => (LoadStep::FREE, Resultants::default(), ContactState::untouched(cells)),
            Some(SolvedState { loads, normal_force, tangential_force, twist_moment, tilt_moment, state }) => {
                let resultants = Resultants {
                    normal: *normal_force,
                    tangential: *tangential_force,
                    moment: *twist_moment,
                    tilt_moment: *tilt_moment,
                };
                (*loads, resultants, symmetry.part_of_state(state))
            }
        };
        let memory = start.map(|start| {
            start.memory_for(&plan.to_json()).unwrap_or_else(|| SolverMemory::starting_at(loads))
        });
        let place = Place {
            solved: 0,
            stage: 0,
            solved_of_stage: 0,
            parts: 1,
            cycles: 0,
            stage_start: loads,
            held: loads,
            resultants,
            worn_through: None,
            worn_out: false,
        };
        let wears = plan.case.wear.is_some();
        let moves = plan.case.kinematics.is_finite();
        if wears {
            state.worn_depth.get_or_insert_with(|| Array2::zeros(cells));
        }
        if wears && moves {
            state.upper_worn_depth.get_or_insert_with(|| Array2::zeros(cells));
        }
        let wear = plan.case.wear.as_ref().map(|rule| {
            let layers = rule.layers.as_ref().filter(|_| rule.thinning_tolerance.is_some());
            let over = upper_wear_over_grid(plan, &state);
            let thinned = layers.map_or([0.0; 2], |layers| mean_depths(layers, &state, over.as_ref()));
            let rule = if moves { rule.of_body(0) } else { rule.clone() };
            Collected::nothing(cells, rule.layers).thinned_by(thinned)
        });
        let upper_wear = plan.case.wear.as_ref().filter(|_| moves);
        let upper_wear = upper_wear.map(|rule| Collected::nothing(cells, rule.of_body(1).layers));
        let rule = plan.case.wear.as_ref().and_then(|rule| rule.debris);
        if rule.is_some() {
            state.debris.get_or_insert_with(|| Array2::zeros(cells));
        }
        let debris = rule.map(|rule| CollectedDebris::nothing(rule, plan.area_of_cell(), (cells, moves)));
        if plan.case.hardness.is_some() {
            state.plastic_depth.get_or_insert_with(|| Array2::zeros(cells));
        }
        let evolves = plan.case.friction_evolution.is_some();
        if evolves {
            state.accumulated.get_or_insert_with(|| AccumulatedSlip::none(cells));
        }
        let slip = evolves.then(|| CollectedSlip::nothing(cells));
        let memory = memory.unwrap_or_default();
        Self { place, state, memory, cycle: None, wear, upper_wear, debris, slip }
    }

    /// The checkpoint in bytes written by [`Waypoint::write`], for a run of `plan`.
    ///
    /// # Errors
    /// When the bytes are of another format, damaged, or of another plan's size.
    pub fn read(bytes: &[u8], plan: &Plan) -> Result<Self, CheckpointError> {
        let checkpoint = Self::decoded(bytes)?;
        if checkpoint.belongs_to(plan) { Ok(checkpoint) } else { Err(CheckpointError::Foreign) }
    }

    fn decoded(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let damaged = |error: postcard::Error| CheckpointError::Damaged(error.to_string());
        let (format, bytes) = postcard::take_from_bytes::<u32>(bytes).map_err(damaged)?;
        if format != FORMAT {
            return Err(CheckpointError::Format { found: format });
        }
        let (checkpoint, rest) = postcard::take_from_bytes::<Self>(bytes).map_err(damaged)?;
        if !rest.is_empty() {
            return Err(CheckpointError::Damaged(format!("{} bytes too many", rest.len())));
        }
        Ok(checkpoint)
    }

    /// Increments solved in the whole history.
    pub fn solved(&self) -> usize {
        self.place.solved
    }

    /// The state in bytes written by [`Waypoint::write`], of a run by the plan that is given as JSON.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub fn start_of(bytes: &[u8], plan: &Value) -> Result<Start, CheckpointError> {
        let checkpoint = Self::decoded(bytes)?;
        let symmetry: Symmetry =
            serde_json::from_value(plan["symmetry"].clone()).map_err(|_| CheckpointError::Foreign)?;
        let underway = checkpoint.underway();
        let state = checkpoint.state.clone();
        let solved = symmetry.whole_solved(solved_state(&checkpoint.place, state, underway));
        // At the end of a stage the place is the begin of the next.
        let Place { stage, solved_of_stage, .. } = checkpoint.place;
        let stage = if solved_of_stage == 0 { stage.saturating_sub(1) } else { stage };
        let memory = underway.leaves_the_gap().then(|| (checkpoint.memory.clone(), stage));
        Start::new(plan, solved, memory).ok_or(CheckpointError::Foreign)
    }

    /// What slip has done since the surfaces changed last.
    pub(crate) fn underway(&self) -> Underway<'_> {
        let wear = [self.wear.as_ref(), self.upper_wear.as_ref()];
        Underway { wear, debris: self.debris.as_ref(), slip: self.slip.as_ref() }
    }

    fn belongs_to(&self, plan: &Plan) -> bool {
        let cells = plan.symmetry.part_of(plan.grid.cells());
        let wears = plan.case.wear.is_some();
        let evolves = plan.case.friction_evolution.is_some();
        let start = plan.start.as_ref().map(|start| &start.solved.state);
        let starts_worn = start.is_some_and(|state| state.worn_depth.is_some());
        let starts_worn_above = start.is_some_and(|state| state.upper_worn_depth.is_some());
        let wears_above = wears && plan.case.kinematics.is_finite();
        let keeps_debris = plan.case.wear.as_ref().is_some_and(|rule| rule.debris.is_some());
        let starts_with_debris = start.is_some_and(|state| state.debris.is_some());
        let yields = plan.case.hardness.is_some();
        let starts_yielded = start.is_some_and(|state| state.plastic_depth.is_some());
        let starts_rubbed = start.is_some_and(|state| state.accumulated.is_some());
        self.is_within(&plan.case)
            && self.state.is_sound(cells)
            && self.memory.fits(cells)
            && self.state.worn_depth.is_some() == (wears || starts_worn)
            && self.state.upper_worn_depth.is_some() == (wears_above || starts_worn_above)
            && self.upper_wear.is_some() == wears_above
            && self.upper_wear.as_ref().is_none_or(|wear| wear.fits(cells))
            && self.state.debris.is_some() == (keeps_debris || starts_with_debris)
            && self.debris.is_some() == keeps_debris
            && self.debris.as_ref().is_none_or(|debris| debris.fits(cells, wears_above))
            && self.state.plastic_depth.is_some() == (yields || starts_yielded)
            && self.state.accumulated.is_some() == (evolves || starts_rubbed)
            && self.slip.is_some() == evolves
            && self.slip.as_ref().is_none_or(|slip| slip.fits(cells))
            && self.wear.is_some() == wears
            && self.wear.as_ref().is_none_or(|wear| wear.fits(cells))
            && self.cycle.as_ref().is_none_or(|cycle| cycle.fits(self.place.stage, cells))
    }

    /// Whether a run of `case` can come to this place.
    fn is_within(&self, case: &Case) -> bool {
        let place = &self.place;
        let before: usize = case.stages.iter().take(place.stage).map(Stage::increments_in_all).sum();
        let Some(most) = before.checked_add(place.solved_of_stage) else { return false };
        // Stages before may have ended early.
        let adds_up = place.solved == most || (case.is_open_ended() && place.solved < most);
        let is_in_a_stage = match case.stages.get(place.stage) {
            Some(stage) => {
                let follows = place.solved_of_stage > 0 && stage.cycles().is_some();
                place.solved_of_stage < stage.increments_in_all() && self.cycle.is_some() == follows
            }
            None => place.stage == case.stages.len() && place.solved_of_stage == 0 && self.cycle.is_none(),
        };
        adds_up && place.solved >= place.solved_of_stage && is_in_a_stage
    }
}

/// What another history needs to start where a run stands, in front of the mirrors: what an unfinished cycle has worn so far is taken off
/// once, and what it has slipped is counted once.
pub(crate) fn solved_state(
    place: &Place,
    mut state: ContactState,
    Underway { wear: [wear, upper_wear], debris, slip }: Underway<'_>,
) -> SolvedState {
    let Resultants { normal, tangential, moment, tilt_moment } = place.resultants;
    if let (Some(debris), Some(thickness), Some(_)) = (debris, &mut state.debris, wear) {
        let worn = [state.worn_depth.as_ref(), state.upper_worn_depth.as_ref()];
        state.debris_outflow += debris.settle_once(thickness, &OneCycle::of([wear, upper_wear], worn));
    }
    if let (Some(depth), Some(wear)) = (&mut state.worn_depth, wear) {
        wear.take_off(depth);
    }
    if let (Some(depth), Some(wear)) = (&mut state.upper_worn_depth, upper_wear) {
        wear.take_off(depth);
    }
    if let (Some(accumulated), Some(slip)) = (&mut state.accumulated, slip) {
        accumulated.add_times(slip.of_cycle(), 1);
    }
    // An actuator belongs to its machine, and another history may have another one: it holds the body where it is.
    let held = |control: Control, motion: f64| match control {
        Control::FarEnd(_) => Control::Motion(motion),
        other => other,
    };
    let loads = LoadStep {
        normal: held(place.held.normal, state.approach),
        tangential: [0, 1].map(|axis| held(place.held.tangential[axis], state.shift[axis])),
        ..place.held
    };
    SolvedState {
        loads,
        normal_force: normal,
        tangential_force: tangential,
        twist_moment: moment,
        tilt_moment,
        state,
    }
}
