//! Whether the surfaces of a case move against each other by more than half a hundredth of a cell, and how much room that takes.

use super::loaded::is_loaded;
use crate::case::{Case, walk};
use crate::model::{ContactState, Control, Motion, SurfaceGrid};

/// Whether the upper body moves along an axis (0: x, 1: y) by more than positions of surfaces are rounded to, as far as the case tells. Where a
/// force or a spring moves it, it may.
pub fn moves_along(case: &Case, grid: &SurfaceGrid, axis: usize, start: Option<&ContactState>) -> bool {
    if !case.kinematics.is_finite() || grid.is_line() && axis == 1 || !is_loaded(case, axis, start) {
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

/// Side lengths of an automatic grid on which the contact may move by the largest prescribed shift either way.
pub fn with_room_to_move(case: &Case, size: [f64; 2]) -> [f64; 2] {
    if !case.kinematics.is_finite() {
        return size;
    }
    let mut most = [0.0_f64; 2];
    walk(case.start.as_ref(), &case.stages, |_, [_, x, y, _]| {
        for (most, control) in most.iter_mut().zip([x, y]) {
            if let Some(Control::Motion(shift) | Control::FarEnd(shift)) = control {
                *most = most.max(shift.abs());
            }
        }
    });
    let [x, y] = [0, 1].map(|axis| size[axis] + 2.0 * most[axis]);
    if case.is_line() { [x, x / case.cells[0] as f64] } else { [x, y] }
}
