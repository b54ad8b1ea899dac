//! Where a run stands after an increment: all that later increments depend on, so that a run can be broken off at any moment and
//! taken up again with the bits it would have had.

use ndarray::Array2;
use serde::{Deserialize, Serialize};

use crate::case::{Case, Stage};
use crate::fretting_loop::FrettingLoop;
use crate::model::{ContactState, Control, LoadStep};
use crate::plan::Plan;
use crate::solver::{Resultants, SolverMemory};
use crate::wear::{Collected, WornThrough};

/// Version of the bytes; another layout of what is stored gets another one.
const FORMAT: u32 = 3;

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
    /// Where and when the surfaces were worn to the limit: all is over.
    pub worn_through: Option<WornThrough>,
}

/// Where a run stands after an increment, as the run itself holds it: to be looked at or stored.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Waypoint<'a> {
    pub(crate) place: &'a Place,
    pub(crate) state: &'a ContactState,
    pub(crate) memory: &'a SolverMemory,
    pub(crate) cycle: Option<&'a FrettingLoop>,
    pub(crate) wear: Option<&'a Collected>,
}

/// A stored waypoint, from which a run goes on.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Checkpoint {
    pub(crate) place: Place,
    pub(crate) state: ContactState,
    pub(crate) memory: SolverMemory,
    /// The cycle at work.
    pub(crate) cycle: Option<FrettingLoop>,
    /// What has worn since the gap was opened last.
    pub(crate) wear: Option<Collected>,
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

impl Waypoint<'_> {
    /// Increments solved in the whole history.
    pub fn solved(&self) -> usize {
        self.place.solved
    }

    /// Appends the bytes of the waypoint: its format, then its parts in a compact form, floats bit by bit.
    ///
    /// # Errors
    /// Never, for what a run holds; the encoder's words otherwise.
    pub fn write(&self, bytes: Vec<u8>) -> Result<Vec<u8>, CheckpointError> {
        postcard::to_extend(&(FORMAT, self), bytes)
            .map_err(|error| CheckpointError::Damaged(error.to_string()))
    }
}

impl Checkpoint {
    /// The start of a plan: bodies that have not touched yet.
    pub fn start(plan: &Plan) -> Self {
        let free = LoadStep {
            normal: Control::Force(0.0),
            tangential: [Control::Force(0.0); 2],
            twist: Control::Motion(0.0),
        };
        let place = Place {
            solved: 0,
            stage: 0,
            solved_of_stage: 0,
            parts: 1,
            cycles: 0,
            stage_start: free,
            held: free,
            resultants: Resultants::default(),
            worn_through: None,
        };
        let cells = plan.grid.cells();
        let mut state = ContactState::untouched(cells);
        let wears = plan.case.wear.is_some();
        state.worn_depth = wears.then(|| Array2::zeros(cells));
        let wear = wears.then(|| Collected::nothing(cells));
        Self { place, state, memory: SolverMemory::default(), cycle: None, wear }
    }

    /// The checkpoint in bytes written by [`Waypoint::write`], for a run of `plan`.
    ///
    /// # Errors
    /// When the bytes are of another format, damaged, or of another plan's size.
    pub fn read(bytes: &[u8], plan: &Plan) -> Result<Self, CheckpointError> {
        let damaged = |error: postcard::Error| CheckpointError::Damaged(error.to_string());
        let (format, bytes) = postcard::take_from_bytes::<u32>(bytes).map_err(damaged)?;
        if format != FORMAT {
            return Err(CheckpointError::Format { found: format });
        }
        let (checkpoint, rest) = postcard::take_from_bytes::<Self>(bytes).map_err(damaged)?;
        if !rest.is_empty() {
            return Err(CheckpointError::Damaged(format!("{} bytes too many", rest.len())));
        }
        if checkpoint.belongs_to(plan) { Ok(checkpoint) } else { Err(CheckpointError::Foreign) }
    }

    /// Increments solved in the whole history.
    pub fn solved(&self) -> usize {
        self.place.solved
    }

    fn belongs_to(&self, plan: &Plan) -> bool {
        let cells = plan.grid.cells();
        let wears = plan.case.wear.is_some();
        self.is_within(&plan.case)
            && self.state.is_sound(cells)
            && self.memory.fits(cells)
            && self.state.worn_depth.is_some() == wears
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

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::{Checkpoint, CheckpointError, Waypoint};
    use crate::case::Case;
    use crate::history::StepRecord;
    use crate::plan::Plan;
    use crate::simulation::{Observer, Silent, Simulation};

    /// Coated and rubbed in two directions, with controls that change their kind.
    const CASE: &str = r"
        [grid]
        cells = [14, 12]
        size = [210e-6, 180e-6]
        [upper]
        rigid = true
        [lower]
        coatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]
        substrate = { young = 210e9, poisson = 0.3 }
        [profile.sphere]
        radius = 10e-3
        [friction]
        coefficient = 0.2
        [[load]]
        normal_force = 1.0
        increments = 4
        [[load]]
        tangential_force = [0.1, 0.05]
        cycles = 1
        increments = 8
        [[load]]
        shift = [30e-9, 0.0]
        increments = 3
        [output]
        fields = []
    ";

    fn plan(case: &str) -> Plan {
        Plan::new(Case::from_toml(case, "case").unwrap()).unwrap()
    }

    /// Keeps the bytes of every waypoint.
    struct Keeper(Vec<Vec<u8>>);

    impl Observer for Keeper {
        fn reached(&mut self, waypoint: &Waypoint<'_>) -> ControlFlow<()> {
            self.0.push(waypoint.write(Vec::new()).unwrap());
            ControlFlow::Continue(())
        }
    }

    fn timeless(steps: &[StepRecord]) -> Vec<StepRecord> {
        steps.iter().map(|step| StepRecord { wall_s: 0.0, ..step.clone() }).collect()
    }

    #[test]
    fn a_run_taken_up_after_any_increment_has_the_bits_of_the_unbroken_one() {
        let plan = plan(CASE);
        let simulation = Simulation::new(&plan);
        let mut keeper = Keeper(Vec::new());
        let whole = simulation.run(&mut keeper).unwrap();
        assert_eq!(keeper.0.len(), 15);
        for (increment, bytes) in keeper.0.iter().enumerate() {
            let checkpoint = Checkpoint::read(bytes, &plan).unwrap();
            assert_eq!(checkpoint.solved(), increment + 1);
            let rest = simulation.resume(checkpoint, &mut Silent).unwrap();
            assert_eq!(timeless(&rest.steps), timeless(&whole.steps[increment + 1..]));
            assert_eq!(rest.state, whole.state);
        }
    }

    #[test]
    fn bytes_that_are_no_checkpoint_of_the_plan_are_refused() {
        let plan = plan(CASE);
        let mut keeper = Keeper(Vec::new());
        Simulation::new(&plan).run(&mut keeper).unwrap();
        let bytes = &keeper.0[5];
        for length in [0, 1, bytes.len() / 2, bytes.len() - 1] {
            assert!(matches!(Checkpoint::read(&bytes[..length], &plan), Err(CheckpointError::Damaged(_))));
        }
        let mut newer = bytes.clone();
        newer[0] = 9;
        assert_eq!(Checkpoint::read(&newer, &plan), Err(CheckpointError::Format { found: 9 }));
        for other in [CASE.replace("[14, 12]", "[12, 14]"), CASE.replace("increments = 4", "increments = 3")]
        {
            assert_eq!(Checkpoint::read(bytes, &self::plan(&other)), Err(CheckpointError::Foreign));
        }
    }
}
