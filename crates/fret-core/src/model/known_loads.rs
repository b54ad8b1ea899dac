//! The loads of a history, as far as they follow from the case alone.

use super::load::{Control, LoadStep};
use super::stage::{Path, Stage, StageControl};
use super::waveform::CycleTimes;

/// Controls as far as they follow from the case alone: a control that changes its kind starts from what the run reaches.
pub type KnownLoads = [Option<Control>; 4];

/// Visits the loads of a history that starts from `start`, or from free bodies, as far as the case fixes them: number of the stage, and the loads at the end of an increment.
/// Of a stage with cycles the first and the last are visited: its envelope is linear.
pub fn walk(start: Option<&LoadStep>, stages: &[Stage], mut visit: impl FnMut(usize, &KnownLoads)) {
    let loads = start.unwrap_or(&LoadStep::FREE).controls();
    let mut held: KnownLoads = std::array::from_fn(|freedom| Some(loads[freedom]));
    for (number, stage) in stages.iter().enumerate() {
        let start = held;
        let all = stage.increments_in_all();
        let times = stage.times();
        let first = 1..=stage.increments;
        for k in first.chain((all - stage.increments + 1).max(stage.increments + 1)..=all) {
            for (index, control) in stage.by_freedom().into_iter().take(held.len()).enumerate() {
                let Some(control) = control else { continue };
                held[index] = known(stage, control, start[index], (k, times.as_ref()));
            }
            visit(number, &held);
        }
    }
}

fn known(
    stage: &Stage,
    control: &StageControl,
    start: Option<Control>,
    (k, times): (usize, Option<&CycleTimes>),
) -> Option<Control> {
    let path = control.path();
    match (control, start) {
        (StageControl::Rate(_), _) => None,
        (StageControl::Force(_), Some(Control::Force(from)))
        | (StageControl::Motion(_), Some(Control::Motion(from)))
        | (StageControl::FarEnd(_), Some(Control::FarEnd(from))) => {
            Some(control.prescribing(stage.value(control, from, k, times)))
        }
        _ => match path {
            Path::To(_) if k < stage.increments => None,
            Path::Through(values) if k < stage.increments / values.len().max(1) => None,
            Path::Wave { .. } => None,
            Path::To(_) | Path::Through(_) => Some(control.prescribing(stage.value(control, 0.0, k, times))),
        },
    }
}
