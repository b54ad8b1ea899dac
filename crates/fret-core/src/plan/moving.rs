//! Whether the surfaces of a case move against each other by a hundredth of a cell or more, and how much room that takes.

use super::loaded::{is_loaded, is_twisted};
use crate::case::{Case, CaseError, Stage, walk};
use crate::model::{ContactState, Control, Frame, LoadStep, MOST_CELLS, Motion, SurfaceGrid, step_towards};

/// Whether the upper body moves along an axis (0: x, 1: y) by a hundredth of a cell or more, as far as the case tells. Where a
/// force or a spring moves it, it may.
pub fn moves_along(case: &Case, grid: &SurfaceGrid, axis: usize, start: Option<&ContactState>) -> bool {
    if !case.kinematics.is_finite()
        || !case.dimension().axes().contains(&axis)
        || !is_loaded(case, axis, start)
    {
        return false;
    }
    let motion = Motion::over(grid);
    let stays = |shift: f64| {
        let mut both = [0.0; 2];
        both[axis] = shift;
        motion.is_none(both)
    };
    let mut stay = start.is_none_or(|state| stays(state.shift[axis]));
    walk(case.start.as_ref(), &case.stages, |_, [_, x, y, _]| {
        stay &= match [x, y][axis] {
            Some(Control::Motion(shift)) => stays(*shift),
            Some(Control::Force(force)) => *force == 0.0,
            Some(Control::FarEnd(far)) => stays(*far),
            None => false,
        };
    });
    !stay
}

/// Whether the upper body moves along an axis, as [`moves_along`] says, or turns.
pub fn is_displaced(case: &Case, grid: &SurfaceGrid, start: Option<&ContactState>) -> bool {
    case.kinematics.is_finite() && is_twisted(case, start)
        || (0..2).any(|axis| moves_along(case, grid, axis, start))
}

/// Whether the contact rolls along an axis (0: x, 1: y).
pub fn rolls_along(case: &Case, axis: usize) -> bool {
    case.start.is_some_and(|loads| loads.roll[axis] != 0.0)
        || case.stages.iter().any(|stage| stage.steady && stage.roll_direction[axis] != 0.0)
        || case.stages.iter().filter_map(|stage| stage.roll[axis].as_ref()).any(|roll| !roll.path().is_zero())
}

/// Refuses increments by parts of cells in the frame of a contact that rolls.
///
/// # Errors
/// At the size of the grid, which the cells follow from.
pub fn in_whole_cells(case: &Case, grid: &SurfaceGrid) -> Result<(), CaseError> {
    not_in_whole_cells(case, grid)
        .map_or(Ok(()), |(why, help)| Err(case.refuse_size(format!("grid.size: {why}"), help)))
}

/// Why increments are not by whole cells in the frame of a contact that rolls, and what to do; `None` where they are.
pub fn not_in_whole_cells(case: &Case, grid: &SurfaceGrid) -> Option<(String, &'static str)> {
    let no_step =
        |stage: &&Stage| stage.steady && step_towards(stage.roll_direction, grid.spacing()).is_none();
    if let Some(Stage { name, roll_direction, .. }) = case.stages.iter().find(no_step) {
        let [dx, dy] = grid.spacing();
        let message = format!(
            "cells of {dx:?} x {dy:?} have no step of at most {MOST_CELLS} of them along each axis in roll_direction = {roll_direction:?} of stage {name:?}; a steady state is rolled to by whole cells"
        );
        let help = "roll along an axis, or on square cells in a direction such as [1, 1], [1, -2], [3, 2]; or turn bodies and creepage";
        return Some((message, help));
    }
    let (stage, cells, [from_x, from_y]) = parts_of_cells(case, grid)?;
    let message = format!(
        "an increment of stage {:?} rolls by {cells:.4} cells, after [{from_x:?}, {from_y:?}]; kinematics.frame = \"contact\" moves by whole cells",
        case.stages[stage].name
    );
    let help = "roll = a whole number of cells times increments, with grid.size given; or frame = \"bodies\"";
    Some((message, help))
}

/// The first stage an increment of which goes by a part of a cell in the frame of a contact that rolls, its cells, and the distance rolled
/// before [length].
fn parts_of_cells(case: &Case, grid: &SurfaceGrid) -> Option<(usize, f64, [f64; 2])> {
    if case.kinematics.frame != Frame::Contact || !case.rolls() {
        return None;
    }
    let mut held = case.start.unwrap_or(LoadStep::FREE);
    for (number, stage) in case.stages.iter().enumerate() {
        let start = held;
        for k in 1..=stage.increments_in_all() {
            let load = stage.load(&start, k);
            for axis in grid.dimension().axes() {
                let cells = (load.roll[axis] - held.roll[axis]) / grid.spacing()[axis];
                if (cells - cells.round()).abs() > 1e-6 {
                    return Some((number, cells, held.roll));
                }
            }
            held.roll = load.roll;
        }
        // The increment that a steady state is told by goes one step.
        if let Some(step) = step_towards(stage.roll_direction, grid.spacing()).filter(|_| stage.steady) {
            held.roll = [0, 1].map(|axis| held.roll[axis] + step[axis] as f64 * grid.spacing()[axis]);
        }
    }
    None
}

/// Side lengths of an automatic grid on which the contact may move by the largest prescribed shift either way.
pub fn with_room_to_move(case: &Case, size: [f64; 2]) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    if case.rolls() && case.kinematics.frame == Frame::Bodies {
        for (axis, most) in most.iter_mut().enumerate() {
            let mut held = case.start.unwrap_or(LoadStep::FREE);
            for stage in case.stages.iter().filter(|stage| stage.rolls()) {
                let start = held;
                // the way of a cycle is that of all, but for an envelope, which is linear
                let [first, all] = [stage.increments, stage.increments_in_all()];
                for k in (1..=first).chain((all - first + 1).max(first + 1)..=all) {
                    held.roll = stage.load(&start, k).roll;
                    *most = most.max(held.roll[axis].abs());
                }
            }
        }
    } else if !case.kinematics.is_finite() {
        return size;
    }
    let finite = case.kinematics.is_finite();
    let mut turns = false;
    walk(case.start.as_ref(), &case.stages, |_, [_, x, y, twist]| {
        turns |= finite && matches!(twist, Some(Control::Motion(twist)) if *twist != 0.0);
        for (most, control) in most.iter_mut().zip([x, y]) {
            if let (true, Some(Control::Motion(shift) | Control::FarEnd(shift))) = (finite, control) {
                *most = most.max(shift.abs());
            }
        }
    });
    // A contact that turns reaches as far along one side as along the other.
    let longest = size[0].max(size[1]);
    let turned = size.map(|side| if turns { longest } else { side });
    case.dimension().sides([0, 1].map(|axis| turned[axis] + 2.0 * most[axis]), case.cells)
}
