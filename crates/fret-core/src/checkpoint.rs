//! Where a run stands after an increment: all that later increments depend on, so that a run can be broken off at any moment and
//! taken up again with the bits it would have had.

use serde::{Deserialize, Serialize};

use crate::model::{ContactState, Control, LoadStep};
use crate::plan::Plan;
use crate::solver::{Resultants, SolverMemory};

/// Version of the bytes; another layout of what is stored gets another one.
const FORMAT: u32 = 1;

/// How far a run has come in its stages.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    /// Increments solved in the whole history.
    pub solved: usize,
    /// The stage at work.
    pub stage: usize,
    /// Increments solved in it.
    pub solved_of_stage: usize,
    /// Controls where it started.
    pub stage_start: LoadStep,
    /// Controls now.
    pub held: LoadStep,
    /// Resultants now.
    pub resultants: Resultants,
}

/// Where a run stands after an increment, as the run itself holds it: to be looked at or stored.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Waypoint<'a> {
    pub(crate) place: &'a Place,
    pub(crate) state: &'a ContactState,
    pub(crate) memory: &'a SolverMemory,
}

/// A stored waypoint, from which a run goes on.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Checkpoint {
    pub(crate) place: Place,
    pub(crate) state: ContactState,
    pub(crate) memory: SolverMemory,
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
            stage_start: free,
            held: free,
            resultants: Resultants::default(),
        };
        Self { place, state: ContactState::untouched(plan.grid.cells()), memory: SolverMemory::default() }
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
        let stages = &plan.case.stages;
        let place = &self.place;
        let before: usize = stages.iter().take(place.stage).map(super::case::Stage::increments_in_all).sum();
        stages.get(place.stage).is_some_and(|stage| {
            place.solved_of_stage <= stage.increments_in_all()
                && Some(place.solved) == before.checked_add(place.solved_of_stage)
        }) && self.state.is_sound(cells)
            && self.memory.fits(cells)
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
