//! From stages to increments: what is prescribed at the end of each.

use crate::case::{Stage, StageControl};
use crate::model::{ContactState, Control, LoadStep, Rig};
use crate::solver::Resultants;

/// The increments of one stage, resolved from where the stage starts.
#[derive(Debug, Clone)]
pub struct StageSteps<'a> {
    stage: &'a Stage,
    start: LoadStep,
}

impl<'a> StageSteps<'a> {
    /// Steps of `stage` after controls `held`, from the motions of `state` and the forces `resultants` reached so far.
    /// A control that changes its kind starts from what was reached.
    pub fn new(
        stage: &'a Stage,
        held: &LoadStep,
        state: &ContactState,
        (resultants, rig): (&Resultants, Rig),
    ) -> Self {
        let begin =
            |control: &Option<StageControl>, held: Control, force: f64, motion: f64, spring: f64| match (
                control, held,
            ) {
                (None, _)
                | (Some(StageControl::Force(_)), Control::Force(_))
                | (Some(StageControl::FarEnd(_)), Control::FarEnd(_))
                | (Some(StageControl::Motion(_) | StageControl::Rate(_)), Control::Motion(_)) => held,
                (Some(StageControl::Force(_)), _) => Control::Force(force),
                (Some(StageControl::Motion(_) | StageControl::Rate(_)), _) => Control::Motion(motion),
                (Some(StageControl::FarEnd(_)), _) => Control::FarEnd(motion + spring * force),
            };
        let start = LoadStep {
            normal: begin(&stage.normal, held.normal, resultants.normal, state.approach, rig.normal),
            tangential: [0, 1].map(|axis| {
                let control = &stage.tangential[axis];
                let (force, shift) = (resultants.tangential[axis], state.shift[axis]);
                begin(control, held.tangential[axis], force, shift, rig.tangential[axis])
            }),
            twist: begin(&stage.twist, held.twist, resultants.moment, state.twist, 0.0),
            tilt: [0, 1].map(|axis| {
                let control = &stage.tilt[axis];
                begin(control, held.tilt[axis], resultants.tilt_moment[axis], state.tilt[axis], 0.0)
            }),
            bulk_stress: held.bulk_stress,
            roll: held.roll,
        };
        Self::from_start(stage, start)
    }

    /// Steps of a stage whose controls start at `start`.
    pub fn from_start(stage: &'a Stage, start: LoadStep) -> Self {
        Self { stage, start }
    }

    /// The controls where the stage starts.
    pub fn start(&self) -> LoadStep {
        self.start
    }

    /// What is prescribed at the end of increment `k` of the stage, `1 <= k <= increments_in_all`.
    pub fn at(&self, k: usize) -> LoadStep {
        self.stage.load(&self.start, k)
    }
}
