//! From stages to increments: what is prescribed at the end of each.

use crate::case::{Course, Stage, StageControl};
use crate::model::{ContactState, Control, LoadStep};
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
    pub fn new(stage: &'a Stage, held: &LoadStep, state: &ContactState, resultants: &Resultants) -> Self {
        let mut start = *held;
        let begin = |control: &StageControl, held: Control, force: f64, motion: f64| match (control, held) {
            (StageControl::Force(_), Control::Force(value)) => Control::Force(value),
            (StageControl::Motion(_), Control::Motion(value)) => Control::Motion(value),
            (StageControl::Force(_), Control::Motion(_)) => Control::Force(force),
            (StageControl::Motion(_), Control::Force(_)) => Control::Motion(motion),
        };
        if let Some(control) = &stage.normal {
            start.normal = begin(control, held.normal, resultants.normal, state.approach);
        }
        if let Some(controls) = &stage.tangential {
            for axis in 0..2 {
                start.tangential[axis] = begin(
                    &controls[axis],
                    held.tangential[axis],
                    resultants.tangential[axis],
                    state.shift[axis],
                );
            }
        }
        if let Some(control) = &stage.twist {
            start.twist = begin(control, held.twist, resultants.moment, state.twist);
        }
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
        let mut load = self.start;
        if let Some(control) = &self.stage.normal {
            load.normal = self.value(control, self.start.normal, k);
        }
        if let Some(controls) = &self.stage.tangential {
            for axis in 0..2 {
                load.tangential[axis] = self.value(&controls[axis], self.start.tangential[axis], k);
            }
        }
        if let Some(control) = &self.stage.twist {
            load.twist = self.value(control, self.start.twist, k);
        }
        load
    }

    fn value(&self, control: &StageControl, start: Control, k: usize) -> Control {
        let (Control::Force(from) | Control::Motion(from)) = start;
        let (StageControl::Force(target) | StageControl::Motion(target)) = *control;
        let last = k == self.stage.increments_in_all();
        let value = match self.stage.course {
            Course::Linear | Course::Cubic if last => target,
            Course::Linear => from + (target - from) * share(k, self.stage.increments, 1),
            Course::Cubic => {
                let power = if matches!(control, StageControl::Force(_)) { 3 } else { 2 };
                from + (target - from) * share(k, self.stage.increments, power)
            }
            Course::Cycles(_) => from + target * triangle(k, self.stage.increments),
        };
        match control {
            StageControl::Force(_) => Control::Force(value),
            StageControl::Motion(_) => Control::Motion(value),
        }
    }
}

fn share(k: usize, increments: usize, power: i32) -> f64 {
    (k as f64 / increments as f64).powi(power)
}

/// Height of the triangle wave 0, 1, -1, 0 after `k` of `increments` steps a period; its turns are always met.
fn triangle(k: usize, increments: usize) -> f64 {
    let quarter = ((increments as f64 / 4.0).round() as usize).max(1);
    let half = increments - 2 * quarter;
    let k = (k - 1) % increments + 1;
    if k <= quarter {
        k as f64 / quarter as f64
    } else if k <= quarter + half {
        1.0 - 2.0 * (k - quarter) as f64 / half as f64
    } else {
        -1.0 + (k - quarter - half) as f64 / quarter as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_meets_its_turns_for_any_number_of_increments() {
        for increments in 4..40 {
            let values: Vec<f64> = (1..=increments).map(|k| triangle(k, increments)).collect();
            assert!(values.contains(&1.0) && values.contains(&-1.0), "{increments}");
            assert_eq!(values[increments - 1], 0.0);
            assert_eq!(triangle(increments + 1, increments), triangle(1, increments));
        }
    }
}
